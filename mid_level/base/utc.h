// SPDX-License-Identifier: Apache-2.0
// Whether a time of day and date can be one at which a boat sails by this software: a machine
// without a battery for its clock begins in 1970 or when it was last shut down, and a receiver
// whose week number has rolled over is 1024 weeks too early. Pure functions; any thread.
#pragma once

#include <cstdint>

namespace lodesman {

// [ns] since 1970: 1 January 2025, and 1024 weeks after that.
inline constexpr std::int64_t kEarliestUtc_ns = 1'735'689'600'000'000'000;
inline constexpr std::int64_t kRollover_ns = 1024LL * 604'800 * 1'000'000'000;

[[nodiscard]] constexpr bool is_plausible_utc(std::int64_t utc_ns) noexcept {
  return utc_ns >= kEarliestUtc_ns && utc_ns < kEarliestUtc_ns + kRollover_ns;
}

}  // namespace lodesman
