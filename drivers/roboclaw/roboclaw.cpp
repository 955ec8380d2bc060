// SPDX-License-Identifier: Apache-2.0
#include "drivers/roboclaw/roboclaw.h"

#include <cmath>

#include "drivers/hal/thrust_scale.h"
#include "mid_level/base/startup_error.h"

namespace lodesman {

using roboclaw::Command;
using roboclaw::Outcome;

namespace {

constexpr Duration kTimeOutUnit = std::chrono::milliseconds{100};

[[nodiscard]] RoboClawOptions sound(const RoboClawOptions& options) {
  if (options.address < roboclaw::kFirstAddress || options.address > roboclaw::kLastAddress) {
    throw StartupError("the address of a RoboClaw is 128 to 135");
  }
  if (options.time_out < kTimeOutUnit || options.time_out % kTimeOutUnit != Duration::zero()) {
    throw StartupError("the time-out of a RoboClaw must be in whole tenths of a second");
  }
  return options;
}

}  // namespace

RoboClaw::RoboClaw(ByteStream& stream, const RoboClawOptions& options,
                   const ThrustShapeOptions& shape)
    : stream_{stream},
      options_{sound(options)},
      left_{shape},
      right_{shape},
      exchange_{stream, options.address} {}

CommandStatus RoboClaw::command(ThrustCommand command, Time now) noexcept {
  if (!follow_connection(now)) {
    return CommandStatus::kDisconnected;
  }
  const Outcome outcome = exchange_.listen(now);
  const CommandStatus status = step(outcome, command, now);
  if (stream_.connection(now) != connection_) {  // reading or writing has shown it
    lose_connection(now);
    return CommandStatus::kDisconnected;
  }
  return status;
}

bool RoboClaw::follow_connection(Time now) noexcept {
  const std::uint64_t connection = stream_.connection(now);
  if (connection == 0) {
    lose_connection(now);
    return false;
  }
  if (connection != connection_) {
    connection_ = connection;
    exchange_.begin();
    identified_ = false;
    failed_ = DeviceFault::kNone;
    start_over(now);
  }
  return true;
}

void RoboClaw::lose_connection(Time now) noexcept {
  connection_ = 0;
  static_cast<void>(stopped(now));
  const DeviceFault line = stream_.fault();
  fault_ = line == DeviceFault::kNone ? DeviceFault::kStarting : line;
  if (state_ != State::kDisconnected) {
    enter(State::kDisconnected, now);
  }
}

CommandStatus RoboClaw::step(Outcome outcome, const ThrustCommand& command, Time now) noexcept {
  switch (state_) {
    case State::kDisconnected: break;
    case State::kIdentifying:
    case State::kStopping:
    case State::kSetting:
    case State::kReadingTimeOut:
    case State::kReadingDuties:
    case State::kReadingStatus: start_up(outcome, now); break;
    case State::kPausing: pause(now); break;
    case State::kHolding:
    case State::kReady: return serve(outcome, command, now);
    case State::kRegaining: return regain(outcome, command, now);
    case State::kResting: rest(now); break;
  }
  return CommandStatus::kNotReady;
}

CommandStatus RoboClaw::serve(Outcome outcome, const ThrustCommand& command, Time now) noexcept {
  if (now - spoke_at_ >= options_.time_out) {
    static_cast<void>(stopped(now));  // it stopped them by itself
  }
  const bool duty = roboclaw::is_write(exchange_.command());
  switch (outcome) {
    case Outcome::kNone: break;
    case Outcome::kAwaited:
      if (is_neutral(command) && sent_ != Duties{}) {
        stop_and_regain(now);
        return sent_ == Duties{} ? CommandStatus::kTaken : CommandStatus::kNotReady;
      }
      return state_ == State::kReady ? CommandStatus::kTaken : CommandStatus::kNotReady;
    case Outcome::kGood:
      lost_ = duty ? 0 : lost_;
      counts_.acknowledged += duty && state_ == State::kReady ? 1 : 0;
      if (!duty) {
        read_back(now);
      }
      break;
    case Outcome::kLost:
      if (!duty) {
        ++counts_.lost;
        if (++reads_lost_ >= kMaxLost) {
          give_up(DeviceFault::kNoAnswer, now);
        }
      } else if (lost_once_more()) {
        give_up(DeviceFault::kNoAnswer, now);
      } else {
        stop_and_regain(now);
        return CommandStatus::kNotReady;
      }
      break;
  }
  if (state_ == State::kResting) {
    rest(now);
    return CommandStatus::kNotReady;
  }
  return speak(command, now);
}

// A reset may have cost the box its time-out, and then it would run on for ever.
void RoboClaw::read_back(Time now) noexcept {
  reads_lost_ = 0;
  if (exchange_.command() == Command::kReadMainBattery) {
    battery_ = {now, roboclaw::unsigned_of(exchange_.data()) * roboclaw::kBatteryUnit_volts};
  } else if (roboclaw::unsigned_of(exchange_.data()) != time_out_units()) {
    ++counts_.resets;
    give_up(DeviceFault::kBoxReset, now);
  }
}

// The duties, or what is to be read in their place: one exchange.
CommandStatus RoboClaw::speak(const ThrustCommand& command, Time now) noexcept {
  if (state_ == State::kHolding && (is_neutral(command) || !options_.neutral_first)) {
    enter(State::kReady, now);
    failed_ = DeviceFault::kNone;
    ++counts_.starts;
  }
  const bool ready = state_ == State::kReady;
  const Duties duties = ready ? shaped(command, now) : stopped(now);
  const bool reads = read_is_due(command, now);
  if (!(reads ? read(read_battery_ ? Command::kReadTimeOut : Command::kReadMainBattery, now)
              : drive(duties, now))) {
    fault_ = DeviceFault::kLineFull;
    return CommandStatus::kNotReady;
  }
  if (reads) {
    read_at_ = now;
    read_battery_ = !read_battery_;
  }
  if (!ready) {
    tell(DeviceFault::kStarting);
    return CommandStatus::kNotReady;
  }
  counts_.duties += reads ? 0 : 1;
  fault_ = DeviceFault::kNone;
  return CommandStatus::kTaken;
}

bool RoboClaw::read_is_due(const ThrustCommand& command, Time now) const noexcept {
  const bool stops = is_neutral(command) && sent_ != Duties{};
  return now - read_at_ >= kReadPeriod && !stops;
}

// Nobody can tell whose the next acknowledges will be, so none is waited for.
void RoboClaw::stop_and_regain(Time now) noexcept {
  stop_unheard(now);
  served_ = state_ == State::kRegaining ? served_ : state_;
  enter(State::kRegaining, now);
}

void RoboClaw::stop_unheard(Time now) noexcept {
  exchange_.abandon();
  static_cast<void>(drive(stopped(now), now));
  exchange_.abandon();
}

CommandStatus RoboClaw::regain(Outcome outcome, const ThrustCommand& command, Time now) noexcept {
  if (sent_ != Duties{}) {  // the line was full
    stop_unheard(now);
  } else if (outcome == Outcome::kGood) {
    read_back(now);
    if (state_ != State::kResting) {
      enter(served_, now);
      return speak(command, now);
    }
  } else if (outcome == Outcome::kLost) {
    if (lost_once_more()) {
      give_up(DeviceFault::kNoAnswer, now);
    } else {
      stop_and_regain(now);
    }
  } else if (outcome == Outcome::kNone) {
    await_silence(now);
  }
  if (state_ == State::kResting) {
    rest(now);
    return CommandStatus::kNotReady;
  }
  // Stopped because it was told to, not because something is missing.
  const bool as_commanded = served_ == State::kReady && lost_ == 0 && is_neutral(command);
  return as_commanded ? CommandStatus::kTaken : CommandStatus::kNotReady;
}

// Stop is said a few times, since what was lost may have been lost on its way there. Then nothing,
// until no acknowledge can come any more, and at last a question, whose answer is no acknowledge.
void RoboClaw::await_silence(Time now) noexcept {
  if (exchange_.owed() == 0 || now - spoke_at_ >= kLateLimit) {
    exchange_.forget_owed();
    static_cast<void>(read(Command::kReadTimeOut, now));
  } else if (now - since_ < roboclaw::Exchange::kReplyWait) {
    stop_unheard(now);
  }
}

void RoboClaw::rest(Time now) noexcept {
  // Nothing is said to what is perhaps no RoboClaw.
  if (identified_) {
    stop_unheard(now);
  }
  if (now - since_ >= kRest) {
    start_over(now);
  }
}

void RoboClaw::enter(State state, Time now) noexcept {
  state_ = state;
  since_ = now;
}

void RoboClaw::start_over(Time now) noexcept {
  exchange_.forget_owed();
  strays_before_ = exchange_.stray_bytes();
  lost_ = 0;
  tell(DeviceFault::kStarting);
  static_cast<void>(stopped(now));
  enter(State::kIdentifying, now);
}

void RoboClaw::give_up(DeviceFault why, Time now) noexcept {
  fault_ = failed_ = why;
  enter(State::kResting, now);
}

bool RoboClaw::lost_once_more() noexcept {
  ++counts_.lost;
  return ++lost_ >= kMaxLost;
}

void RoboClaw::tell(DeviceFault starting) noexcept {
  fault_ = failed_ == DeviceFault::kNone ? starting : failed_;
}

bool RoboClaw::read(Command command, Time now) noexcept {
  const bool sent = exchange_.send(command, roboclaw::read_request(options_.address, command), now);
  counts_.short_writes += sent ? 0 : 1;
  return sent;
}

bool RoboClaw::drive(const Duties& duties, Time now) noexcept {
  if (!exchange_.send(Command::kDutyBoth,
                      roboclaw::duty_both(options_.address, duties.first, duties.second), now)) {
    ++counts_.short_writes;
    return false;
  }
  sent_ = duties;
  spoke_at_ = now;
  return true;
}

RoboClaw::Duties RoboClaw::stopped(Time now) noexcept {
  left_.stopped(now);
  right_.stopped(now);
  return {};
}

RoboClaw::Duties RoboClaw::shaped(const ThrustCommand& command, Time now) noexcept {
  const auto duty = [](double share) {
    return static_cast<std::int16_t>(std::lround(share * roboclaw::kFullDuty));
  };
  const double left = left_.shape(thrust_share(command.left), now);
  const double right = right_.shape(thrust_share(command.right), now);
  const std::int16_t of_left = duty(options_.left_reversed ? -left : left);
  const std::int16_t of_right = duty(options_.right_reversed ? -right : right);
  return options_.swap ? Duties{of_right, of_left} : Duties{of_left, of_right};
}

std::uint8_t RoboClaw::time_out_units() const noexcept {
  return static_cast<std::uint8_t>(options_.time_out / kTimeOutUnit);
}

}  // namespace lodesman
