// SPDX-License-Identifier: Apache-2.0
// Bytes as the manuals print them, and a device that is talked to without a line.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "hal_sim/emulators/faulty_device.h"

namespace lodesman::testing {

using Bytes = std::vector<std::uint8_t>;

// "55 55 50 4B"
[[nodiscard]] inline Bytes hex(std::string_view text) {
  Bytes bytes;
  std::string digits;
  for (const char c : text) {
    if (c != ' ') {
      digits += c;
    }
    if (digits.size() == 2) {
      bytes.push_back(static_cast<std::uint8_t>(std::stoi(digits, nullptr, 16)));
      digits.clear();
    }
  }
  return bytes;
}

[[nodiscard]] inline Bytes operator+(Bytes a, const Bytes& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

[[nodiscard]] constexpr Time at_ms(std::int64_t ms) { return Time{std::chrono::milliseconds{ms}}; }

// What a device says to these bytes, all of it in one.
[[nodiscard]] inline Bytes answer(EmulatedDevice& device, const Bytes& sent, Time at) {
  std::vector<Utterance> said;
  device.step(at, said);
  said.clear();
  device.receive(sent, at, said);
  Bytes all;
  for (const Utterance& utterance : said) {
    all = all + utterance.bytes;
  }
  return all;
}

[[nodiscard]] inline std::vector<Utterance> said_until(EmulatedDevice& device, Time until) {
  std::vector<Utterance> said;
  device.step(until, said);
  return said;
}

[[nodiscard]] inline Fault ahrs_fault(FaultKind kind, double rate = 0.0, double value = 0.0) {
  return {FaultDevice::kAhrs, kind, 0.0, 1e5, rate, value};
}
[[nodiscard]] inline Fault box_fault(FaultKind kind, double rate = 0.0, double value = 0.0) {
  return {FaultDevice::kThruster, kind, 0.0, 1e5, rate, value};
}

[[nodiscard]] inline Fault sonar_fault(FaultKind kind, double rate = 0.0, double value = 0.0,
                                       double at_s = 0.0, double duration_s = 1e5) {
  return {FaultDevice::kSonar, kind, at_s, duration_s, rate, value};
}
[[nodiscard]] inline Fault gps_fault(FaultKind kind, double rate = 0.0, double value = 0.0) {
  return {FaultDevice::kPosition, kind, 0.0, 1e5, rate, value};
}

}  // namespace lodesman::testing
