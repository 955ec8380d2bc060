// SPDX-License-Identifier: Apache-2.0
// A manoeuvre sailed in thought among what may be met, and what it comes to. What touches anything
// ends there, and no time saved makes up for it. Every manoeuvre ends in a safe tail: where going
// back to the route would touch something, it is foreseen to a stop instead. Plain values, bounded
// work, no allocation; any thread.
#pragma once

#include <cstdint>

#include "high_level/guidance/hazard.h"
#include "high_level/guidance/rollout.h"
#include "high_level/guidance/route.h"

namespace lodesman {

struct ManoeuvreOptions {
  double clearance_m = 0.0;    // [m] > 0 between hull and obstacle; less costs
  double core_m = 0.0;         // [m] >= 0 less than this costs as nothing else does
  double doubt_sigmas = 0.0;   // [-] of a track's covariance that are kept clear of ...
  double doubt_max_m = 0.0;    // [m] ... up to this
  double switch_gain_s = 0.0;  // [s] another manoeuvre must be better by this
  // [m/s] ahead or astern, where nothing slower keeps clear; 0: none
  double flight_speed_m_s = 0.0;
};

struct Foresight {
  double cost_s = 0.0;             // [s] time to the route's end and what else counts, as time
  double delay_s = 0.0;            // [s] of it, what is no time: closeness and the like
  double least_clearance_m = 0.0;  // [m] of the hull; far off a lower bound; infinity: no obstacle
  double least_after_s = 0.0;      // [s] when
  std::uint32_t least_track = 0;   // [-] Track::id; 0: none
  bool touches = false;            // something, and ends there
  double harm = 0.0;  // [m/s] of that: more the likelier, the faster, the deeper, and the sooner
  bool is_run_down = false;  // comes nearer than the core to something that moves
  bool circles = false;      // is not at the route's end in twice the time that its way takes
  bool stops = false;        // does not go back to the route within what is foreseen
};

// Whether a is to be preferred: by whether something is touched, then by how and when, then by
// cost.
[[nodiscard]] bool is_better(const Foresight& a, const Foresight& b) noexcept;

// What is constant while one choice is made. What it points to must outlive it.
struct Outlook {
  const VehicleResponse* response = nullptr;
  const ManoeuvreOptions* options = nullptr;
  const Route* route = nullptr;
  OwnMotion own;
  Hazards hazards;
  double speed_share_max = 1.0;  // [-] [0, 1] what is allowed here
  bool stay_at_end = false;      // the route's end is a place to wait at
  double horizon_s = 0.0;        // [s] how far it looks ahead ...
  double step_s = 0.0;           // [s] ... and how finely
  int parts = 1;                 // of a step, while it turns
};

// Sets the horizon, and steps that suit it and the fastest of the hazards.
void look_as_far_as_needed(Outlook& outlook) noexcept;

// Given up, at an infinite cost, once it cannot be better any more than to_beat.
[[nodiscard]] Foresight foresee(const Outlook& outlook, const Manoeuvre& manoeuvre,
                                const Foresight* to_beat = nullptr) noexcept;

// The way that was foreseen, own place first, until it is back on the route or has stopped.
void show_way(const Outlook& outlook, const Manoeuvre& manoeuvre, const Foresight& foreseen,
              Route& way) noexcept;

}  // namespace lodesman
