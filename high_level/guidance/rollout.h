// SPDX-License-Identifier: Apache-2.0
// A manoeuvre sailed in thought: the vehicle model under the steering that the controller sails by,
// through the current, first on the manoeuvre's course and then along the route, or to a stop.
// Plain values; one thread; no allocation.
#pragma once

#include "high_level/estimate/vehicle_model.h"
#include "high_level/guidance/route.h"
#include "high_level/guidance/steering.h"

namespace lodesman {

// How the vehicle is sailed, as far as looking ahead needs it.
struct VehicleResponse {
  VehicleModel model{VehicleModelParameters{}, SpeedTable::proportional(0.01)};
  SteeringOptions steering;
  Cruise cruise;                    // the mission's speed
  double hull_half_length_m = 0.0;  // [m] two discs cover the hull: see clearance
  double hull_half_beam_m = 0.0;    // [m]
  double look_ahead_m = 0.0;        // [m] > 0 of the line-of-sight guidance
  // [-] >= 1 of the cruise, ahead or astern: the most it may do to keep clear.
  double most_share = 1.0;
};

struct OwnMotion {
  Eigen::Vector2d p_W = Eigen::Vector2d::Zero();  // [m] [world]
  double heading_rad = 0.0;
  double surge_m_s = 0.0;                                 // through the water
  double sway_m_s = 0.0;                                  // through the water, to starboard
  double yaw_rate_rad_s = 0.0;                            // clockwise positive
  Eigen::Vector2d current_m_s = Eigen::Vector2d::Zero();  // [world] of the water
  double place_sigma_m = 0.0;  // of p_W against the tracks, one standard deviation
};

// First another course for a while, then back to the route.
struct Manoeuvre {
  double offset_rad = 0.0;  // [rad] off the route's course, clockwise positive
  double for_s = 0.0;       // [s] so long
  // [-] of the cruise, as long as it lasts; in [-0.5, 1] but in flight. Where for_s is 0, along the
  // route.
  double speed_share = 1.0;
  friend bool operator==(const Manoeuvre&, const Manoeuvre&) = default;
};

class Rollout {
 public:
  // Of a longer part the helm, which rests for a part, is too late for the yaw: that takes some 0.7
  // s. The controller's own period is 0.05 s.
  static constexpr double kPartMax_s = 0.25;

  // speed_share_max: [0, 1] along the route. stay_at_end: it waits there. What is referred to must
  // outlive it.
  Rollout(const VehicleResponse& response, const Route& route, const OwnMotion& own,
          const Manoeuvre& manoeuvre, double speed_share_max, bool stay_at_end) noexcept;

  // From here on it brakes, and stays where it has stopped.
  void stop() noexcept { phase_ = phase_ == Phase::kSailing ? Phase::kStopping : phase_; }

  // Goes on, unless it has arrived, by (0, kPartMax_s]; by more only where it goes straight on.
  void sail(double part_s) noexcept;

  [[nodiscard]] const VehicleMotion& motion() const noexcept { return motion_; }
  [[nodiscard]] const Eigen::Vector2d& p_W() const noexcept { return motion_.position.xy_m; }
  [[nodiscard]] RoutePlace place() const noexcept { return place_; }
  [[nodiscard]] double after_s() const noexcept { return after_s_; }
  [[nodiscard]] bool is_aside() const noexcept {
    return phase_ == Phase::kSailing && after_s_ < manoeuvre_.for_s;
  }
  [[nodiscard]] bool has_arrived() const noexcept { return arrived_; }

 private:
  enum class Phase : std::uint8_t { kSailing, kStopping, kStopped };

  [[nodiscard]] Steering steering() const noexcept;
  [[nodiscard]] Steering steering_to_a_stop() const noexcept;

  const VehicleResponse* response_;
  const Route* route_;
  Manoeuvre manoeuvre_;
  double speed_share_max_;
  bool stay_at_end_;
  Eigen::Vector2d current_m_s_;
  VehicleMotion motion_;
  RoutePlace place_;
  Eigen::Vector2d course_;  // of the manoeuvre
  double after_s_ = 0.0;
  bool arrived_ = false;
  Phase phase_ = Phase::kSailing;
  Eigen::Vector2d stopped_at_ = Eigen::Vector2d::Zero();  // [m] [world] once it has
};

}  // namespace lodesman
