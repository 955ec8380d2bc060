// SPDX-License-Identifier: Apache-2.0
#include "mid_level/base/frames.h"

#include <cmath>

namespace lodesman {
namespace {

// eq. 6 with psi = -heading: the paper counts psi counter-clockwise.
Eigen::Matrix2d rotation(Heading heading) noexcept {
  const double c = std::cos(heading.rad());
  const double s = std::sin(heading.rad());
  Eigen::Matrix2d r;
  r << c, s, -s, c;
  return r;
}

}  // namespace

VehiclePoint VehiclePose::to_vehicle(const WorldPoint& p_W) const noexcept {
  return {rotation(heading).transpose() * (p_W.xy_m - p_WV.xy_m)};
}

WorldPoint VehiclePose::to_world(const VehiclePoint& p_V) const noexcept {
  return {p_WV.xy_m + rotation(heading) * p_V.xy_m};
}

}  // namespace lodesman
