// SPDX-License-Identifier: Apache-2.0
#include "tests/system/escape.h"

#include <array>
#include <cmath>
#include <limits>

#include "hal_sim/world/clearance.h"
#include "mid_level/geometry/obstacle_distance.h"

namespace lodesman::testing {
namespace {

constexpr double kLook_s = 0.1;
constexpr std::array<std::uint8_t, 5> kCommands{0, 64, 128, 192, 255};
constexpr std::array kFirstFor_s{2.0, 4.0, 8.0};  // ascending: each goes on from the one before

[[nodiscard]] bool clear_at(const Waters& waters, const VehiclePose& pose, double time_s) {
  const HullSize hull{waters.vessel.hull_length_m, waters.vessel.hull_beam_m};
  const double reach_m = std::hypot(hull.length_m, hull.beam_m) / 2.0;
  for (const MovingObstacle& mover : waters.obstacles) {
    if (!mover.exists(time_s)) {
      continue;
    }
    const Obstacle obstacle = mover.at(time_s);
    if (edge_distance_bound_m(obstacle, pose.p_WV) <= reach_m &&
        hull_clearance_m(obstacle, pose, hull) <= 0.0) {
      return false;
    }
  }
  return true;
}

// A vessel on trial, and how far it came.
struct Trial {
  Vessel vessel;
  double time_s;
};

// False when it hits something on the way.
[[nodiscard]] bool sail(const Waters& waters, ThrustCommand thrust, double until_s, Trial& trial) {
  while (trial.time_s < until_s - 1e-6) {
    trial.vessel.advance(kLook_s, thrust);
    trial.time_s += kLook_s;
    if (!clear_at(waters, trial.vessel.state().pose, trial.time_s)) {
      return false;
    }
  }
  return true;
}

[[nodiscard]] std::optional<ThrustCommand> second_stage(const Waters& waters, const Trial& from,
                                                        double until_s) {
  for (const std::uint8_t left : kCommands) {
    for (const std::uint8_t right : kCommands) {
      Trial trial = from;
      if (sail(waters, {left, right}, until_s, trial)) {
        return ThrustCommand{left, right};
      }
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<Escape> find_escape(const Waters& waters, const VesselState& from, double from_s,
                                  double until_s) {
  for (const std::uint8_t left : kCommands) {
    for (const std::uint8_t right : kCommands) {
      const ThrustCommand first{left, right};
      Trial trial{Vessel::under_way(waters.vessel, waters.water, from), from_s};
      for (const double first_for_s : kFirstFor_s) {
        if (!sail(waters, first, from_s + first_for_s, trial)) {
          break;
        }
        if (const auto second = second_stage(waters, trial, until_s)) {
          return Escape{first, first_for_s, *second};
        }
      }
    }
  }
  return std::nullopt;
}

Nearest nearest_obstacle(const Waters& waters, const VehiclePose& pose, double scenario_time_s) {
  const HullSize hull{waters.vessel.hull_length_m, waters.vessel.hull_beam_m};
  Nearest nearest{0, std::numeric_limits<double>::infinity()};
  for (const MovingObstacle& mover : waters.obstacles) {
    if (!mover.exists(scenario_time_s)) {
      continue;
    }
    const double clearance_m = hull_clearance_m(mover.at(scenario_time_s), pose, hull);
    if (clearance_m < nearest.clearance_m) {
      nearest = {mover.at_start.id, clearance_m};
    }
  }
  return nearest;
}

}  // namespace lodesman::testing
