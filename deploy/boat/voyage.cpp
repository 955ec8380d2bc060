// SPDX-License-Identifier: Apache-2.0
#include "deploy/boat/voyage.h"
#include "deploy/boat/level_options.h"

namespace lodesman {

LowLevelOptions low_level_options(const TomlDocument& configuration, const Scenario& scenario) {
  LowLevelOptions options = read_low_level_options(configuration.root());
  options.sonar_range_m = scenario.sonar.range_m;
  options.delta_t.track_oracle.sector_rad = scenario.sonar.sector_rad;
  options.delta_t.track_oracle.seed = scenario.seed;
  if (scenario.sonar.scene == SonarScene::kObstacles) {
    options.delta_t.known_scene = scenario.obstacles;
  }
  return options;
}

HighLevelOptions high_level_options(const TomlDocument& configuration, const Scenario& scenario) {
  HighLevelOptions options = read_high_level_options(configuration.root());
  options.estimator.source = scenario.position.source;
  options.estimator.start = scenario.mission.start.p_WV;
  options.estimator.origin = {scenario.environment.origin_latitude_deg,
                              scenario.environment.origin_longitude_deg};
  options.planner.sonar_range_m = scenario.sonar.range_m;
  auto& mission = options.planner.mission;
  mission.goals = scenario.mission.waypoints;
  mission.goals.push_back(scenario.mission.goal);
  mission.goal_radius_m = scenario.mission.goal_radius_m;
  options.controller.surge_ref = scenario.surge_ref;
  options.planner.progress.least_way_m =
      least_way_m(options.planner.progress,
                  scenario.surge_ref * options.estimator.dead_reckoning.speed_per_surge_ref_m_s);
  if (auto& pilot = options.planner.replanner.pilot; pilot) {
    pilot->response.speed_max_m_s =
        scenario.surge_ref * options.estimator.dead_reckoning.speed_per_surge_ref_m_s;
    pilot->response.look_ahead_m += options.controller.look_ahead_s * pilot->response.speed_max_m_s;
    options.controller.look_ahead_m = pilot->response.look_ahead_m;
    options.controller.speed_m_s = pilot->response.speed_max_m_s;
  }
  return options;
}

}  // namespace lodesman
