// SPDX-License-Identifier: Apache-2.0
// A start-up that goes by a proof on record: the box was seen to stop by itself since it last came
// up, and has now done so again, since the program that commanded it died.
#include "drivers/maestro/maestro.h"

namespace lodesman {

using maestro::Answer;
using maestro::Message;

namespace {

// After the last command of one that died, beside the time-out: a step of it, and the line's way.
constexpr Duration kLastWords = std::chrono::milliseconds{100};

}  // namespace

void Maestro::recall(const BoxProof& proof, Time last_command) noexcept {
  recalled_ = proof;
  last_command_ = last_command;
}

// Good for one connection of one power-up. It is looked at once: what comes after is another one.
bool Maestro::proof_is_on_record() noexcept {
  const bool stands = recalled_.proved != Time{} && recalled_.power_up != 0 &&
                      recalled_.power_up == stream_.power_up();
  if (!stands) {
    recalled_ = {};
  }
  return stands;
}

// Whatever is said sets the box's time-out anew, so nothing is until it must have acted.
void Maestro::await_time_out(Time now) noexcept {
  tell(DeviceFault::kProving);
  if (now - since_ < options_.time_out + kLastWords &&
      now - last_command_ < options_.time_out + kLastWords) {
    return;
  }
  Message message;
  add_errors(message);
  add_positions(message);
  if (talk_.say(message, now)) {
    enter(State::kConfirming, now);
  } else {
    recalled_ = {};
    start_over(now);
  }
}

// Its register tells of its time-out and of nothing else, and both outputs are at neutral.
void Maestro::confirm(Answer answer, Time now) noexcept {
  if (answer == Answer::kAwaited) {
    return;
  }
  const bool confirmed = answer == Answer::kWhole && talk_.reply(0) == maestro::kTimeOutError &&
                         is_neutral_pulse(talk_.reply(1)) && is_neutral_pulse(talk_.reply(2));
  const BoxProof on_record = recalled_;
  recalled_ = {};
  if (!confirmed) {
    start_over(now);
    return;
  }
  identified_ = true;
  ++counts_.recalls;
  begin_holding(on_record, Duration::zero(), now);
  static_cast<void>(write({}, stopped(now), now));
}

// Neutral for so long, from here on.
void Maestro::begin_holding(const BoxProof& proof, Duration for_so_long, Time now) noexcept {
  proof_ = proof;
  hold_ = for_so_long;
  lost_ = 0;
  errors_ = 0;
  doubt_ = Doubt::kNone;
  silence_ours_ = false;
  errors_asked_at_ = now;
  enter(State::kHolding, now);
  tell(DeviceFault::kStarting);
}

}  // namespace lodesman
