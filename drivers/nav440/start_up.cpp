// SPDX-License-Identifier: Apache-2.0
#include "drivers/nav440/start_up.h"

#include <algorithm>

namespace lodesman::nav440 {
namespace {

using std::chrono::milliseconds;

// A whole round of speeds, even where there is but one: so long a unit may take to wake up.
constexpr int kRound = 4;
// One such frame may be damage that looks like it.
constexpr int kForeignFrames = 2;

// OpenIMU units frame as this family does; their types begin with a small letter.
[[nodiscard]] bool is_foreign(PacketType type) noexcept {
  const auto first = static_cast<std::uint8_t>(type >> 8U);
  return type == kForeignNak || (first >= 'a' && first <= 'z');
}

[[nodiscard]] bool refuses(const Nav440Frame& frame, PacketType request) noexcept {
  const Packet packet = decoded(frame.type, frame.payload);
  const auto* nak = std::get_if<Nak>(&packet);
  return nak != nullptr && nak->refused == request;
}

}  // namespace

struct StartUp::Rule {
  State state;
  Duration time_out;  // of one try
  int tries;
  State on_answer;
  State on_refusal;
  DeviceFault refusal;  // what a refusal means
  State on_time_out;    // after the last try
  DeviceFault silence;  // what that means
};

// kFinding as the state that follows a time-out means: at the next speed. kNone: nothing has
// failed.
const std::array<StartUp::Rule, 12> StartUp::kRules = [] {
  using enum State;
  using enum DeviceFault;
  return std::array<Rule, 12>{{
      {kFinding, milliseconds{150}, 3, kQuieting, kResting, kWrongDevice, kFinding, kNone},
      {kQuieting, milliseconds{250}, 4, kSettling, kResting, kSettingRefused, kFinding, kNoAnswer},
      {kSettling, milliseconds{100}, 1, kSettling, kSettling, kNone, kIdentifying, kNone},
      {kIdentifying, milliseconds{250}, 4, kAskingVersion, kResting, kWrongDevice, kResting,
       kWrongDevice},
      {kAskingVersion, milliseconds{250}, 4, kSettingSpeed, kSettingSpeed, kNone, kSettingSpeed,
       kNone},
      // The answer comes at the new speed already, or not at all: the ping tells.
      {kSettingSpeed, milliseconds{100}, 1, kConfirmingSpeed, kResting, kSettingRefused,
       kConfirmingSpeed, kNone},
      {kConfirmingSpeed, milliseconds{150}, 3, kSettingPacket, kConfirmingSpeed, kNone, kFinding,
       kSettingRefused},
      {kSettingPacket, milliseconds{250}, 4, kReadingBack, kResting, kSettingRefused, kFinding,
       kNoAnswer},
      {kReadingBack, milliseconds{250}, 4, kAwaitingStream, kResting, kSettingRefused, kFinding,
       kNoAnswer},
      {kAwaitingStream, milliseconds{2500}, 1, kStreaming, kAwaitingStream, kNone, kFinding,
       kNoAnswer},
      {kStreaming, Duration::zero(), 0, kStreaming, kStreaming, kNone, kStreaming, kNone},
      {kResting, milliseconds{1000}, 1, kResting, kResting, kNone, kFinding, kNone},
  }};
}();

StartUp::StartUp(ByteStream& stream, const Nav440Options& options) noexcept
    : stream_{stream}, options_{options}, packet_{first_choice(options.packet)} {
  speeds_[0] = options.baud;
  std::copy_if(kNav440Speeds_baud.begin(), kNav440Speeds_baud.end(), speeds_.begin() + 1,
               [&](int baud) { return baud != options.baud; });
  if (options_.line_has_speed) {
    stream_.reconnect(options.baud);
  }
}

const StartUp::Rule& StartUp::rule() const noexcept {
  return kRules[static_cast<std::size_t>(state_)];
}

DeviceFault StartUp::fault() const noexcept {
  if (streaming()) {
    return DeviceFault::kNone;
  }
  return failure_ == DeviceFault::kNone ? DeviceFault::kStarting : failure_;
}

void StartUp::connected(Time now) noexcept {
  if (!awaits_connection_) {
    failure_ = DeviceFault::kNone;
    speeds_tried_ = 0;
    state_ = State::kFinding;
  }
  awaits_connection_ = false;
  enter(state_, now);
}

void StartUp::begin_again(DeviceFault why, Time now) noexcept {
  failure_ = why;
  speeds_tried_ = 0;
  if (awaits_connection_) {
    state_ = State::kFinding;
    return;
  }
  enter(State::kFinding, now);
}

void StartUp::hear(const Nav440Frame& frame, Time now) noexcept {
  if (!awaits_connection_) {
    if (const Event event = event_of(frame); event != Event::kNone) {
      happen(event, now);
    }
  }
}

StartUp::Event StartUp::event_of(const Nav440Frame& frame) noexcept {
  switch (state_) {
    case State::kFinding:
      if (!is_foreign(frame.type)) {
        return Event::kAnswered;
      }
      return ++foreign_ >= kForeignFrames ? Event::kRefused : Event::kNone;
    case State::kConfirmingSpeed: return frame.type == kPing ? Event::kAnswered : Event::kNone;
    case State::kAwaitingStream: return frame.type == packet_ ? Event::kAnswered : Event::kNone;
    case State::kIdentifying:
    case State::kAskingVersion: return event_of_identity(frame);
    case State::kQuieting:
    case State::kSettingSpeed:
    case State::kSettingPacket:
    case State::kReadingBack: return event_of_fields(frame);
    case State::kSettling:
    case State::kStreaming:
    case State::kResting: break;
  }
  return Event::kNone;
}

StartUp::Event StartUp::event_of_identity(const Nav440Frame& frame) noexcept {
  const Packet packet = decoded(frame.type, frame.payload);
  if (const auto* who = std::get_if<Identity>(&packet); who && state_ == State::kIdentifying) {
    identity_ = {};
    identity_.known = true;
    identity_.serial = who->serial;
    std::copy_n(who->model.begin(), std::min(who->model.size(), identity_.model.size() - 1),
                identity_.model.begin());
    return Event::kAnswered;
  }
  if (const auto* version = std::get_if<Version>(&packet);
      version && state_ == State::kAskingVersion) {
    identity_.version = *version;
    return Event::kAnswered;
  }
  return refuses(frame, kGetPacket) ? Event::kRefused : Event::kNone;
}

// Where a part of the fields is refused, those that are taken are listed first, and a NAK follows.
StartUp::Event StartUp::event_of_fields(const Nav440Frame& frame) const noexcept {
  const PacketType asked = state_ == State::kReadingBack ? kGetFields : kSetFields;
  if (refuses(frame, asked)) {
    return Event::kRefused;
  }
  const std::optional<Fields> fields =
      frame.type == asked ? Fields::in(frame.payload) : std::nullopt;
  if (!fields) {
    return Event::kNone;
  }
  switch (state_) {
    case State::kQuieting: return fields->contain(kRateDivider) ? Event::kAnswered : Event::kNone;
    case State::kSettingSpeed: return fields->contain(kSpeedCode) ? Event::kAnswered : Event::kNone;
    case State::kSettingPacket:
      return fields->contain(kContinuousType) && fields->contain(kRateDivider) ? Event::kAnswered
                                                                               : Event::kNone;
    default: break;
  }
  const auto type = fields->value_of(kContinuousType);
  const auto divider = fields->value_of(kRateDivider);
  if (!type || !divider) {
    return Event::kNone;
  }
  return *type == packet_ && *divider == kFullRate_hz / options_.rate_hz ? Event::kAnswered
                                                                         : Event::kRefused;
}

void StartUp::happen(Event event, Time now) noexcept {
  const Rule& rule = this->rule();
  switch (event) {
    case Event::kNone: return;
    case Event::kAnswered:
      speeds_tried_ = 0;
      enter(rule.on_answer, now);
      return;
    case Event::kRefused:
      if (takes_another_packet()) {
        enter(State::kSettingPacket, now);
        return;
      }
      failure_ = rule.refusal == DeviceFault::kNone ? failure_ : rule.refusal;
      enter(rule.on_refusal, now);
      return;
    case Event::kTimedOut:
      failure_ = is_sending_                          ? DeviceFault::kLineFull
                 : rule.silence == DeviceFault::kNone ? failure_
                                                      : rule.silence;
      if (rule.on_time_out == State::kFinding && rule.state != State::kResting) {
        try_next_speed(now);
      } else {
        enter(rule.on_time_out, now);
      }
      return;
  }
}

bool StartUp::takes_another_packet() noexcept {
  const bool is_left = options_.packet == Nav440Packet::kAuto && packet_ == kA1 &&
                       (state_ == State::kSettingPacket || state_ == State::kReadingBack);
  packet_ = is_left ? kA0 : packet_;
  return is_left;
}

bool StartUp::needs_another_speed() const noexcept {
  return options_.line_has_speed && speed_ != 0 &&
         options_.rate_hz > most_packets_hz(packet_, baud());
}

void StartUp::enter(State state, Time now) noexcept {
  if (state == State::kFinding) {
    packet_ = first_choice(options_.packet);
    foreign_ = 0;
    identity_ = {};
  } else if (state == State::kSettingSpeed && !needs_another_speed()) {
    state = State::kSettingPacket;
  } else if (state == State::kStreaming) {
    failure_ = DeviceFault::kNone;
    ++streams_;
  }
  const bool changes_speed = state == State::kConfirmingSpeed && state_ == State::kSettingSpeed;
  state_ = state;
  if (changes_speed) {
    speak_at(0);
    return;
  }
  tries_left_ = rule().tries;
  due_ = now;  // with the next step
}

void StartUp::try_next_speed(Time now) noexcept {
  if (++speeds_tried_ >= kRound) {
    speeds_tried_ = 0;
    failure_ = failure_ == DeviceFault::kNone ? DeviceFault::kNoAnswer : failure_;
  }
  if (!options_.line_has_speed) {
    enter(State::kFinding, now);
    return;
  }
  state_ = State::kFinding;
  speak_at((speed_ + 1) % speeds_.size());
}

void StartUp::speak_at(std::size_t speed) noexcept {
  speed_ = speed;
  is_sending_ = false;
  awaits_connection_ = true;
  stream_.reconnect(baud());
}

void StartUp::step(Time now) noexcept {
  if (awaits_connection_ || state_ == State::kStreaming) {
    return;
  }
  write_on(now);
  if (now >= due_ && tries_left_ == 0) {
    happen(Event::kTimedOut, now);
  }
  if (now >= due_ && tries_left_ > 0 && !awaits_connection_) {
    --tries_left_;
    due_ = now + rule().time_out;
    request(now);
  }
}

// One that is half on its way is sent to its end first: a torn one would swallow the next.
void StartUp::request(Time now) noexcept {
  if (is_sending_) {
    return;
  }
  const auto divider = static_cast<std::uint16_t>(kFullRate_hz / options_.rate_hz);
  switch (state_) {
    case State::kFinding:
    case State::kConfirmingSpeed: outgoing_ = Command::ping(); break;
    case State::kQuieting: outgoing_ = Command::set_fields({{kRateDivider, 0}}); break;
    case State::kIdentifying: outgoing_ = Command::get_packet(kIdentity); break;
    case State::kAskingVersion: outgoing_ = Command::get_packet(kVersion); break;
    case State::kSettingSpeed:
      outgoing_ = Command::set_fields({{kSpeedCode, speed_code(options_.baud).value_or(0)}});
      break;
    case State::kSettingPacket:
      outgoing_ = Command::set_fields({{kContinuousType, packet_}, {kRateDivider, divider}});
      break;
    case State::kReadingBack:
      outgoing_ = Command::get_fields({kContinuousType, kRateDivider});
      break;
    case State::kSettling:
    case State::kAwaitingStream:
    case State::kStreaming:
    case State::kResting: return;
  }
  sent_ = 0;
  is_sending_ = true;
  write_on(now);
}

void StartUp::write_on(Time now) noexcept {
  if (is_sending_) {
    sent_ += stream_.write(outgoing_.bytes().subspan(sent_), now);
    is_sending_ = sent_ < outgoing_.bytes().size();
  }
}

}  // namespace lodesman::nav440
