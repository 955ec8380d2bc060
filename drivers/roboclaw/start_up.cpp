// SPDX-License-Identifier: Apache-2.0
// From a connection to a box that may be commanded.
#include <algorithm>

#include "drivers/roboclaw/roboclaw.h"

namespace lodesman {

using roboclaw::Command;
using roboclaw::Outcome;

namespace {

using State = RoboClaw::State;

// A state of the start-up is one exchange. After a write that was not acknowledged the next one is
// a read, whose reply cannot be taken for a late acknowledge.
struct Step {
  State state;
  Command command;
  State then;
  State when_lost;
};
constexpr std::array kSteps{
    Step{State::kIdentifying, Command::kReadVersion, State::kStopping, State::kIdentifying},
    Step{State::kStopping, Command::kDutyBoth, State::kSetting, State::kIdentifying},
    Step{State::kSetting, Command::kSetTimeOut, State::kReadingTimeOut, State::kReadingTimeOut},
    Step{State::kReadingTimeOut, Command::kReadTimeOut, State::kPausing, State::kReadingTimeOut},
    Step{State::kReadingDuties, Command::kReadDuties, State::kReadingStatus, State::kReadingDuties},
    Step{State::kReadingStatus, Command::kReadStatus, State::kHolding, State::kReadingStatus},
};

[[nodiscard]] const Step& step_of(State state) noexcept {
  return *std::find_if(kSteps.begin(), kSteps.end() - 1,
                       [state](const Step& step) { return step.state == state; });
}

[[nodiscard]] Duration proving_pause(Duration time_out) noexcept { return time_out + time_out / 2; }

}  // namespace

void RoboClaw::start_up(Outcome outcome, Time now) noexcept {
  const Step& step = step_of(state_);
  if (outcome == Outcome::kAwaited) {
    return;
  }
  if (outcome == Outcome::kGood) {
    enter(answered(step.then, now), now);
  } else if (outcome == Outcome::kLost) {
    if (lost_once_more()) {
      // What has answered before on this connection is no other device.
      const bool other = !identified_ && exchange_.stray_bytes() != strays_before_;
      give_up(other ? DeviceFault::kWrongDevice : DeviceFault::kNoAnswer, now);
      return;
    }
    enter(step.when_lost, now);
  }
  ask_again(now);
}

// What the state of the start-up asks or tells; nothing in any other.
void RoboClaw::ask_again(Time now) noexcept {
  switch (state_) {
    case State::kStopping: static_cast<void>(drive(stopped(now), now)); return;
    case State::kSetting:
      static_cast<void>(exchange_.send(
          Command::kSetTimeOut,
          roboclaw::write_byte(options_.address, Command::kSetTimeOut, time_out_units()), now));
      return;
    case State::kIdentifying:
    case State::kReadingTimeOut:
    case State::kReadingDuties:
    case State::kReadingStatus: static_cast<void>(read(step_of(state_).command, now)); return;
    default: return;
  }
}

// What its answer leads to.
RoboClaw::State RoboClaw::answered(State then, Time now) noexcept {
  const auto data = exchange_.data();
  switch (exchange_.command()) {
    case Command::kReadVersion:
      identified_ = true;
      version_length_ = data.size() - 1;  // without its zero
      std::copy_n(data.begin(), version_length_, version_.begin());
      return then;
    case Command::kReadTimeOut:
      if (roboclaw::unsigned_of(data) == time_out_units()) {
        tell(DeviceFault::kProving);
        return then;
      }
      if (!lost_once_more()) {
        return State::kSetting;
      }
      give_up(DeviceFault::kSettingRefused, now);
      return State::kResting;
    case Command::kReadDuties:
      if (roboclaw::unsigned_of(data) == 0) {
        return then;
      }
      give_up(DeviceFault::kNotNeutral, now);
      return State::kResting;
    case Command::kReadStatus:
      status_word_ = roboclaw::unsigned_of(data);
      lost_ = 0;
      reads_lost_ = 0;
      read_at_ = now;
      spoke_at_ = now;
      tell(DeviceFault::kStarting);
      return then;
    default: return then;
  }
}

void RoboClaw::pause(Time now) noexcept {
  if (now - since_ >= proving_pause(options_.time_out)) {
    enter(State::kReadingDuties, now);
    ask_again(now);
  }
}

}  // namespace lodesman
