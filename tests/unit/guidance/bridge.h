// SPDX-License-Identifier: Apache-2.0
// A pilot under test, with all that goes between it and the path finder. One thread.
#pragma once

#include <initializer_list>
#include <memory>

#include "high_level/guidance/pilot.h"
#include "tests/unit/guidance/support.h"

namespace lodesman::testing {

inline PilotOptions pilot_options() {
  PilotOptions options;
  options.zones = default_zones();
  options.zones.margin_m = 2.0;  // wide, so that beside an obstacle there is a zone to be in
  options.response = default_response();
  options.manoeuvres = default_manoeuvres();
  options.side_gain_m = 1.5;
  options.narrow_speed_share = 0.5;
  options.sight = {.unseen_speed_m_s = 0.2, .bow_m = 1.4, .latency_s = 0.1};
  return options;
}

inline VehicleState state_at(double x_m, double y_m, double surge_m_s = 0.0) {
  VehicleState state;
  state.x_m = x_m;
  state.y_m = y_m;
  state.surge_m_s = surge_m_s;
  return state;
}

// A pilot with its last request and plan.
struct Bridge {
  std::unique_ptr<Pilot> pilot = std::make_unique<Pilot>(pilot_options());
  std::unique_ptr<PathRequest> request = std::make_unique<PathRequest>();
  std::unique_ptr<SonarPath> path = std::make_unique<SonarPath>();
  std::unique_ptr<Plan> plan = std::make_unique<Plan>();
  std::unique_ptr<Coverage> water;  // none: all of it is known

  void ask(const Tracks& tracks, const VehicleState& state, const Eigen::Vector2d& goal,
           bool stay = false) {
    pilot->ask(at_s(0), tracks, state, {{goal}, stay, {}}, *request);
  }
  // Keeping to the line of a leg.
  void ask(const Tracks& tracks, const VehicleState& state, const Leg& leg) {
    pilot->ask(at_s(0), tracks, state, {{leg.to_W}, false, leg}, *request);
  }
  void decide(const Tracks& tracks, const VehicleState& state, PathReason reason,
              std::initializer_list<PathPoint> points) {
    path->reason = reason;
    path->point_count = 0;
    for (const PathPoint& point : points) {
      path->points[path->point_count++] = point;
    }
    pilot->decide(at_s(0), *path, tracks, water.get(), state, *plan);
  }
};

}  // namespace lodesman::testing
