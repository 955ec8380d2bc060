// SPDX-License-Identifier: Apache-2.0
// The gpsd that a configuration names: whether it answers, of what version it is, and what
// receivers it has. It is asked over its socket, as the driver asks it; no receiver notices. One
// thread, which waits for at most kPatience.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "deploy/operator/doctor/diagnosis.h"

namespace lodesman::cli {

struct GpsdFacts {
  std::string place;     // "host:port"
  std::string wanted;    // a receiver of it, by its path there; empty: any
  bool answers = false;  // as gpsd does
  std::string release;
  int protocol_major = 0;
  std::vector<std::string> receivers;  // by their paths
};

inline constexpr std::chrono::milliseconds kGpsdPatience{2000};

// Empty where that address is no gpsd's, or one that `lodesman check` refuses.
[[nodiscard]] std::optional<GpsdFacts> measure_gpsd(const std::string& address);

// What it answers to ?DEVICES;, line by line.
void take_gpsd_line(const std::string& line, GpsdFacts& facts);

[[nodiscard]] Finding judge_gpsd(const GpsdFacts& facts);

}  // namespace lodesman::cli
