// SPDX-License-Identifier: Apache-2.0
// Speed by sight: how far along a way the water was seen, and how fast a boat may go that is to
// stop within that. What is seen to be occupied is not looked at here: it is among the tracks.
// Pure functions; any thread; no allocation.
#pragma once

#include "high_level/estimate/vehicle_model.h"
#include "high_level/guidance/route.h"
#include "mid_level/messages/coverage.h"

namespace lodesman {

// [m] Along the way from a place on it to the first water that was not seen, half_width_m to either
// side looked at too; far_m where that is farther, or the way ends before.
[[nodiscard]] double seen_ahead_m(const Coverage& water, const Route& way, RoutePlace from,
                                  double half_width_m, double far_m) noexcept;

struct SightSpeedOptions {
  double unseen_speed_m_s = 0.0;  // [m/s] > 0 into water that nobody looked at
  double bow_m = 0.0;             // [m] >= 0 from the place that is steered to what is kept clear
  double latency_s = 0.0;         // [s] >= 0 for which it goes on as it did
};

// [m] That have to be seen for a speed [m/s]: with thrusters at neutral it stops before their end.
[[nodiscard]] double sight_needed_m(const SightSpeedOptions& options, const VehicleModel& vehicle,
                                    double speed_m_s) noexcept;

// [m/s] The highest one for which so much is enough, at least unseen_speed_m_s, at most most_m_s.
[[nodiscard]] double speed_by_sight_m_s(const SightSpeedOptions& options,
                                        const VehicleModel& vehicle, double seen_m,
                                        double most_m_s) noexcept;

}  // namespace lodesman
