// SPDX-License-Identifier: Apache-2.0
#include "mid_level/geometry/leg.h"

#include <algorithm>

namespace lodesman {

using Vec = Eigen::Vector2d;

double Leg::along_m(const Vec& point_W) const noexcept {
  const double length = length_m();
  return length > 0.0 ? std::clamp((point_W - from_W).dot(to_W - from_W) / length, 0.0, length)
                      : 0.0;
}

Vec Leg::at(double along_m) const noexcept {
  const double length = length_m();
  return length > 0.0 ? Vec{from_W + along_m / length * (to_W - from_W)} : to_W;
}

double Leg::cross_track_m(const Vec& point_W) const noexcept {
  const double length = length_m();
  if (length <= 0.0) {
    return (point_W - to_W).norm();
  }
  const Vec way = (to_W - from_W) / length;
  const Vec off = point_W - from_W;
  return off.x() * way.y() - off.y() * way.x();
}

}  // namespace lodesman
