// SPDX-License-Identifier: Apache-2.0
// What the plant makes of a thruster box's output: the command byte that a pulse or a duty stands
// for, straight or through an ESC with the manners of such. Plain values; any thread.
#pragma once

#include <cstdint>

#include "mid_level/base/time.h"

namespace lodesman {

inline constexpr int kFullDuty = 32767;  // of a RoboClaw; astern the same, negative

// [0, 255] the nearest; 128 for neutral and for no pulses. Each command byte's own pulse and duty
// give that byte, but for 127, which is neutral as 128 is.
[[nodiscard]] std::uint8_t thrust_command_of_pulse(std::uint16_t quarter_us) noexcept;
[[nodiscard]] std::uint8_t thrust_command_of_duty(int duty) noexcept;

// An electronic speed controller between a servo box and a motor: it wants to see neutral before
// it works, and again before it reverses.
class EmulatedEsc {
 public:
  // The command byte that the motor gets, with this pulse going out now.
  [[nodiscard]] std::uint8_t step(std::uint16_t quarter_us, Time now) noexcept;

 private:
  enum class State : std::uint8_t {
    kUnarmed,  // it has not seen neutral
    kArming,   // it sees neutral, not yet for long enough
    kStopped,  // neutral; `turns_` is where it turned last
    kTurning,  // where `turns_` says
    kBalking,  // told to reverse too early: it stands still until it sees neutral
  };
  enum class Pulse : std::uint8_t { kNone, kNeutral, kAhead, kAstern };

  [[nodiscard]] static Pulse kind_of(std::uint16_t quarter_us) noexcept;
  [[nodiscard]] State next(Pulse pulse, Time now) noexcept;

  State state_ = State::kUnarmed;
  Pulse turns_ = Pulse::kNone;
  Time neutral_since_{};
};

}  // namespace lodesman
