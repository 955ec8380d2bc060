// SPDX-License-Identifier: Apache-2.0
// A scenario file, read and checked: everything that a simulated run needs to know. Plain data,
// read by one thread before any task runs; afterwards any thread may look at it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "hal_sim/scenario/detection_errors.h"
#include "hal_sim/scenario/fault.h"
#include "mid_level/base/frames.h"
#include "mid_level/base/speed_table.h"
#include "mid_level/config/toml_document.h"
#include "mid_level/geometry/moving_obstacle.h"
#include "mid_level/messages/mission.h"
#include "mid_level/messages/sonar.h"
#include "mid_level/messages/vehicle.h"

namespace lodesman {

struct ScenarioMission {
  VehiclePose start;
  MissionDefinition definition;  // what the boat is told; it has a goal

  // Visited in order before the goal.
  [[nodiscard]] std::span<const Goal> waypoints() const noexcept {
    return {definition.goals.data(), definition.goal_count - 1};
  }
  [[nodiscard]] WorldPoint goal() const noexcept {
    const Goal& last = definition.goals[definition.goal_count - 1];
    return {{last.x_m, last.y_m}};
  }
};

struct ScenarioEnvironment {
  double current_x_m_s = 0.0;  // [world]
  double current_y_m_s = 0.0;  // [world]
  bool lift = false;
  double origin_latitude_deg = 35.0;
  double origin_longitude_deg = 139.0;
};

struct ScenarioPosition {
  PositionSource source = PositionSource::kTruth;  // what the estimator is fed
  double gps_sigma_m = 1.0;
};

enum class SonarScene : std::uint8_t {
  kObstacles,   // the low level draws the known obstacles
  kBeams,       // simulated echoes, segmented and tracked
  kDetections,  // simulated returns, a range a beam, with errors by rate; tracked
};
// What the simulated sonar hears besides clean echoes: docs/sonar_simulation.md.
enum class SonarNoise : std::uint8_t { kNone, kTank, kSea };

struct ScenarioSonar {
  SonarScene scene = SonarScene::kObstacles;
  SonarNoise noise = SonarNoise::kNone;
  double range_m = 30.0;
  double sector_rad = to_rad(120.0);
  std::uint32_t beams = 120;
  std::uint32_t bins = 500;
  double ping_hz = 10.0;
  DetectionErrors detections;  // of kDetections alone
};

struct Scenario {
  std::string name;
  std::uint64_t seed = 0;
  double time_limit_s = 0.0;
  ScenarioMission mission;
  int surge_ref = 0;       // [1, 100]
  double speed_m_s = 0.0;  // that SurgeRef holds, by the boat's own calibration
  double vehicle_radius_m = 0.0;
  std::vector<MovingObstacle> obstacles;  // ids 1, 2, ... in the order of the file
  ScenarioEnvironment environment;
  ScenarioPosition position;
  ScenarioSonar sonar;
  std::vector<Fault> faults;
};

// Throw StartupError `file:line: key: reason`. The boat's own calibration tells which SurgeRef
// holds a speed.
[[nodiscard]] Scenario read_scenario(const TomlDocument& document, const SpeedTable& speeds);
[[nodiscard]] Scenario load_scenario(const std::filesystem::path& path, const SpeedTable& speeds);

// The [[obstacle]] tables of a scenario.
[[nodiscard]] std::vector<MovingObstacle> read_obstacles(const TomlTable& root);

// The file that is meant: `name_or_path` itself where there is such a file, else
// <directory>/<name_or_path>.toml in the first directory that has it. Throws StartupError.
[[nodiscard]] std::filesystem::path find_scenario(
    const std::string& name_or_path, std::span<const std::filesystem::path> directories);

}  // namespace lodesman
