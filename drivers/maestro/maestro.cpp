// SPDX-License-Identifier: Apache-2.0
#include "drivers/maestro/maestro.h"

#include <cmath>
#include <cstdlib>
#include <utility>

#include "drivers/hal/thrust_scale.h"
#include "mid_level/base/startup_error.h"

namespace lodesman {

using maestro::Answer;
using maestro::Message;
using maestro::Packet;

namespace {

// While the time-out is proved the outputs stand a microsecond off neutral: no speed controller
// knows the difference, but a box whose error action is to keep its pulse is found out by it.
constexpr std::uint16_t kProbe_quarter_us = 4;
constexpr int kNeutralTolerance_quarter_us = 1;
// A position is far from what was sent by more than this share of the range.
constexpr double kFarShare = 0.1;
constexpr double kLeastPulse_us = 100.0;
constexpr double kMostPulse_us = 4000.0;

[[nodiscard]] MaestroOptions sound(const MaestroOptions& options) {
  if (options.left_channel > maestro::kMaxChannel || options.right_channel > maestro::kMaxChannel) {
    throw StartupError("the channels of a Maestro are 0 to 23");
  }
  if (options.left_channel == options.right_channel) {
    throw StartupError("left and right thruster cannot be on the same channel");
  }
  if (!(options.range_us > 0.0 && options.neutral_us - options.range_us >= kLeastPulse_us &&
        options.neutral_us + options.range_us <= kMostPulse_us)) {
    throw StartupError("pulses must be from 100 to 4000 us");
  }
  return options;
}

[[nodiscard]] Duration proving_pause(Duration time_out) noexcept { return time_out + time_out / 2; }

}  // namespace

Maestro::Maestro(ByteStream& stream, const MaestroOptions& options, const ThrustShapeOptions& shape)
    : stream_{stream}, options_{sound(options)}, left_{shape}, right_{shape}, talk_{stream} {}

CommandStatus Maestro::command(ThrustCommand command, Time now) noexcept {
  if (!follow_connection(now)) {
    return CommandStatus::kDisconnected;
  }
  const Answer answer = talk_.listen(now);
  heard_ = heard_ || talk_.stray_bytes() != strays_heard_;
  strays_heard_ = talk_.stray_bytes();
  const CommandStatus status = step(answer, command, now);
  if (stream_.connection(now) != connection_) {  // reading or writing has shown it
    lose_connection(now);
    return CommandStatus::kDisconnected;
  }
  return status;
}

bool Maestro::follow_connection(Time now) noexcept {
  const std::uint64_t connection = stream_.connection(now);
  if (connection == 0) {
    lose_connection(now);
    return false;
  }
  if (connection != connection_) {
    connection_ = connection;
    talk_.begin();
    strays_heard_ = talk_.stray_bytes();
    identified_ = false;
    failed_ = DeviceFault::kNone;
    start_over(now);
    if (proof_is_on_record()) {
      enter(State::kRecalling, now);
    }
  }
  return true;
}

void Maestro::lose_connection(Time now) noexcept {
  recalled_ = connection_ == 0 ? recalled_ : BoxProof{};
  connection_ = 0;
  proof_ = {};
  static_cast<void>(stopped(now));
  const DeviceFault line = stream_.fault();
  fault_ = line == DeviceFault::kNone ? DeviceFault::kStarting : line;
  if (state_ != State::kDisconnected) {
    enter(State::kDisconnected, now);
  }
}

CommandStatus Maestro::step(Answer answer, const ThrustCommand& command, Time now) noexcept {
  switch (state_) {
    case State::kDisconnected: break;
    case State::kRecalling: await_time_out(now); break;
    case State::kConfirming: confirm(answer, now); break;
    case State::kIdentifying: identify(answer, now); break;
    case State::kPausing: pause(now); break;
    case State::kReadingBack: read_back(answer, now); break;
    case State::kHolding:
    case State::kReady: return serve(answer, command, now);
    case State::kResting: rest(now); break;
  }
  return CommandStatus::kNotReady;
}

void Maestro::identify(Answer answer, Time now) noexcept {
  const bool whole = answer == Answer::kWhole;
  if (whole && (talk_.reply(0) & ~maestro::kAllErrors) == 0) {
    identified_ = true;
    tell(DeviceFault::kProving);
    const auto off_neutral = static_cast<std::uint16_t>(pulse(0.0) + kProbe_quarter_us);
    if (write({}, {off_neutral, off_neutral}, now)) {
      enter(State::kPausing, now);
    }
    return;
  }
  heard_ = heard_ || whole;
  if ((whole || answer == Answer::kLost) && lost_once_more()) {
    // What has answered before on this connection is no other device.
    give_up(identified_ ? DeviceFault::kNoAnswer
            : heard_    ? DeviceFault::kWrongDevice
                        : DeviceFault::kWrongMode,
            now);
    return;
  }
  if (talk_.may_ask(now)) {
    Message message;
    add_errors(message);
    static_cast<void>(talk_.say(message, now));
  }
}

// Whatever is said sets the box's time-out anew, so nothing is.
void Maestro::pause(Time now) noexcept {
  if (now - since_ < proving_pause(options_.time_out)) {
    return;
  }
  Message message;
  add_errors(message);
  add_positions(message);
  enter(talk_.say(message, now) ? State::kReadingBack : State::kIdentifying, now);
}

void Maestro::read_back(Answer answer, Time now) noexcept {
  if (answer == Answer::kAwaited) {
    return;
  }
  const std::uint16_t errors = answer == Answer::kWhole ? talk_.reply(0) : 0;
  if (answer != Answer::kWhole || (errors & ~maestro::kAllErrors) != 0) {
    // The register was cleared by what was asked: proved again from the beginning.
    if (lost_once_more()) {
      give_up(DeviceFault::kNoAnswer, now);
    } else {
      enter(State::kIdentifying, now);
    }
    return;
  }
  if ((errors & maestro::kTimeOutError) == 0) {
    give_up(DeviceFault::kNoTimeOut, now);
  } else if (!is_neutral_pulse(talk_.reply(1)) || !is_neutral_pulse(talk_.reply(2))) {
    give_up(DeviceFault::kNotNeutral, now);
  } else {
    begin_holding({now, stream_.power_up()}, options_.hold_neutral, now);
  }
  static_cast<void>(write({}, stopped(now), now));
}

CommandStatus Maestro::serve(Answer answer, const ThrustCommand& command, Time now) noexcept {
  if (now - spoke_at_ >= options_.time_out) {
    silence_ours_ = true;  // and the propellers stand still
    static_cast<void>(stopped(now));
  }
  judge(answer, now);
  if (state_ == State::kResting) {
    rest(now);
    return CommandStatus::kNotReady;
  }
  if (state_ == State::kHolding && now - since_ >= hold_ &&
      (is_neutral(command) || !options_.neutral_first)) {
    enter(State::kReady, now);
    failed_ = DeviceFault::kNone;
    ++counts_.starts;
  }
  const bool ready = state_ == State::kReady;
  const Pulses pulses = ready ? shaped(command, now) : stopped(now);
  if (!write(next_questions(now), pulses, now)) {
    fault_ = DeviceFault::kLineFull;
    return CommandStatus::kNotReady;
  }
  if (!ready) {
    tell(DeviceFault::kStarting);
    return CommandStatus::kNotReady;
  }
  fault_ = DeviceFault::kNone;
  ++counts_.commands;
  return CommandStatus::kTaken;
}

void Maestro::rest(Time now) noexcept {
  // Nothing is said to what is perhaps no Maestro.
  if (identified_) {
    static_cast<void>(write({}, stopped(now), now));
  }
  if (now - since_ >= kRest) {
    start_over(now);
  }
}

void Maestro::judge(Answer answer, Time now) noexcept {
  const bool whole = answer == Answer::kWhole;
  const std::uint16_t errors = whole && question_.errors ? talk_.reply(0) : 0;
  if (answer == Answer::kLost || (errors & ~maestro::kAllErrors) != 0) {
    silence_ours_ = silence_ours_ || question_.silence_ours;
    if (lost_once_more()) {
      give_up(DeviceFault::kNoAnswer, now);
    }
    return;
  }
  if (!whole) {
    return;
  }
  lost_ = 0;
  if (errors == 0) {
    const std::size_t first = question_.errors ? 1 : 0;
    judge_positions({talk_.reply(first), talk_.reply(first + 1)}, now);
    return;
  }
  // Its outputs went home by themselves, which explains any position.
  doubt_ = Doubt::kNone;
  if (!std::exchange(question_.silence_ours, false) || (errors & ~maestro::kTimeOutError) != 0) {
    count_error(now);
  }
}

// Answers have no check: a wrong position is asked for again, unless both outputs are as after a
// reset, which the next targets hide. And that is only believed where the register says that they
// did not go home by an error.
void Maestro::judge_positions(const Pulses& found, Time now) noexcept {
  const bool far =
      is_far(found.left, question_.sent.left) || is_far(found.right, question_.sent.right);
  const Doubt doubt = !far                                          ? Doubt::kNone
                      : is_home(found.left) && is_home(found.right) ? Doubt::kReset
                                                                    : Doubt::kWrong;
  if (!question_.errors) {
    doubt_ = doubt;
    return;
  }
  if (doubt == Doubt::kReset || doubt_ == Doubt::kReset ||
      (doubt == Doubt::kWrong && doubt_ == Doubt::kWrong)) {
    ++counts_.resets;
    give_up(DeviceFault::kBoxReset, now);
  }
  doubt_ = doubt;
}

void Maestro::count_error(Time now) noexcept {
  ++counts_.error_reports;
  error_times_.at(errors_ % kMaxErrors) = now;
  ++errors_;
  // The ring is full, and its oldest is the next to be written over.
  if (errors_ >= kMaxErrors && now - error_times_.at(errors_ % kMaxErrors) <= kErrorWindow) {
    give_up(DeviceFault::kBoxError, now);
  }
}

void Maestro::enter(State state, Time now) noexcept {
  state_ = state;
  since_ = now;
}

void Maestro::start_over(Time now) noexcept {
  lost_ = 0;
  heard_ = false;
  proof_ = {};
  tell(DeviceFault::kStarting);
  static_cast<void>(stopped(now));
  enter(State::kIdentifying, now);
}

void Maestro::give_up(DeviceFault why, Time now) noexcept {
  fault_ = failed_ = why;
  proof_ = {};
  enter(State::kResting, now);
}

bool Maestro::lost_once_more() noexcept {
  ++counts_.lost_answers;
  return ++lost_ >= kMaxLost;
}

void Maestro::tell(DeviceFault starting) noexcept {
  fault_ = failed_ == DeviceFault::kNone ? starting : failed_;
}

// The positions each time, before the targets that go with them: they answer for the ones before.
// The register is asked for in its period, and where a position is in doubt.
Message Maestro::next_questions(Time now) noexcept {
  Message message;
  if (!talk_.may_ask(now)) {
    return message;
  }
  question_ = {now - errors_asked_at_ >= kErrorPeriod || doubt_ != Doubt::kNone, false, sent_};
  if (question_.errors) {
    errors_asked_at_ = now;
    question_.silence_ours = silence_ours_;
    silence_ours_ = false;
    add_errors(message);
  }
  add_positions(message);
  return message;
}

void Maestro::add_errors(Message& message) const noexcept {
  message.ask(checked(maestro::get_errors()));
}

void Maestro::add_positions(Message& message) const noexcept {
  message.ask(checked(maestro::get_position(options_.left_channel)));
  message.ask(checked(maestro::get_position(options_.right_channel)));
}

bool Maestro::write(Message message, const Pulses& pulses, Time now) noexcept {
  message.add(checked(maestro::set_target(options_.left_channel, pulses.left)));
  message.add(checked(maestro::set_target(options_.right_channel, pulses.right)));
  if (!talk_.say(message, now)) {
    ++counts_.short_writes;
    silence_ours_ = silence_ours_ || question_.silence_ours;
    return false;
  }
  sent_ = pulses;
  spoke_at_ = now;
  return true;
}

Packet Maestro::checked(const Packet& packet) const noexcept {
  return options_.crc ? maestro::with_crc(packet) : packet;
}

Maestro::Pulses Maestro::stopped(Time now) noexcept {
  left_.stopped(now);
  right_.stopped(now);
  return {pulse(0.0), pulse(0.0)};
}

Maestro::Pulses Maestro::shaped(const ThrustCommand& command, Time now) noexcept {
  const double left = left_.shape(thrust_share(command.left), now);
  const double right = right_.shape(thrust_share(command.right), now);
  return {pulse(options_.left_reversed ? -left : left),
          pulse(options_.right_reversed ? -right : right)};
}

std::uint16_t Maestro::pulse(double share) const noexcept {
  const double pulse_us = options_.neutral_us + options_.range_us * share;
  return static_cast<std::uint16_t>(std::lround(pulse_us * maestro::kQuartersPerMicrosecond));
}

bool Maestro::is_far(std::uint16_t found, std::uint16_t sent) const noexcept {
  return std::abs(found - sent) > kFarShare * options_.range_us * maestro::kQuartersPerMicrosecond;
}

// Where outputs go at start-up: to neutral, or off.
bool Maestro::is_home(std::uint16_t found) const noexcept {
  return found == 0 || is_neutral_pulse(found);
}

bool Maestro::is_neutral_pulse(std::uint16_t found) const noexcept {
  return std::abs(found - pulse(0.0)) <= kNeutralTolerance_quarter_us;
}

}  // namespace lodesman
