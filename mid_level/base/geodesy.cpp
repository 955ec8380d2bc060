// SPDX-License-Identifier: Apache-2.0
#include "mid_level/base/geodesy.h"

#include <GeographicLib/LocalCartesian.hpp>
#include <algorithm>
#include <cmath>

namespace lodesman {

struct LocalFrame::Impl {
  GeographicLib::LocalCartesian cartesian;
};

LocalFrame::LocalFrame(GeoPoint origin)
    : impl_{std::make_unique<Impl>(
          Impl{GeographicLib::LocalCartesian{origin.latitude_deg, origin.longitude_deg}})},
      is_fixed_{true} {}

LocalFrame::LocalFrame() : LocalFrame{GeoPoint{}} { is_fixed_ = false; }

LocalFrame::~LocalFrame() = default;

void LocalFrame::move_to(GeoPoint origin) noexcept {
  impl_->cartesian.Reset(origin.latitude_deg, origin.longitude_deg);
  is_fixed_ = true;
}

WorldPoint LocalFrame::to_world(GeoPoint point) const noexcept {
  double x = 0.0;
  double y = 0.0;
  double up = 0.0;
  impl_->cartesian.Forward(point.latitude_deg, point.longitude_deg, 0.0, x, y, up);
  return {{x, y}};
}

GeoPoint LocalFrame::to_geo(const WorldPoint& point) const noexcept {
  GeoPoint geo;
  double height = 0.0;
  impl_->cartesian.Reverse(point.xy_m.x(), point.xy_m.y(), 0.0, geo.latitude_deg, geo.longitude_deg,
                           height);
  return geo;
}

// By haversines, which are exact for what is near.
double rough_distance_m(GeoPoint one, GeoPoint other) noexcept {
  constexpr double kMeanRadius_m = 6371008.8;  // IUGG
  const double north = std::sin(to_rad(other.latitude_deg - one.latitude_deg) / 2.0);
  const double east = std::sin(to_rad(other.longitude_deg - one.longitude_deg) / 2.0);
  const double h = north * north + std::cos(to_rad(one.latitude_deg)) *
                                       std::cos(to_rad(other.latitude_deg)) * east * east;
  return 2.0 * kMeanRadius_m * std::asin(std::sqrt(std::min(h, 1.0)));
}

}  // namespace lodesman
