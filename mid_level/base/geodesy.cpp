// SPDX-License-Identifier: Apache-2.0
#include "mid_level/base/geodesy.h"

#include <GeographicLib/LocalCartesian.hpp>

namespace lodesman {

struct LocalFrame::Impl {
  GeographicLib::LocalCartesian cartesian;
};

LocalFrame::LocalFrame(GeoPoint origin)
    : impl_{std::make_unique<Impl>(
          Impl{GeographicLib::LocalCartesian{origin.latitude_deg, origin.longitude_deg}})} {}

LocalFrame::~LocalFrame() = default;

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

}  // namespace lodesman
