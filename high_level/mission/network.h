// SPDX-License-Identifier: Apache-2.0
// What the command socket asks of IP addresses. Any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace lodesman {

enum class Reach : std::uint8_t {
  kLoopback,  // this machine alone
  kNetwork,
};

// Nothing where the text is no IPv4 or IPv6 address (one with a zone, as fe80::1%wlan0, is).
[[nodiscard]] std::optional<Reach> reach_of(const std::string& address);

// What stands for a client's network when places are given out and failures are counted: an IPv4
// address, also one that is mapped into IPv6; the /64 of an IPv6 address, which one host has for
// itself; of a link-local one the other half. Loopback is 0.
using NetworkId = std::uint64_t;
inline constexpr NetworkId kOwnMachine = 0;
[[nodiscard]] NetworkId network_of(const std::string& address);

}  // namespace lodesman
