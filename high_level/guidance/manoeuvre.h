// SPDX-License-Identifier: Apache-2.0
// What to do next among moving things: a set of manoeuvres is sailed in thought, each against where
// every obstacle will be by then, and the best is taken. (Ours; the paper steers along its path
// whatever moves.) What sails in thought is the vehicle model under the steering that the
// controller sails by. Plain values, bounded work, no allocation; one thread.
#pragma once

#include "high_level/guidance/foresight.h"
#include "mid_level/base/time.h"
#include "mid_level/messages/tracks.h"

namespace lodesman {

class ManoeuvreChooser {
 public:
  ManoeuvreChooser(const VehicleResponse& response, const ManoeuvreOptions& options) noexcept {
    set(response, options);
  }

  struct Choice {
    Manoeuvre manoeuvre;
    Foresight foresight;
    Foresight of_route;    // what following the route at full speed would have come to
    Route way;             // the way foreseen, own place first, until it is back on the route
    bool changed = false;  // another one than last time
  };

  void forget() noexcept { kept_ = {}; }
  // Other ones from here on.
  void set(const VehicleResponse& response, const ManoeuvreOptions& options) noexcept;
  // [-] of the cruise, what the vessel does at most.
  [[nodiscard]] double most_share() const noexcept { return response_.most_share; }

  // speed_share_max: [0, 1] what is allowed here. stay_at_end: the route's end is a place to wait
  // at, not the mission's goal.
  [[nodiscard]] const Choice& choose(Time now, const OwnMotion& own, const Route& route,
                                     const Tracks& tracks, double speed_share_max,
                                     bool stay_at_end) noexcept;

 private:
  [[nodiscard]] double for_s(double length_m) const noexcept;
  void consider(const Manoeuvre& manoeuvre) noexcept;
  void consider_all() noexcept;
  void consider_flight() noexcept;
  void stay_with_last() noexcept;

  VehicleResponse response_;
  ManoeuvreOptions options_;
  Outlook outlook_;
  Choice choice_;
  Manoeuvre kept_;
};

}  // namespace lodesman
