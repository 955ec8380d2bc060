// SPDX-License-Identifier: Apache-2.0
#include "deploy/cli/run/settings.h"

#include <array>
#include <cmath>
#include <cstdlib>

#include "hal_sim/campaign/encounter.h"

namespace lodesman::cli {
namespace fs = std::filesystem;

fs::path share_directory() {
  // NOLINTNEXTLINE(concurrency-mt-unsafe): nobody writes it
  const char* named = std::getenv("LODESMAN_SHARE");
  if (named != nullptr && *named != '\0') {
    return named;
  }
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  for (fs::path place = program.parent_path(); place != place.root_path();
       place = place.parent_path()) {
    for (const auto& candidate : {place, place / "share" / "lodesman"}) {
      if (fs::exists(candidate / "deploy" / "config" / "default.toml", error)) {
        return candidate;
      }
    }
  }
  throw StartupError(
      "the shipped configuration was not found; set LODESMAN_SHARE to the directory "
      "that holds deploy/config");
}

fs::path config_file(const std::string& name) {
  return share_directory() / "deploy" / "config" / name;
}

namespace {

// Reads every key that any program reads, so that what is left is unknown.
void require_valid(const TomlDocument& configuration) {
  (void)read_low_level_options(configuration.root());
  (void)read_high_level_options(configuration.root());
  (void)command_socket_settings(configuration);
  (void)device_addresses(configuration);
  (void)simulation_settings(configuration);
  configuration.require_all_keys_read();
}

}  // namespace

TomlDocument load_configuration(const std::string& profile, const CommonOptions& options) {
  TomlDocument configuration = TomlDocument::from_file(config_file("default.toml"));
  if (profile != "default") {
    configuration.overlay(TomlDocument::from_file(config_file(profile + ".toml")));
  }
  for (const auto& file : options.config_files) {
    configuration.overlay(TomlDocument::from_file(file));
  }
  for (const auto& set : options.sets) {
    const auto equals = set.find('=');
    if (equals == 0 || equals == std::string::npos || set.find('\n') != std::string::npos) {
      throw StartupError("--set", 1, set, "must be SECTION.KEY=VALUE");
    }
    configuration.overlay(TomlDocument::from_text(set, "--set"));
  }
  require_valid(configuration);
  return configuration;
}

TomlDocument load_whole_configuration(const fs::path& file) {
  TomlDocument configuration = TomlDocument::from_file(file);
  require_valid(configuration);
  return configuration;
}

fs::path scenario_file(const std::string& name_or_path) {
  const std::array directories{share_directory() / "hal_sim" / "scenarios"};
  return find_scenario(name_or_path, directories);
}

VesselParameters load_vessel_parameters() { return load_vessel(config_file("vessel.toml")); }

Scenario load_named_scenario(const std::string& name_or_path) {
  if (const auto number = encounter_number(name_or_path)) {
    return read_scenario(TomlDocument::from_text(encounter_scenario(*number), name_or_path),
                         load_vessel_parameters());
  }
  return load_scenario(scenario_file(name_or_path), load_vessel_parameters());
}

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

Scenario with_planned_zones(Scenario scenario, const HighLevelOptions& options) {
  if (!options.planner.replanner.pilot) {
    return scenario;
  }
  const PilotOptions& pilot = *options.planner.replanner.pilot;
  const double speed_m_s = pilot.response.speed_max_m_s;
  for (MovingObstacle& obstacle : scenario.obstacles) {
    const bool slow = std::hypot(obstacle.velocity_x_m_s, obstacle.velocity_y_m_s) <=
                      pilot.zones.slow_share * speed_m_s;
    put_zone(obstacle.at_start, slow ? sure_zone_m(pilot.zones, speed_m_s) : 0.0);
  }
  return scenario;
}

CommandSocketSettings command_socket_settings(const TomlDocument& configuration) {
  const TomlTable table = configuration.root().table("command_socket");
  return {table.text("address", 64), static_cast<std::uint16_t>(table.integer("port", 0, 65535)),
          table.text("token_file", 4096, 0)};
}

DeviceAddresses device_addresses(const TomlDocument& configuration) {
  const TomlTable table = configuration.root().table("devices");
  return {table.text("heading", 256), table.text("sonar", 256), table.text("position", 256),
          table.text("thrusters", 256)};
}

SimulationSettings simulation_settings(const TomlDocument& configuration) {
  const TomlTable table = configuration.root().table("simulation");
  return {table.duration("lockstep_jitter_s", Range::between(0.0, 0.1)),
          table.duration("sonar_view_period_s", Range::between(0.05, 60.0))};
}

}  // namespace lodesman::cli
