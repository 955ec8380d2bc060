// SPDX-License-Identifier: Apache-2.0
// The time of day of an emulated device: UTC, by how much it is ahead of the time that the device
// is handed. The simulation has an epoch of its own, so that the same run has the same dates; a
// bench hands in the machine's. Pure functions; any thread.
#pragma once

#include <cstdint>

#include "mid_level/base/time.h"

namespace lodesman::emulated {

// From 1970 to UTC at Time 0. Ours: half past twelve and five minutes on 21 November 2026.
inline constexpr Duration kVirtualEpoch = std::chrono::seconds{1'795'264'500};
// After so many weeks the week number of the older GPS message begins anew.
inline constexpr Duration kWeekRollover = std::chrono::hours{1024 * 7 * 24};

struct CivilTime {
  int year = 1970;
  int month = 1;  // [1, 12]
  int day = 1;    // [1, 31]
  int hour = 0;
  int minute = 0;
  int second = 0;
  int millisecond = 0;  // cut off, not rounded
};

// since_1970: of UTC, without leap seconds.
[[nodiscard]] CivilTime civil_time(Duration since_1970) noexcept;

}  // namespace lodesman::emulated
