// SPDX-License-Identifier: Apache-2.0
// What to do next among moving things: a set of manoeuvres is sailed in thought, each against where
// every obstacle will be by then, and the cheapest is taken. (Ours; the paper steers along its path
// whatever moves.) What sails in thought is the vehicle model under the steering that the
// controller sails by. Plain values, bounded work, no allocation; one thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "high_level/guidance/rollout.h"
#include "high_level/guidance/route.h"
#include "mid_level/base/time.h"
#include "mid_level/messages/tracks.h"

namespace lodesman {

struct ManoeuvreOptions {
  double clearance_m = 0.0;    // [m] > 0 between hull and obstacle; less costs
  double core_m = 0.0;         // [m] >= 0 less than this counts as a collision
  double doubt_sigmas = 0.0;   // [-] of a track's covariance that are kept clear of ...
  double doubt_max_m = 0.0;    // [m] ... up to this
  double switch_gain_s = 0.0;  // [s] another manoeuvre must be better by this
  double flight_speed_m_s =
      0.0;  // [m/s] ahead or astern, where nothing slower keeps clear; 0: none
};

// What came of one, in thought.
struct Foresight {
  double cost_s = 0.0;             // [s] time to the route's end and what else counts, as time
  double delay_s = 0.0;            // [s] of it, what is no time: closeness and the like
  double least_clearance_m = 0.0;  // [m] of the hull; far off a lower bound; infinity: no obstacle
  double least_after_s = 0.0;      // [s] when
  std::uint32_t least_track = 0;   // [-] Track::id; 0: none
  bool collides = false;
  bool run_down = false;  // collides with something that moves: to stop would not help
  bool circles = false;   // is not at the route's end in twice the time that its way takes
};

// An obstacle as it is foreseen: what is constant during one choice.
struct Hazard {
  const Track* track = nullptr;
  Eigen::Vector2d velocity_m_s = Eigen::Vector2d::Zero();
  double age_s = 0.0;  // of its place
  double place_sigma_m = 0.0;
  double velocity_sigma_m_s = 0.0;
  double around_m = 0.0;  // no part of it is farther from its centre
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
};

class ManoeuvreChooser {
 public:
  ManoeuvreChooser(const VehicleResponse& response, const ManoeuvreOptions& options) noexcept
      : response_{response}, options_{options} {}

  struct Choice {
    Manoeuvre manoeuvre;
    Foresight foresight;
    Foresight of_route;    // what following the route at full speed would have come to
    Route way;             // the way foreseen, own place first, until it is back on the route
    bool changed = false;  // another one than last time
  };

  void forget() noexcept { kept_ = {}; }
  // Other ones from here on.
  void set(const VehicleResponse& response, const ManoeuvreOptions& options) noexcept {
    response_ = response;
    options_ = options;
  }

  // speed_share_max: [0, 1] what is allowed here. stay_at_end: the route's end is a place to wait
  // at, not the mission's goal.
  [[nodiscard]] const Choice& choose(Time now, const OwnMotion& own, const Route& route,
                                     const Tracks& tracks, double speed_share_max,
                                     bool stay_at_end) noexcept;

 private:
  void foresee_hazards(Time now, const Tracks& tracks) noexcept;
  struct Voyage;
  // Given up, at an infinite cost, once it must cost more than cost_max_s.
  [[nodiscard]] Foresight foresee(const Manoeuvre& manoeuvre, double cost_max_s,
                                  Route* way) const noexcept;
  [[nodiscard]] Voyage set_out(const Manoeuvre& manoeuvre) const noexcept;
  void sail_on(Voyage& voyage) const noexcept;
  void meet_hazards(Voyage& voyage) const noexcept;
  [[nodiscard]] double hull_clearance_m(const Hazard& hazard, double after_s,
                                        const VehicleMotion& own, double wanted_m) const noexcept;
  [[nodiscard]] static double cost_of_crossing_ahead_s(const Hazard& hazard, double after_s,
                                                       const VehicleMotion& own) noexcept;
  void return_to_route(Route& way) const noexcept;
  void consider(const Manoeuvre& manoeuvre) noexcept;
  void consider_all() noexcept;
  void consider_flight() noexcept;
  void stay_with_last() noexcept;

  VehicleResponse response_;
  ManoeuvreOptions options_;
  std::array<Hazard, kMaxObstacles> hazards_{};
  std::size_t hazard_count_ = 0;
  // Of the choice being made.
  OwnMotion own_;
  const Route* route_ = nullptr;
  double speed_share_max_ = 1.0;
  bool stay_at_end_ = false;
  double horizon_s_ = 0.0;
  double step_s_ = 0.0;
  int parts_ = 1;  // of a step
  Choice choice_;
  Manoeuvre kept_;
};

}  // namespace lodesman
