// SPDX-License-Identifier: Apache-2.0
#include "deploy/boat/named_scenario.h"

#include <array>
#include <cmath>

#include "deploy/boat/configuration.h"
#include "hal_sim/campaign/encounter.h"

namespace lodesman {
namespace fs = std::filesystem;

fs::path scenario_file(const std::string& name_or_path) {
  const std::array directories{share_directory() / "hal_sim" / "scenarios"};
  return find_scenario(name_or_path, directories);
}

std::optional<fs::path> hull_file(const std::string& name_or_path) {
  std::error_code ignored;
  const bool is_name = name_or_path.find('/') == std::string::npos;
  for (const fs::path& file :
       {is_name ? share_directory() / "hal_sim" / "vessels" / (name_or_path + ".toml") : fs::path{},
        fs::path{name_or_path}}) {
    if (fs::is_regular_file(file, ignored)) {
      return file;
    }
  }
  return std::nullopt;
}

VesselParameters load_hull(const std::string& name_or_path) {
  const auto file = hull_file(name_or_path);
  if (!file) {
    throw StartupError(name_or_path + kNoHull);
  }
  return load_vessel(*file);
}

Scenario load_named_scenario(const std::string& name_or_path, const SpeedTable& speeds) {
  if (const auto number = encounter_number(name_or_path)) {
    return read_scenario(TomlDocument::from_text(encounter_scenario(*number), name_or_path),
                         speeds);
  }
  return load_scenario(scenario_file(name_or_path), speeds);
}

Scenario with_planned_zones(Scenario scenario, const HighLevelOptions& options) {
  if (!options.planner.replanner.pilot) {
    return scenario;
  }
  const PilotOptions& pilot = *options.planner.replanner.pilot;
  const double speed_m_s = scenario.speed_m_s;
  for (MovingObstacle& obstacle : scenario.obstacles) {
    const bool slow = std::hypot(obstacle.velocity_x_m_s, obstacle.velocity_y_m_s) <=
                      pilot.zones.slow_share * speed_m_s;
    put_zone(obstacle.at_start,
             slow ? sure_zone_m(pilot.zones, pilot.response.model, speed_m_s) : 0.0);
  }
  return scenario;
}

}  // namespace lodesman
