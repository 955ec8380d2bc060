// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/scenario/scenario.h"

#include <limits>

#include "hal_sim/scenario/limits.h"
#include "mid_level/base/geodesy.h"
#include "mid_level/base/short_number.h"
#include "mid_level/config/read_mission.h"

namespace lodesman {
namespace {

// As limits.h has it, of what only a scenario as a whole has.
constexpr double kMaxTimeLimit_s = 1e5;
constexpr double kMaxRadius_m = 100.0;
constexpr std::size_t kMaxNameLength = 64;

[[nodiscard]] WorldPoint point_of(const std::array<double, 2>& pair) {
  return {{pair[0], pair[1]}};
}

[[nodiscard]] std::string read_name(const TomlTable& root) {
  std::string name = root.text("name", kMaxNameLength);
  if (name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789.-") != std::string::npos) {
    root.refuse("name", "may hold a-z, 0-9, '.' and '-' only");
  }
  return name;
}

void read_vehicle(const TomlTable& vehicle, const SpeedTable& speeds, Scenario& scenario) {
  if (vehicle.has("speed_m_s") == vehicle.has("surge_ref")) {
    vehicle.refuse(vehicle.has("speed_m_s") ? "surge_ref" : "speed_m_s",
                   "give either speed_m_s or surge_ref");
  }
  if (vehicle.has("surge_ref")) {
    scenario.surge_ref = static_cast<int>(vehicle.integer("surge_ref", 1, kMaxSurgeRef));
    scenario.speed_m_s = speeds.speed_m_s(scenario.surge_ref);
  } else {
    const double wanted_m_s = vehicle.number("speed_m_s", Range::above(0.0, kMaxSpeed_m_s));
    if (const std::string no = speeds.objection(wanted_m_s); !no.empty()) {
      vehicle.refuse("speed_m_s", no);
    }
    const HeldSpeed held = speeds.held(wanted_m_s);
    scenario.surge_ref = held.surge_ref;
    scenario.speed_m_s = held.speed_m_s;
  }
  scenario.vehicle_radius_m = vehicle.number("radius_m", Range::above(0.0, kMaxRadius_m));
}

[[nodiscard]] ScenarioMission read_scenario_mission(const TomlTable& table,
                                                    const Scenario& scenario) {
  ScenarioMission mission;
  mission.start.p_WV =
      point_of(table.pair("start_m", Range::between(-kMaxCoordinate_m, kMaxCoordinate_m)));
  mission.start.heading = Heading::clockwise_from_y_rad(
      to_rad(table.number("start_heading_deg", Range::between(0.0, 360.0))));
  (void)table.number("goal_radius_m", Range::above(0.0, kMaxRadius_m));  // here it is required
  const LocalFrame frame{
      {scenario.environment.origin_latitude_deg, scenario.environment.origin_longitude_deg}};
  mission.definition = read_mission(table, {.speed_m_s = scenario.speed_m_s}, &frame);
  return mission;
}

// The shortest way that counts as done: each waypoint and the goal are reached at their radius.
void require_reachable(const TomlTable& table, const Scenario& scenario) {
  const ScenarioMission& mission = scenario.mission;
  const double radius_m = mission.definition.goal_radius_m;
  double way_m = -radius_m;
  WorldPoint from = mission.start.p_WV;
  for (const Goal& waypoint : mission.waypoints()) {
    const WorldPoint to{{waypoint.x_m, waypoint.y_m}};
    way_m += (to.xy_m - from.xy_m).norm() - 2.0 * radius_m;
    from = to;
  }
  way_m += (mission.goal().xy_m - from.xy_m).norm();
  const double reach_m = scenario.speed_m_s * scenario.time_limit_s;
  if (way_m > reach_m) {
    table.refuse("goal_m", "is farther than speed x time limit (" + short_number(way_m) +
                               " m on the way, " + short_number(reach_m) + " m in the time)");
  }
}

[[nodiscard]] ScenarioEnvironment read_environment(const TomlTable& table) {
  ScenarioEnvironment environment;
  if (table.has("current_m_s")) {
    const auto current = table.pair("current_m_s", Range::between(-kMaxSpeed_m_s, kMaxSpeed_m_s));
    environment.current_x_m_s = current[0];
    environment.current_y_m_s = current[1];
  }
  environment.lift = table.boolean_or("lift", environment.lift);
  if (table.has("origin_deg")) {
    const auto origin = table.pair("origin_deg", Range::between(-180.0, 180.0));
    // Not up to the poles, where east has no meaning.
    if (std::abs(origin[0]) > 85.0) {
      table.refuse("origin_deg", "latitude must be at least -85 and at most 85");
    }
    environment.origin_latitude_deg = origin[0];
    environment.origin_longitude_deg = origin[1];
  }
  return environment;
}

[[nodiscard]] ScenarioPosition read_position(const TomlTable& table) {
  ScenarioPosition position;
  if (table.has("source")) {
    position.source =
        static_cast<PositionSource>(table.choice("source", {"truth", "gps", "dead_reckoning"}));
  }
  position.gps_sigma_m =
      table.number_or("gps_sigma_m", Range::between(0.0, kMaxRadius_m), position.gps_sigma_m);
  return position;
}

[[nodiscard]] ScenarioSonar read_sonar(const TomlTable& table) {
  ScenarioSonar sonar;
  if (table.has("scene")) {
    sonar.scene =
        static_cast<SonarScene>(table.choice("scene", {"obstacles", "beams", "detections"}));
  }
  if (table.has("noise")) {
    sonar.noise = static_cast<SonarNoise>(table.choice("noise", {"none", "tank", "sea"}));
  }
  sonar.range_m = table.number_or("range_m", Range::between(1.0, 300.0), sonar.range_m);
  sonar.sector_rad =
      to_rad(table.number_or("sector_deg", Range::between(1.0, 180.0), to_deg(sonar.sector_rad)));
  sonar.beams = static_cast<std::uint32_t>(table.integer_or("beams", 1, kMaxBeams, sonar.beams));
  sonar.bins = static_cast<std::uint32_t>(table.integer_or("bins", 1, kMaxBins, sonar.bins));
  // At most one ping a step of the world.
  sonar.ping_hz = table.number_or("ping_hz", Range::between(0.1, 50.0), sonar.ping_hz);
  if (table.has("detections")) {
    if (sonar.scene != SonarScene::kDetections) {
      table.refuse("detections", "is of scene = \"detections\" alone");
    }
    sonar.detections = read_detection_errors(table.table("detections"));
  }
  return sonar;
}

}  // namespace

Scenario read_scenario(const TomlDocument& document, const SpeedTable& speeds) {
  const TomlTable root = document.root();
  Scenario scenario;
  scenario.name = read_name(root);
  scenario.seed =
      static_cast<std::uint64_t>(root.integer("seed", 0, std::numeric_limits<std::int64_t>::max()));
  scenario.time_limit_s = root.number("time_limit_s", Range::above(0.0, kMaxTimeLimit_s));
  if (root.has("environment")) {
    scenario.environment = read_environment(root.table("environment"));
  }
  const TomlTable mission = root.table("mission");
  read_vehicle(root.table("vehicle"), speeds, scenario);
  scenario.mission = read_scenario_mission(mission, scenario);
  scenario.obstacles = read_obstacles(root);
  if (root.has("position")) {
    scenario.position = read_position(root.table("position"));
  }
  if (root.has("sonar")) {
    scenario.sonar = read_sonar(root.table("sonar"));
  }
  scenario.faults = read_faults(root);
  document.require_all_keys_read();
  require_reachable(mission, scenario);
  return scenario;
}

Scenario load_scenario(const std::filesystem::path& path, const SpeedTable& speeds) {
  return read_scenario(TomlDocument::from_file(path), speeds);
}

std::filesystem::path find_scenario(const std::string& name_or_path,
                                    std::span<const std::filesystem::path> directories) {
  std::error_code error;
  if (std::filesystem::is_regular_file(name_or_path, error)) {
    return name_or_path;
  }
  std::string looked;
  for (const auto& directory : directories) {
    std::filesystem::path file = directory / (name_or_path + ".toml");
    if (std::filesystem::is_regular_file(file, error)) {
      return file;
    }
    looked += ", nor " + file.string();
  }
  throw StartupError(name_or_path, 1, "file", "there is no such file" + looked);
}

}  // namespace lodesman
