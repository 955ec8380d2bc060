// SPDX-License-Identifier: Apache-2.0
// Tracks to try estimators on: what a boat did and what its instruments said, 50 times a second, of
// simulated runs in lock-step and of recordings. One thread; throws std::runtime_error.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "mid_level/base/speed_table.h"
#include "mid_level/messages/vehicle.h"

namespace lodesman::measure {

struct TrackSample {
  Time now{};
  Attitude attitude;
  int surge_ref = 0;  // applied; of recordings what would hold the logged speed
  int head_ref = 0;
  Eigen::Vector2d truth_m = Eigen::Vector2d::Zero();
};

struct Track {
  std::string name;
  std::vector<TrackSample> samples;
  SpeedTable speeds = SpeedTable::proportional(1.0);
  Eigen::Vector2d current_m_s = Eigen::Vector2d::Zero();
  bool current_is_known = false;
};

// The shipped boat round waypoints at 0.74 m/s in a current of 0 to 0.5 m/s, steered on the truth.
[[nodiscard]] Track simulated_track(std::uint64_t seed);

// A receiver's own track as the truth, its heading, and its speed over ground in place of thrust.
[[nodiscard]] Track nmea_track(const std::filesystem::path& file);     // GGA, RMC, HDT
[[nodiscard]] Track catabot_track(const std::filesystem::path& file);  // CSV

}  // namespace lodesman::measure
