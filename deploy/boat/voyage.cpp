// SPDX-License-Identifier: Apache-2.0
#include "deploy/boat/voyage.h"

#include "deploy/boat/assembled_boat.h"

namespace lodesman {
namespace {

[[nodiscard]] PositionSource position_source_of(const BoatConfig& config,
                                                const Scenario* scenario) {
  if (config.position) {
    return *config.position;
  }
  if (scenario != nullptr && config.simulation.vessel == SimulatedVessel::kThrust) {
    return scenario->position.source;
  }
  return config.devices.position == "none" ? PositionSource::kDeadReckoning : PositionSource::kGps;
}

}  // namespace

ScenarioSonar sailed_sonar(const BoatConfig& config, const Scenario& scenario) {
  ScenarioSonar sonar = scenario.sonar;
  switch (config.simulation.scene) {
    case SimulatedScene::kScenario:
      break;
    case SimulatedScene::kObstacles:
      sonar.scene = SonarScene::kObstacles;
      break;
    case SimulatedScene::kBeams:
      sonar.scene = SonarScene::kBeams;
      break;
    case SimulatedScene::kDetections:
      sonar.scene = SonarScene::kDetections;
      sonar.detections = config.simulation.detections;
      break;
  }
  return sonar;
}

Voyage voyage_of(const BoatConfig& config, const Scenario* scenario) {
  Voyage voyage;
  voyage.position_source = position_source_of(config, scenario);
  voyage.origin = config.origin;
  if (scenario == nullptr) {
    return voyage;
  }
  voyage.start = scenario->mission.start.p_WV;
  // A real boat among simulated obstacles is where its own fixes say.
  if (config.simulation.vessel == SimulatedVessel::kThrust) {
    voyage.origin = GeoPoint{scenario->environment.origin_latitude_deg,
                             scenario->environment.origin_longitude_deg};
  }
  voyage.seed = scenario->seed;
  voyage.mission = scenario->mission.definition;
  voyage.sonar_sector_rad = scenario->sonar.sector_rad;
  if (sailed_sonar(config, *scenario).scene == SonarScene::kObstacles) {
    voyage.known_scene = scenario->obstacles;
  }
  return voyage;
}

LowLevelOptions low_level_options(const BoatConfig& config, const Voyage& voyage) {
  LowLevelOptions options = config.low;
  options.delta_t.track_oracle.sector_rad = voyage.sonar_sector_rad;
  options.delta_t.track_oracle.seed = voyage.seed;
  options.delta_t.known_scene = voyage.known_scene;
  options.position.origin = voyage.origin;
  return options;
}

HighLevelOptions high_level_options(const BoatConfig& config, const Voyage& voyage) {
  HighLevelOptions options = config.high;
  options.estimator.source = voyage.position_source;
  options.estimator.start = voyage.start;
  options.estimator.origin = voyage.origin;
  // One's own echoes lie where they are from the boat, wherever it is itself.
  if (auto& pilot = options.planner.replanner.pilot; pilot && !voyage.known_scene) {
    pilot->zones.own_doubt_share = 0.0;
  }
  return options;
}

DeskOptions desk_options(const BoatConfig& config, const Voyage& voyage) {
  DeskOptions options;
  options.mission = config.mission;
  options.origin = voyage.origin;
  options.speeds = config.speeds;
  options.at_hand = voyage.mission;
  // Nothing real can turn.
  options.arms_by_itself = !has_real_thrusters(config);
  const auto& pilot = config.high.planner.replanner.pilot;
  options.plans_in_world = pilot.has_value();
  options.tunables.speed_limit_m_s = config.speed_limit_m_s;
  options.tunables.heading_gain_per_deg = config.high.controller.steering.heading_gain_per_deg;
  if (pilot) {
    options.tunables.margin_m = pilot->zones.margin_m;
    options.tunables.side_gain_m = pilot->side_gain_m;
    options.tunables.manoeuvre_gain_s = pilot->manoeuvres.switch_gain_s;
    options.least_margin_m = pilot->zones.least_margin_m;
  }
  return options;
}

}  // namespace lodesman
