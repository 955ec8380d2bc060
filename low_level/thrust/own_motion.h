// SPDX-License-Identifier: Apache-2.0
// How the boat moves through the water, reckoned from the thrust applied alone: the low level's own
// knowledge, which no estimator of the high level has a part in. Surge and yaw with linear and
// quadratic drag (Fossen, Handbook of Marine Craft Hydrodynamics and Motion Control, 2nd ed.,
// ch. 6.4), uncoupled; thrust ahead is what holds the speed of the boat's own speed table. It knows
// of no current, wind or slip. Plain values; any thread; no allocation.
#pragma once

#include "mid_level/base/speed_table.h"
#include "mid_level/base/time.h"

namespace lodesman {

struct HullResponse {
  double mass_kg = 1.0;                   // [kg] > 0 in surge, added mass included
  double surge_drag_n_s_per_m = 1.0;      // [N s/m] > 0
  double surge_drag_n_s2_per_m2 = 0.0;    // [N s^2/m^2] >= 0
  double yaw_inertia_kg_m2 = 1.0;         // [kg m^2] > 0, added inertia included
  double yaw_drag_n_m_s = 1.0;            // [N m s] > 0
  double yaw_drag_n_m_s2 = 0.0;           // [N m s^2] >= 0
  double turning_n_m_per_head_ref = 0.0;  // [N m] >= 0 of both thrusters
  double astern_share = 1.0;              // [-] (0, 1] of the thrust ahead that astern gives
  SpeedTable speeds = SpeedTable::proportional(0.01);
};

struct SurgeAndHead {
  int surge_ref = 0;  // [-] [-100, 100]
  int head_ref = 0;   // [-] [-100, 100] positive turns right
};

// x, y and heading are the reckoned pose in a frame that began wherever the reckoning did: x to
// starboard and y ahead of the boat as it lay then.
struct ReckonedMotion {
  double x_m = 0.0;             // [m]
  double y_m = 0.0;             // [m]
  double heading_rad = 0.0;     // [rad] clockwise from +y, not wrapped
  double surge_m_s = 0.0;       // [m/s] ahead
  double yaw_rate_rad_s = 0.0;  // [rad/s] clockwise
};

class ReckoningModel {
 public:
  static constexpr double kStepMax_s = 0.05;

  explicit ReckoningModel(const HullResponse& hull) noexcept : hull_{hull} {}

  // One step by the midpoint rule; dt_s: [0, kStepMax_s].
  [[nodiscard]] ReckonedMotion advanced(const ReckonedMotion& from, const SurgeAndHead& thrust,
                                        double dt_s) const noexcept;

 private:
  [[nodiscard]] double drag_n(double surge_m_s) const noexcept;
  [[nodiscard]] double surge_m_s2(double surge_m_s, double thrust_n) const noexcept;
  [[nodiscard]] double yaw_rad_s2(double yaw_rate_rad_s, double turning_n_m) const noexcept;

  HullResponse hull_;
};

}  // namespace lodesman
