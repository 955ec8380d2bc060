// SPDX-License-Identifier: Apache-2.0
// The low level with nobody sane above it: a high level whose only word is full ahead, straight, at
// a simulated world of things that rest. What does not touch there, the guard has stopped. One
// thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "deploy/boat/configuration.h"
#include "hal_sim/scenario/scenario.h"
#include "mid_level/messages/guard.h"

namespace lodesman::testing {

struct FullAhead {
  int surge_ref = 100;       // [1, 100] asked for all the time ...
  double for_s = 60.0;       // ... of the run, which ends once the guard has held for a while
  double silent_at_s = 1e9;  // from then on nothing is said any more
};

struct FullAheadEnd {
  double least_clearance_m = 0.0;  // of the hull; infinite where there is nothing
  double way_m = 0.0;              // made good, from the start
  double speed_m_s = 0.0;          // at the end, by the truth
  double fastest_m_s = 0.0;        // by the truth
  double least_m_s = 0.0;          // by the truth: how fast it ever went astern
  GuardStatus guard;               // at the end
};

// Its vessel lies at the scenario's start and is never turned.
[[nodiscard]] FullAheadEnd sail_full_ahead(const BoatConfig& config, const Scenario& scenario,
                                           const FullAhead& order);

// [m] from the hull to the nearest obstacle of a scenario at its beginning; infinite without one.
[[nodiscard]] double clearance_m(const Scenario& scenario, const VehiclePose& pose);

// Whether nothing in it moves, appears, vanishes or carries the boat off.
[[nodiscard]] bool all_rests(const Scenario& scenario);

}  // namespace lodesman::testing
