// SPDX-License-Identifier: Apache-2.0
// Latitude and longitude to the world frame and back: a plane that touches WGS-84 at the scenario's
// origin, x east and y north. Made once; any thread.
#pragma once

#include <memory>

#include "mid_level/base/frames.h"

namespace lodesman {

struct GeoPoint {
  double latitude_deg = 0.0;   // [deg] [-90, 90] WGS-84
  double longitude_deg = 0.0;  // [deg] [-180, 180]
};

class LocalFrame {
 public:
  explicit LocalFrame(GeoPoint origin);
  LocalFrame(const LocalFrame&) = delete;
  LocalFrame& operator=(const LocalFrame&) = delete;
  ~LocalFrame();

  [[nodiscard]] WorldPoint to_world(GeoPoint point) const noexcept;
  [[nodiscard]] GeoPoint to_geo(const WorldPoint& point) const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lodesman
