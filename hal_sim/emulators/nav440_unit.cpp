// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/emulators/nav440_unit.h"

#include <algorithm>

namespace lodesman {

using emulated::Bytes;
using emulated::Nav440Settings;
using emulated::u16_at;
using emulated::uu_type;
using emulated::UuCommand;

namespace {

constexpr std::uint16_t kNak = 0x1515;
constexpr std::array<std::uint16_t, 7> kDataPackets{
    uu_type('S', '0'), uu_type('S', '1'), uu_type('A', '0'), uu_type('A', '1'),
    uu_type('A', '2'), uu_type('N', '0'), uu_type('N', '1')};

// Between the echo of a software reset and the reset.
constexpr Duration kResetPause = std::chrono::milliseconds{10};
// What the unit holds for its line before it drops packets (ours).
constexpr int kSendBuffer_bytes = 256;

// Orders of the magnetic calibration.
constexpr std::uint16_t kCalibrateUntilStopped = 0x0009;
constexpr std::uint16_t kCalibrateStop = 0x000B;
constexpr std::uint16_t kCalibrateUntilTurned = 0x000C;
constexpr std::uint16_t kCalibrateStore = 0x000E;

[[nodiscard]] std::uint16_t usual_packet(std::string_view model) noexcept {
  return model.starts_with("AHRS") ? uu_type('A', '1')
         : model.starts_with("VG") ? uu_type('A', '2')
                                   : uu_type('N', '1');
}

}  // namespace

Nav440Unit::Nav440Unit(const Nav440UnitOptions& options, Time now, Duration on_for)
    : options_{options},
      stored_{options.divider, options.baud_code,
              options.packet_type == 0 ? usual_packet(options.model) : options.packet_type},
      live_{stored_},
      flicker_{"nav440 flicker", options.seed},
      spikes_{"nav440 spike", options.seed} {
  turn_on(now - on_for);
  settling_since_ = power_on_;
  while (time_of_tick(next_tick_) <= now) {
    ++next_tick_;
  }
  sent_until_ = now;
}

void Nav440Unit::turn_on(Time at) noexcept {
  power_on_ = at;
  settling_since_ = at;
  next_tick_ = 1;
  counter_ = 0;
  sent_until_ = at;
  yaw_at_power_on_rad_ = heading_true_rad(at);
}

void Nav440Unit::power_cycle(Time now) {
  live_ = stored_;
  receiver_.clear();
  resets_at_.reset();
  overflowed_.reset();
  frozen_.reset();
  calibration_ = Calibration::kNone;
  turn_on(now);
}

void Nav440Unit::step(Time now, std::vector<Utterance>& said) {
  if (is_off()) {
    return;
  }
  const auto from = static_cast<std::ptrdiff_t>(said.size());
  std::vector<UuCommand> commands;
  receiver_.pass(now, commands);
  for (const UuCommand& command : commands) {
    obey(command, said);
  }
  reset_at_begin_of(now, said);
  tick_until(now, said);
  std::stable_sort(said.begin() + from, said.end(),
                   [](const Utterance& a, const Utterance& b) { return a.begins < b.begins; });
}

void Nav440Unit::receive(std::span<const std::uint8_t> bytes, Time at,
                         std::vector<Utterance>& said) {
  if (is_off()) {
    return;
  }
  std::vector<UuCommand> commands;
  for (const std::uint8_t byte : bytes) {
    receiver_.take(byte, at, commands);
  }
  for (const UuCommand& command : commands) {
    obey(command, said);
  }
}

void Nav440Unit::reset_at_begin_of(Time now, std::vector<Utterance>& said) {
  if (resets_at_ && *resets_at_ <= now) {
    const Time at = *resets_at_;
    tick_until(at, said);
    power_cycle(at);
  }
}

void Nav440Unit::tick_until(Time until, std::vector<Utterance>& said) {
  for (Time at = time_of_tick(next_tick_); at <= until; at = time_of_tick(next_tick_)) {
    tick(at, said);
    ++next_tick_;
  }
}

void Nav440Unit::tick(Time at, std::vector<Utterance>& said) {
  watch_turn(at, said);
  const std::uint16_t divider = live_.at(emulated::kFieldDivider);
  if (divider == 0 || next_tick_ % divider != 0) {
    return;
  }
  const std::uint16_t type = live_.at(emulated::kFieldPacketType);
  const Duration held_max =
      std::chrono::nanoseconds{std::chrono::seconds{kSendBuffer_bytes * kBitsAByte}} / live_.baud();
  if (sent_until_ > at + held_max) {
    overflowed_ = at;
    return;
  }
  say(type, emulated::data_payload(type, values_for(type, at)), at, said);
  ++counter_;
}

void Nav440Unit::say(std::uint16_t type, const Bytes& payload, Time at,
                     std::vector<Utterance>& said) {
  said.push_back({at, emulated::uu_frame(type, payload)});
  const auto bits = static_cast<std::int64_t>(said.back().bytes.size()) * kBitsAByte;
  sent_until_ = std::max(sent_until_, at) +
                std::chrono::nanoseconds{std::chrono::seconds{bits}} / live_.baud();
}

void Nav440Unit::echo(const UuCommand& command, std::vector<Utterance>& said) {
  say(command.type, command.payload, command.whole, said);
}

void Nav440Unit::refuse(const UuCommand& command, std::vector<Utterance>& said) {
  Bytes refused;
  emulated::put_u16(refused, command.type);
  say(kNak, refused, command.whole, said);
}

void Nav440Unit::obey(const UuCommand& command, std::vector<Utterance>& said) {
  const bool is_bare = command.payload.empty();
  switch (command.type) {
    case uu_type('C', 'H'): echo(command, said); return;
    case uu_type('G', 'P'): give_packet(command, said); return;
    case uu_type('S', 'F'):
    case uu_type('W', 'F'): set_fields(command, said); return;
    case uu_type('G', 'F'):
    case uu_type('R', 'F'): give_fields(command, said); return;
    case uu_type('W', 'C'): calibrate(command, said); return;
    case uu_type('P', 'K'):
    case uu_type('A', 'R'):
    case uu_type('S', 'R'):
      if (is_bare) {
        break;
      }
      [[fallthrough]];
    default: refuse(command, said); return;
  }
  echo(command, said);
  if (command.type == uu_type('A', 'R')) {
    settling_since_ = command.whole;
  } else if (command.type == uu_type('S', 'R')) {
    resets_at_ = command.whole + kResetPause;
  }
}

void Nav440Unit::give_packet(const UuCommand& command, std::vector<Utterance>& said) {
  const Time at = command.whole;
  const std::uint16_t type = command.payload.size() == 2 ? u16_at(command.payload, 0) : 0;
  if (type == uu_type('I', 'D')) {
    say(type, emulated::identity_payload(options_.serial_number, options_.model), at, said);
  } else if (type == uu_type('V', 'R')) {
    say(type, {options_.version.begin(), options_.version.end()}, at, said);
  } else if (type == uu_type('T', '0')) {
    say(type, emulated::test_payload(built_in_test(at)), at, said);
  } else if (offers(type)) {
    say(type, emulated::data_payload(type, values_for(type, at)), at, said);
  } else {
    refuse(command, said);
  }
}

// The manual: of several fields those that are right are set, and a refusal follows for the rest.
void Nav440Unit::set_fields(const UuCommand& command, std::vector<Utterance>& said) {
  const Bytes& asked = command.payload;
  if (asked.empty() || asked.size() != 1 + 4 * std::size_t{asked[0]}) {
    refuse(command, said);
    return;
  }
  Nav440Settings& settings = command.type == uu_type('S', 'F') ? live_ : stored_;
  Bytes done{0};
  for (std::size_t at = 1; at < asked.size(); at += 4) {
    const std::uint16_t id = u16_at(asked, at);
    const std::uint16_t value = u16_at(asked, at + 2);
    if (takes(settings, id, value)) {
      settings.set(id, value);
      ++done[0];
      emulated::put_u16(done, id);
    }
  }
  if (done[0] > 0 || asked[0] == 0) {
    say(command.type, done, command.whole, said);
  }
  if (done[0] < asked[0]) {
    refuse(command, said);
  }
}

void Nav440Unit::give_fields(const UuCommand& command, std::vector<Utterance>& said) {
  const Bytes& asked = command.payload;
  if (asked.empty() || asked.size() != 1 + 2 * std::size_t{asked[0]}) {
    refuse(command, said);
    return;
  }
  const Nav440Settings& settings = command.type == uu_type('G', 'F') ? live_ : stored_;
  Bytes told{0};
  for (std::size_t at = 1; at < asked.size(); at += 2) {
    const std::uint16_t id = u16_at(asked, at);
    // A reply has room for 63 fields.
    if (Nav440Settings::has(id) && told[0] < 63) {
      ++told[0];
      emulated::put_u16(told, id);
      emulated::put_u16(told, settings.at(id));
    }
  }
  if (told[0] > 0 || asked[0] == 0) {
    say(command.type, told, command.whole, said);
  }
  if (told[0] < asked[0]) {
    refuse(command, said);
  }
}

void Nav440Unit::calibrate(const UuCommand& command, std::vector<Utterance>& said) {
  const std::uint16_t order = command.payload.size() == 2 ? u16_at(command.payload, 0) : 0;
  switch (order) {
    case kCalibrateUntilStopped: calibration_ = Calibration::kUntilStopped; break;
    case kCalibrateUntilTurned: calibration_ = Calibration::kUntilTurned; break;
    case kCalibrateStop:
      if (calibration_ == Calibration::kNone) {
        refuse(command, said);
        return;
      }
      calibration_ = Calibration::kNone;
      break;
    case kCalibrateStore: break;
    default: refuse(command, said); return;
  }
  turned_rad_ = 0.0;
  turned_heading_rad_ = heading_true_rad(command.whole);
  echo(command, said);
}

bool Nav440Unit::offers(std::uint16_t type) const noexcept {
  const bool is_packet =
      std::find(kDataPackets.begin(), kDataPackets.end(), type) != kDataPackets.end();
  // A vertical gyro has no magnetometer.
  const bool needs_field =
      type == uu_type('A', '0') || type == uu_type('A', '1') || type == uu_type('S', '0');
  return is_packet && !(needs_field && options_.model.starts_with("VG"));
}

bool Nav440Unit::takes(const Nav440Settings& settings, std::uint16_t id,
                       std::uint16_t value) const {
  if (!Nav440Settings::has(id) || !Nav440Settings::allows(id, value) ||
      (id == emulated::kFieldPacketType && !offers(value))) {
    return false;
  }
  Nav440Settings would_be = settings;
  would_be.set(id, value);
  const auto type = would_be.at(emulated::kFieldPacketType);
  const bool is_of_the_line = id <= emulated::kFieldPacketType;
  return !options_.newer_firmware || !is_of_the_line ||
         would_be.fits(emulated::data_payload(type, {}).size());
}

bool Nav440Unit::has_fault(FaultKind kind) const noexcept {
  switch (kind) {
    case FaultKind::kPower:
    case FaultKind::kFrozen:
    case FaultKind::kStep:
    case FaultKind::kDrift:
    case FaultKind::kSpike:
    case FaultKind::kInvalid:
    case FaultKind::kMagnetic:
    case FaultKind::kBit: return true;
    default: return false;
  }
}

}  // namespace lodesman
