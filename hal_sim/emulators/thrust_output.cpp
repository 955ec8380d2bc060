// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/emulators/thrust_output.h"

#include <algorithm>
#include <cmath>

namespace lodesman {
namespace {

constexpr int kNeutralPulse_quarter_us = 6000;
constexpr double kPulseStep_quarter_us = 15.0;  // 3.75 us a command
constexpr double kStepsEachWay = 127.0;
constexpr std::uint8_t kNeutralCommand = 128;

// What a maker of such controllers says of his: neutral within 25 us.
constexpr int kNeutralHalfWidth_quarter_us = 100;
constexpr Duration kArmingTime = std::chrono::seconds{2};
constexpr Duration kReversePause = std::chrono::milliseconds{300};

// steps: from neutral; commands 127 and 128 are both none.
[[nodiscard]] std::uint8_t command_of_steps(double steps) noexcept {
  const int whole = static_cast<int>(std::lround(std::clamp(steps, -kStepsEachWay, kStepsEachWay)));
  return static_cast<std::uint8_t>(whole < 0 ? kNeutralCommand - 1 + whole
                                             : kNeutralCommand + whole);
}

}  // namespace

std::uint8_t thrust_command_of_pulse(std::uint16_t quarter_us) noexcept {
  return quarter_us == 0
             ? kNeutralCommand
             : command_of_steps((quarter_us - kNeutralPulse_quarter_us) / kPulseStep_quarter_us);
}

std::uint8_t thrust_command_of_duty(int duty) noexcept {
  return command_of_steps(duty * (kStepsEachWay / static_cast<double>(kFullDuty)));
}

EmulatedEsc::Pulse EmulatedEsc::kind_of(std::uint16_t quarter_us) noexcept {
  const int away = quarter_us - kNeutralPulse_quarter_us;
  return quarter_us == 0                                  ? Pulse::kNone
         : std::abs(away) <= kNeutralHalfWidth_quarter_us ? Pulse::kNeutral
         : away > 0                                       ? Pulse::kAhead
                                                          : Pulse::kAstern;
}

EmulatedEsc::State EmulatedEsc::next(Pulse pulse, Time now) noexcept {
  if (pulse == Pulse::kNone) {
    return State::kUnarmed;
  }
  const bool is_neutral = pulse == Pulse::kNeutral;
  switch (state_) {
    case State::kUnarmed: return is_neutral ? State::kArming : State::kUnarmed;
    case State::kArming:
      if (!is_neutral) {
        return State::kUnarmed;
      }
      return now >= neutral_since_ + kArmingTime ? State::kStopped : State::kArming;
    case State::kStopped:
      if (is_neutral) {
        return State::kStopped;
      }
      return pulse == turns_ || now >= neutral_since_ + kReversePause ? State::kTurning
                                                                      : State::kBalking;
    case State::kTurning:
    case State::kBalking:
      if (is_neutral) {
        return State::kStopped;
      }
      return pulse == turns_ ? State::kTurning : State::kBalking;
  }
  return State::kUnarmed;
}

std::uint8_t EmulatedEsc::step(std::uint16_t quarter_us, Time now) noexcept {
  const Pulse pulse = kind_of(quarter_us);
  const State before = state_;
  state_ = next(pulse, now);
  const bool sees_neutral_anew =
      (state_ == State::kArming && before == State::kUnarmed) ||
      (state_ == State::kStopped && (before == State::kTurning || before == State::kBalking));
  if (sees_neutral_anew) {
    neutral_since_ = now;
  }
  if (state_ == State::kTurning) {
    turns_ = pulse;
    return thrust_command_of_pulse(quarter_us);
  }
  return kNeutralCommand;
}

}  // namespace lodesman
