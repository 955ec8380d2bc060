// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/emulators/maestro_box.h"

#include <algorithm>

namespace lodesman {
namespace {

constexpr std::uint8_t kCommandBit = 0x80;
constexpr std::uint8_t kPololu = 0xAA;
constexpr std::uint8_t kMiniSsc = 0xFF;

constexpr std::uint8_t kSetTarget = 0x84;
constexpr std::uint8_t kSetSpeed = 0x87;
constexpr std::uint8_t kSetAcceleration = 0x89;
constexpr std::uint8_t kSetPwm = 0x8A;
constexpr std::uint8_t kGetPosition = 0x90;
constexpr std::uint8_t kGetMoving = 0x93;
constexpr std::uint8_t kSetTargets = 0x9F;
constexpr std::uint8_t kGetErrors = 0xA1;
constexpr std::uint8_t kGoHome = 0xA2;
constexpr std::uint8_t kStopScript = 0xA4;
constexpr std::uint8_t kRunScript = 0xA7;
constexpr std::uint8_t kRunScriptWith = 0xA8;
constexpr std::uint8_t kGetScriptStatus = 0xAE;
constexpr std::uint8_t kScriptStopped = 1;

constexpr std::size_t kMicroChannels = 6;
constexpr Duration kTimeOutUnit = std::chrono::milliseconds{10};
constexpr int kNeutral8 = 127;
// What random faults raise.
constexpr std::array<MaestroBox::Error, 3> kRandomErrors{
    MaestroBox::Error::kCrc, MaestroBox::Error::kProtocol, MaestroBox::Error::kTimeOut};

// Polynomial 0x91, the low bit first.
[[nodiscard]] std::uint8_t crc7(std::span<const std::uint8_t> bytes) noexcept {
  unsigned crc = 0;
  for (const std::uint8_t byte : bytes) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit) {
      crc = ((crc & 1U) != 0 ? crc ^ 0x91U : crc) >> 1U;
    }
  }
  return static_cast<std::uint8_t>(crc);
}

[[nodiscard]] constexpr std::uint16_t from_sevens(std::uint8_t low, std::uint8_t high) noexcept {
  return static_cast<std::uint16_t>(low | (high << 7));
}

// How many bytes follow the head of a command; of several targets, all but those. Nothing for a
// number that is no command of this box.
[[nodiscard]] std::optional<std::size_t> data_of(std::uint8_t number, bool is_micro) noexcept {
  switch (number) {
    case kSetTarget:
    case kSetSpeed:
    case kSetAcceleration:
    case kRunScriptWith: return 3;
    case kGetPosition:
    case kRunScript: return 1;
    case kGetMoving:
    case kGetErrors:
    case kGoHome:
    case kStopScript:
    case kGetScriptStatus: return 0;
    case kSetTargets: return is_micro ? std::nullopt : std::optional<std::size_t>{2};
    case kSetPwm: return is_micro ? std::nullopt : std::optional<std::size_t>{4};
    default: return std::nullopt;
  }
}

void say(std::vector<Utterance>& said, Time at, std::initializer_list<std::uint8_t> bytes) {
  said.push_back({at, bytes});
}

void say_u16(std::vector<Utterance>& said, Time at, std::uint16_t value) {
  say(said, at, {static_cast<std::uint8_t>(value & 0xFFU), static_cast<std::uint8_t>(value >> 8U)});
}

}  // namespace

MaestroBox::MaestroBox(const MaestroBoxOptions& options, Time now)
    : options_{options}, random_errors_{"maestro error", options.seed} {
  power_cycle(now);
}

std::uint16_t MaestroBox::pulse_quarter_us(std::size_t channel) const noexcept {
  return is_off() || channel >= options_.channels ? std::uint16_t{0} : pulses_[channel];
}

void MaestroBox::power_cycle(Time now) {
  brown_out(now);
  go_home();
}

void MaestroBox::brown_out(Time now) noexcept {
  pulses_.fill(0);
  errors_ = 0;
  held_.clear();
  stepped_ = now;
  rearm(now);
}

void MaestroBox::begun(const Fault& fault, Time now) {
  if (fault.kind == FaultKind::kReset) {
    brown_out(now);
  }
}

void MaestroBox::step(Time now, std::vector<Utterance>& /*said*/) {
  if (!is_off()) {
    watch_time_out(now);
    err_at_random(now);
  }
  stepped_ = now;
}

void MaestroBox::watch_time_out(Time now) noexcept {
  const bool has_one = options_.time_out_10ms > 0 && running(FaultKind::kNoTimeOut) == nullptr;
  if (has_one && !timed_out_ && now >= heard_ + options_.time_out_10ms * kTimeOutUnit) {
    timed_out_ = true;
    raise(Error::kTimeOut);
  }
}

void MaestroBox::err_at_random(Time now) noexcept {
  const Running* fault = running(FaultKind::kError);
  if (fault != nullptr && errors_due_.due(random_errors_, fault->fault.rate, now - stepped_)) {
    raise(kRandomErrors[emulated::one_of(random_errors_, kRandomErrors.size())]);
    note(FaultKind::kError, now);
  }
}

void MaestroBox::receive(std::span<const std::uint8_t> bytes, Time at,
                         std::vector<Utterance>& said) {
  if (is_off() || options_.mode == MaestroMode::kUartDetect ||
      running(FaultKind::kWrongMode) != nullptr) {
    return;
  }
  for (const std::uint8_t byte : bytes) {
    take(byte, at, said);
  }
}

// A command begins with the only byte that has its highest bit set; of Mini SSC the servo and its
// target may have it too.
void MaestroBox::take(std::uint8_t byte, Time at, std::vector<Utterance>& said) {
  const bool in_mini_ssc = !held_.empty() && held_[0] == kMiniSsc;
  if (!in_mini_ssc && (byte & kCommandBit) != 0 && !held_.empty()) {
    held_.clear();
    raise(Error::kProtocol);
  }
  if (held_.empty() && (byte & kCommandBit) == 0) {
    return;  // of a command that has been given up
  }
  held_.push_back(byte);
  if (held_[0] == kMiniSsc) {
    take_target_of_mini_ssc(at);
  } else {
    look(at, said);
  }
}

void MaestroBox::take_target_of_mini_ssc(Time at) {
  if (held_.size() < 3) {
    return;
  }
  // A servo of another box on the line is no error.
  if (held_[1] >= options_.mini_ssc_offset &&
      held_[1] < options_.mini_ssc_offset + options_.channels) {
    const std::size_t channel = std::size_t{held_[1]} - options_.mini_ssc_offset;
    const MaestroChannel& settings = options_.channel[channel];
    const int away = std::min<int>(held_[2], 2 * kNeutral8) - kNeutral8;
    set_target(channel, static_cast<std::uint16_t>(settings.neutral_quarter_us +
                                                   away * settings.range_quarter_us / kNeutral8));
    rearm(at);
  }
  held_.clear();
}

// The command in what is held, its number at `head`; nothing where there is no such command.
std::optional<MaestroBox::Command> MaestroBox::command_at(std::size_t head) const noexcept {
  const auto number = static_cast<std::uint8_t>(held_[head] | kCommandBit);
  const auto data = data_of(number, options_.channels <= kMicroChannels);
  if (!data) {
    return std::nullopt;
  }
  const bool is_counted = number == kSetTargets && held_.size() > head + 1;
  return Command{number, *data + (is_counted ? 2 * std::size_t{held_[head + 1]} : 0)};
}

void MaestroBox::look(Time at, std::vector<Utterance>& said) {
  const bool is_pololu = held_[0] == kPololu;
  const std::size_t head = is_pololu ? 2 : 0;
  if (held_.size() <= head) {
    return;
  }
  const bool is_ours = !is_pololu || held_[1] == options_.device_number;
  const auto command = command_at(head);
  if (!command) {
    held_.clear();
    if (is_ours) {
      raise(Error::kProtocol);
    }
    return;
  }
  const std::size_t data_end = head + 1 + command->data;
  if (held_.size() < data_end + (options_.crc ? 1 : 0)) {
    return;
  }
  const std::vector<std::uint8_t> whole = std::move(held_);
  held_ = {};
  const std::span<const std::uint8_t> checked = std::span{whole}.first(data_end);
  if (!is_ours) {
    return;
  }
  if (options_.crc && whole.back() != crc7(checked)) {
    raise(Error::kCrc);
    return;
  }
  obey(command->number, checked.subspan(head + 1), at, said);
}

void MaestroBox::obey(std::uint8_t number, std::span<const std::uint8_t> data, Time at,
                      std::vector<Utterance>& said) {
  const bool names_channel = number == kSetTarget || number == kSetSpeed ||
                             number == kSetAcceleration || number == kGetPosition;
  const bool names_range = number == kSetTargets;
  if ((names_channel && data[0] >= options_.channels) ||
      (names_range && std::size_t{data[0]} + data[1] > options_.channels)) {
    raise(Error::kProtocol);
    return;
  }
  rearm(at);
  switch (number) {
    case kSetTarget: set_target(data[0], from_sevens(data[1], data[2])); break;
    case kSetTargets:
      for (std::size_t i = 0; i < data[0]; ++i) {
        set_target(data[1] + i, from_sevens(data[2 + 2 * i], data[3 + 2 * i]));
      }
      break;
    case kGetPosition: say_u16(said, at, pulse_quarter_us(data[0])); break;
    case kGetMoving: say(said, at, {0}); break;
    case kGetErrors:
      say_u16(said, at, errors_);
      errors_ = 0;
      break;
    case kGoHome: go_home(); break;
    case kGetScriptStatus: say(said, at, {kScriptStopped}); break;
    default: break;  // speed, acceleration, PWM and scripts are taken, and nothing comes of them
  }
}

void MaestroBox::set_target(std::size_t channel, std::uint16_t quarter_us) noexcept {
  const Running* refused = running(FaultKind::kRefuse);
  if (refused != nullptr && channel == static_cast<std::size_t>(refused->fault.value)) {
    return;
  }
  const MaestroChannel& settings = options_.channel[channel];
  pulses_[channel] =
      quarter_us == 0 ? std::uint16_t{0}
                      : std::clamp(quarter_us, settings.least_quarter_us, settings.most_quarter_us);
}

void MaestroBox::go_home() noexcept {
  for (std::size_t channel = 0; channel < options_.channels; ++channel) {
    switch (options_.channel[channel].home) {
      case MaestroHome::kOff: pulses_[channel] = 0; break;
      case MaestroHome::kIgnore: break;
      case MaestroHome::kGoTo: pulses_[channel] = options_.channel[channel].home_quarter_us; break;
    }
  }
}

void MaestroBox::raise(Error error) noexcept {
  errors_ = static_cast<std::uint16_t>(errors_ | static_cast<std::uint16_t>(error));
  go_home();
}

void MaestroBox::rearm(Time at) noexcept {
  heard_ = at;
  timed_out_ = false;
}

bool MaestroBox::has_fault(FaultKind kind) const noexcept {
  switch (kind) {
    case FaultKind::kPower:
    case FaultKind::kError:
    case FaultKind::kReset:
    case FaultKind::kRefuse:
    case FaultKind::kNoTimeOut:
    case FaultKind::kWrongMode: return true;
    default: return false;
  }
}

}  // namespace lodesman
