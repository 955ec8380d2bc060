// SPDX-License-Identifier: Apache-2.0
// Whether this machine keeps the datagrams of a sonar while nobody reads: an image of a DeltaT
// comes in 41 packets, none of which may be lost. Tried with a socket of its own. One thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "deploy/operator/doctor/diagnosis.h"

namespace lodesman::cli {

struct ReceiveBufferFacts {
  std::uint64_t wanted_bytes = 0;   // by the driver
  std::uint64_t granted_bytes = 0;  // to this user, without the kernel's own expenses
};

// Empty where the sonar at that address is no DeltaT, or no socket is to be had.
[[nodiscard]] std::optional<ReceiveBufferFacts> measure_receive_buffer(const std::string& sonar);

[[nodiscard]] Finding judge_receive_buffer(const ReceiveBufferFacts& facts);

}  // namespace lodesman::cli
