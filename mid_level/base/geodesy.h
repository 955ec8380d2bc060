// SPDX-License-Identifier: Apache-2.0
// Latitude and longitude to the world frame and back: a plane that touches WGS-84 at the origin, x
// east and y north. Made once, and moved by the one thread that has it; nothing else allocates.
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
  // One whose origin is not known yet: what it says until move_to() has no meaning.
  LocalFrame();
  LocalFrame(const LocalFrame&) = delete;
  LocalFrame& operator=(const LocalFrame&) = delete;
  ~LocalFrame();

  void move_to(GeoPoint origin) noexcept;
  [[nodiscard]] bool is_fixed() const noexcept { return is_fixed_; }
  [[nodiscard]] WorldPoint to_world(GeoPoint point) const noexcept;
  [[nodiscard]] GeoPoint to_geo(const WorldPoint& point) const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
  bool is_fixed_;
};

// [m] along a sphere of the earth's mean radius: within 0.6 % of WGS-84. NaN for what is not
// finite.
[[nodiscard]] double rough_distance_m(GeoPoint one, GeoPoint other) noexcept;

}  // namespace lodesman
