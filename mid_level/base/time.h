// SPDX-License-Identifier: Apache-2.0
// The project's time: a chrono clock tag that has no now(), so that code which computes can only
// be given the time. Any thread may use these values.
#pragma once

#include <chrono>
#include <cstdint>

namespace lodesman {

struct BoatClock {
  using rep = std::int64_t;
  using period = std::nano;
  using duration = std::chrono::nanoseconds;
  using time_point = std::chrono::time_point<BoatClock, duration>;
  static constexpr bool is_steady = true;
};

using Duration = BoatClock::duration;
using Time = BoatClock::time_point;  // nanoseconds since the machine (or the simulation) started

[[nodiscard]] constexpr double to_seconds(Duration d) noexcept {
  return std::chrono::duration<double>(d).count();
}
[[nodiscard]] constexpr Duration from_seconds(double s) noexcept {
  const double ns = s * 1e9;
  return Duration{static_cast<std::int64_t>(ns < 0.0 ? ns - 0.5 : ns + 0.5)};
}

}  // namespace lodesman
