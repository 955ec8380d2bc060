// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/emulators/roboclaw_box.h"

#include <algorithm>
#include <cmath>

#include "hal_sim/emulators/thrust_output.h"

namespace lodesman {
namespace {

enum Command : std::uint8_t {
  kForward1 = 0,
  kBackward1 = 1,
  kForward2 = 4,
  kBackward2 = 5,
  kDrive1 = 6,
  kDrive2 = 7,
  kSetTimeOut = 14,
  kGetTimeOut = 15,
  kGetVersion = 21,
  kGetMainBattery = 24,
  kGetLogicBattery = 25,
  kSetDuty1 = 32,
  kSetDuty2 = 33,
  kSetDuties = 34,
  kGetDuties = 48,
  kGetCurrents = 49,
  kGetTemperature = 82,
  kGetTemperature2 = 83,
  kGetStatus = 90,
};

constexpr int kFull7 = 127;
constexpr int kStop7 = 64;
constexpr std::uint8_t kAcknowledge = 0xFF;
constexpr std::size_t kHead = 2;  // address and command
constexpr std::size_t kCheck = 2;
constexpr Duration kGapMost = std::chrono::milliseconds{10};
constexpr Duration kTimeOutUnit = std::chrono::milliseconds{100};
constexpr double kVoltsACount = 0.1;
constexpr double kAmperesACount = 0.01;
constexpr double kDegreesACount = 0.1;
constexpr std::uint8_t kAddressLeast = 0x80;
constexpr std::uint8_t kAddressMost = 0x87;

// CRC-16/XMODEM.
[[nodiscard]] std::uint16_t crc16(std::span<const std::uint8_t> bytes) noexcept {
  unsigned crc = 0;
  for (const std::uint8_t byte : bytes) {
    crc ^= static_cast<unsigned>(byte) << 8U;
    for (int bit = 0; bit < 8; ++bit) {
      crc = ((crc & 0x8000U) != 0 ? (crc << 1U) ^ 0x1021U : crc << 1U) & 0xFFFFU;
    }
  }
  return static_cast<std::uint16_t>(crc);
}

void put_u16(std::vector<std::uint8_t>& bytes, int value) {
  bytes.push_back(static_cast<std::uint8_t>((value >> 8) & 0xFF));
  bytes.push_back(static_cast<std::uint8_t>(value & 0xFF));
}

[[nodiscard]] int counts(double value, double count) noexcept {
  return static_cast<int>(std::lround(std::max(0.0, value / count)));
}

// How many bytes follow the head of an order, the check apart; nothing where it is none.
[[nodiscard]] std::optional<std::size_t> data_of_order(std::uint8_t command) noexcept {
  switch (command) {
    case kForward1:
    case kBackward1:
    case kForward2:
    case kBackward2:
    case kDrive1:
    case kDrive2:
    case kSetTimeOut: return 1;
    case kSetDuty1:
    case kSetDuty2: return 2;
    case kSetDuties: return 4;
    default: return std::nullopt;
  }
}

[[nodiscard]] int duty_of(std::span<const std::uint8_t> data) noexcept {
  const auto duty = static_cast<std::int16_t>((data[0] << 8) | data[1]);
  return std::max<int>(duty, -kFullDuty);
}

}  // namespace

RoboClawBox::RoboClawBox(const RoboClawBoxOptions& options, Time now) : options_{options} {
  power_cycle(now);
}

int RoboClawBox::duty(std::size_t motor) const noexcept { return is_off() ? 0 : duty_[motor]; }

double RoboClawBox::battery_volts() const noexcept {
  const Running* battery = running(FaultKind::kBattery);
  const double open_volts = battery != nullptr ? battery->fault.value : options_.battery_volts;
  const double load = (std::abs(duty(0)) + std::abs(duty(1))) / (2.0 * kFullDuty);
  return open_volts - options_.sag_volts * load;
}

void RoboClawBox::power_cycle(Time now) {
  duty_.fill(0);
  time_out_100ms_ = options_.stored_time_out_100ms;
  held_.clear();
  deaf_ = false;
  heard_ = now;
}

void RoboClawBox::begun(const Fault& fault, Time now) {
  if (fault.kind == FaultKind::kReset) {
    power_cycle(now);
  }
}

void RoboClawBox::step(Time now, std::vector<Utterance>& /*said*/) {
  if (!is_off()) {
    watch_time_out(now);
  }
}

void RoboClawBox::watch_time_out(Time now) noexcept {
  if (time_out_100ms_ > 0 && running(FaultKind::kNoTimeOut) == nullptr &&
      now >= heard_ + time_out_100ms_ * kTimeOutUnit) {
    duty_.fill(0);
  }
}

void RoboClawBox::receive(std::span<const std::uint8_t> bytes, Time at,
                          std::vector<Utterance>& said) {
  if (is_off() || running(FaultKind::kWrongMode) != nullptr) {
    return;
  }
  if (at > last_byte_ + kGapMost) {
    held_.clear();
    deaf_ = false;
  }
  for (const std::uint8_t byte : bytes) {
    if (!deaf_) {
      held_.push_back(byte);
      look(at, said);
    }
  }
  last_byte_ = at;
}

void RoboClawBox::look(Time at, std::vector<Utterance>& said) {
  if (held_[0] < kAddressLeast || held_[0] > kAddressMost) {
    held_.clear();
    return;
  }
  if (held_.size() < kHead) {
    return;
  }
  const bool is_ours = held_[0] == options_.address;
  const std::uint8_t command = held_[1];
  const auto data = data_of_order(command);
  if (!data) {
    Bytes told = answer(command);
    deaf_ = told.empty();  // where the packet ends is not known
    if (is_ours && !told.empty()) {
      held_.insert(held_.end(), told.begin(), told.end());
      put_u16(told, crc16(held_));
      heard_ = at;
      said.push_back({at, std::move(told)});
    }
    held_.clear();
    return;
  }
  if (held_.size() < kHead + *data + kCheck) {
    return;
  }
  const std::span<const std::uint8_t> checked = std::span{held_}.first(kHead + *data);
  const int check = (held_[kHead + *data] << 8) | held_.back();
  if (is_ours && check == crc16(checked)) {
    heard_ = at;
    if (order(command, checked.subspan(kHead))) {
      said.push_back({at, {kAcknowledge}});
    }
  }
  held_.clear();
}

bool RoboClawBox::order(std::uint8_t command, std::span<const std::uint8_t> data) noexcept {
  const int seven = data[0];
  const bool is_seven = command <= kDrive2;
  if (is_seven && seven > kFull7) {
    return false;
  }
  const int driven = seven < kStop7 ? (seven - kStop7) * kFullDuty / kStop7
                                    : (seven - kStop7) * kFullDuty / (kFull7 - kStop7);
  switch (command) {
    case kForward1: duty_[0] = seven * kFullDuty / kFull7; break;
    case kBackward1: duty_[0] = -seven * kFullDuty / kFull7; break;
    case kForward2: duty_[1] = seven * kFullDuty / kFull7; break;
    case kBackward2: duty_[1] = -seven * kFullDuty / kFull7; break;
    case kDrive1: duty_[0] = driven; break;
    case kDrive2: duty_[1] = driven; break;
    case kSetTimeOut: time_out_100ms_ = data[0]; break;
    case kSetDuty1: duty_[0] = duty_of(data); break;
    case kSetDuty2: duty_[1] = duty_of(data); break;
    case kSetDuties:
      duty_[0] = duty_of(data);
      duty_[1] = duty_of(data.subspan(2));
      break;
    default: return false;
  }
  return true;
}

RoboClawBox::Bytes RoboClawBox::answer(std::uint8_t command) const {
  Bytes told;
  switch (command) {
    case kGetTimeOut: told.push_back(time_out_100ms_); break;
    case kGetVersion:
      told.assign(options_.version.begin(), options_.version.end());
      told.push_back('\n');
      told.push_back(0);
      break;
    case kGetMainBattery: put_u16(told, counts(battery_volts(), kVoltsACount)); break;
    case kGetLogicBattery: put_u16(told, counts(options_.logic_volts, kVoltsACount)); break;
    case kGetDuties:
      put_u16(told, duty(0));
      put_u16(told, duty(1));
      break;
    case kGetCurrents:
      for (const int duty : duty_) {
        const double share = static_cast<double>(std::abs(duty)) / kFullDuty;
        put_u16(told, counts(options_.full_current_a * share, kAmperesACount));
      }
      break;
    case kGetTemperature:
    case kGetTemperature2: put_u16(told, counts(options_.temperature_c, kDegreesACount)); break;
    case kGetStatus: told.assign(options_.status_bytes, 0); break;
    default: break;
  }
  return told;
}

bool RoboClawBox::has_fault(FaultKind kind) const noexcept {
  switch (kind) {
    case FaultKind::kPower:
    case FaultKind::kReset:
    case FaultKind::kNoTimeOut:
    case FaultKind::kWrongMode:
    case FaultKind::kBattery: return true;
    default: return false;
  }
}

}  // namespace lodesman
