// SPDX-License-Identifier: Apache-2.0
// The scenario that `lodesman rt-test` sails: up and down between obstacles for as long as it
// takes, so that all tasks have their usual work. Pure; any thread.
#pragma once

#include <string>

namespace lodesman::cli {

// [s] No longer than a mission has room for waypoints.
inline constexpr double kLongestRoundTrips_s = 3600.0;

// The text of a scenario file whose mission takes longer than that.
[[nodiscard]] std::string round_trips_scenario(double seconds);

}  // namespace lodesman::cli
