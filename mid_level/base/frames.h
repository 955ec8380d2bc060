// SPDX-License-Identifier: Apache-2.0
// World (x east, y north) and vehicle (x starboard, y ahead) frames, in metres, and the only
// conversion between them: eqs 3-6 of the paper, with the rotation by the heading alone.
// Any thread.
#pragma once

#include <Eigen/Core>

#include "mid_level/base/heading.h"

namespace lodesman {

struct WorldPoint {
  Eigen::Vector2d xy_m = Eigen::Vector2d::Zero();
};
struct VehiclePoint {
  Eigen::Vector2d xy_m = Eigen::Vector2d::Zero();
};

// Where the vehicle is. p_WV: the vehicle's origin in the world frame (the paper's X).
struct VehiclePose {
  WorldPoint p_WV;
  Heading heading;

  // GV = R^T (GW - X), eqs 3-4.
  [[nodiscard]] VehiclePoint to_vehicle(const WorldPoint& p_W) const noexcept;
  // PW = X + R PV, eqs 5-6.
  [[nodiscard]] WorldPoint to_world(const VehiclePoint& p_V) const noexcept;
  // An angle clockwise from +y, from one frame's +y to the other's.
  [[nodiscard]] double angle_to_vehicle_rad(double world_rad) const noexcept {
    return wrap_to_pi(world_rad - heading.rad());
  }
  [[nodiscard]] double angle_to_world_rad(double vehicle_rad) const noexcept {
    return wrap_to_pi(vehicle_rad + heading.rad());
  }
};

}  // namespace lodesman
