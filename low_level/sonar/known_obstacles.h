// SPDX-License-Identifier: Apache-2.0
// The known-obstacle source: obstacles of the scenario drawn in the sonar view at the estimated
// pose, as the paper did in its tank (sections 4.1 and 6). A pure function; any thread.
#pragma once

#include <cstdint>
#include <span>

#include "mid_level/base/frames.h"
#include "mid_level/base/time.h"
#include "mid_level/geometry/moving_obstacle.h"
#include "mid_level/messages/sonar.h"

namespace lodesman {

// What a ping at that instant would be.
struct KnownView {
  std::uint64_t frame = 0;       // [-] of the ping it stands for
  Time captured{};               // [ns]
  double scenario_time_s = 0.0;  // [s]
  VehiclePose pose;              // at the capture time
  double range_m = 0.0;          // [m] > 0
};

// The obstacles that exist then and whose protection zone comes within range, in the vehicle
// frame, nearest first; of more than kMaxObstacles the farthest are dropped and counted. Allocates
// nothing.
void see_known_obstacles(std::span<const MovingObstacle> world, const KnownView& view,
                         SonarObstacles& out) noexcept;

// The same obstacle, seen from the vehicle.
[[nodiscard]] Obstacle to_vehicle(const VehiclePose& pose, const Obstacle& in_world) noexcept;
// And back.
[[nodiscard]] Obstacle to_world(const VehiclePose& pose, const Obstacle& in_vehicle) noexcept;

}  // namespace lodesman
