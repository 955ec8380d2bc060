// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/world/world.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hal_sim/world/clearance.h"

namespace lodesman {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

World::World(const Scenario& scenario, const VesselParameters& parameters)
    : obstacles_{scenario.obstacles},
      vehicle_radius_m_{scenario.vehicle_radius_m},
      parameters_{parameters},
      vessel_{parameters,
              {scenario.environment.current_x_m_s, scenario.environment.current_y_m_s,
               scenario.environment.lift},
              scenario.mission.start} {
  forget_the_least();
  observe(0.0);
}

void World::forget_the_least() noexcept {
  truth_.least_inoffensive_distance_m = kInfinity;
  truth_.least_inoffensive_distance_at_s = 0.0;
  truth_.least_hull_clearance_m = kInfinity;
}

void World::step(double dt_s, double scenario_time_s, ThrustCommand thrust) noexcept {
  vessel_.advance(dt_s, thrust);
  observe(scenario_time_s);
}

void World::observe(double scenario_time_s) noexcept {
  const VesselState& vessel = vessel_.state();
  const Eigen::Vector2d velocity_V_m_s = vessel_.ground_velocity_V_m_s();
  truth_.scenario_time_s = scenario_time_s;
  truth_.x_m = vessel.pose.p_WV.xy_m.x();
  truth_.y_m = vessel.pose.p_WV.xy_m.y();
  truth_.heading_rad = vessel.pose.heading.rad();
  truth_.surge_m_s = velocity_V_m_s.y();
  truth_.sway_m_s = velocity_V_m_s.x();
  truth_.yaw_rate_rad_s = vessel.yaw_rate_rad_s;
  measure_distances(scenario_time_s);
  keep_the_least();
}

void World::keep_the_least() noexcept {
  if (truth_.inoffensive_distance_m < truth_.least_inoffensive_distance_m) {
    truth_.least_inoffensive_distance_m = truth_.inoffensive_distance_m;
    truth_.least_inoffensive_distance_at_s = truth_.scenario_time_s;
  }
  truth_.least_hull_clearance_m = std::min(truth_.least_hull_clearance_m, truth_.hull_clearance_m);
}

void World::measure_distances(double scenario_time_s) noexcept {
  const VesselState& vessel = vessel_.state();
  truth_.inoffensive_distance_m = kInfinity;
  truth_.hull_clearance_m = kInfinity;
  const HullSize hull{parameters_.hull_length_m, parameters_.hull_beam_m};
  const double hull_reach_m = std::hypot(hull.length_m, hull.beam_m) / 2.0;
  for (const MovingObstacle& mover : obstacles_) {
    if (!mover.exists(scenario_time_s)) {
      continue;
    }
    const Obstacle obstacle = mover.at(scenario_time_s);
    const double bound_m = edge_distance_bound_m(obstacle, vessel.pose.p_WV);
    if (bound_m - vehicle_radius_m_ < truth_.inoffensive_distance_m) {
      truth_.inoffensive_distance_m =
          std::min(truth_.inoffensive_distance_m,
                   edge_distance_m(obstacle, vessel.pose.p_WV) - vehicle_radius_m_);
    }
    if (bound_m - hull_reach_m < truth_.hull_clearance_m) {
      truth_.hull_clearance_m =
          std::min(truth_.hull_clearance_m, hull_clearance_m(obstacle, vessel.pose, hull));
    }
  }
}

}  // namespace lodesman
