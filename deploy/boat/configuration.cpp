// SPDX-License-Identifier: Apache-2.0
#include "deploy/boat/configuration.h"

#include <cmath>
#include <cstdlib>
#include <utility>

#include "deploy/boat/level_options.h"
#include "deploy/boat/recorder_settings.h"
#include "high_level/mission/network.h"
#include "mid_level/config/read_speed_table.h"

namespace lodesman {
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

// A word that is no TOML value is meant as a string: --set devices.position=none.
[[nodiscard]] std::string as_toml(const std::string& set, std::size_t equals) {
  const std::string value = set.substr(equals + 1);
  const bool bare = !value.empty() && value.find_first_of(" \t\"'[]{}#=") == std::string::npos &&
                    value.find_first_not_of("0123456789+-.eE_") != std::string::npos;
  const bool is_toml_word = value == "true" || value == "false" || value == "inf" ||
                            value == "nan" || value.starts_with("0x");
  return bare && !is_toml_word ? set.substr(0, equals + 1) + '"' + value + '"' : set;
}

void overlay(const std::vector<std::string>& sets, TomlDocument& configuration) {
  for (const auto& set : sets) {
    const auto equals = set.find('=');
    if (equals == 0 || equals == std::string::npos || set.find('\n') != std::string::npos) {
      throw StartupError("--set", 1, set, "must be SECTION.KEY=VALUE");
    }
    configuration.overlay(TomlDocument::from_text(as_toml(set, equals), "--set"));
  }
}

[[nodiscard]] TomlDocument put_together(const std::string& profile, const CommonOptions& options) {
  TomlDocument configuration = TomlDocument::from_file(config_file("default.toml"));
  if (profile != "default") {
    configuration.overlay(TomlDocument::from_file(config_file(profile + ".toml")));
  }
  for (const auto& file : options.config_files) {
    configuration.overlay(TomlDocument::from_file(file));
  }
  overlay(options.sets, configuration);
  return configuration;
}

[[nodiscard]] CommandSocketSettings read_command_socket(const TomlTable& table) {
  CommandSocketSettings settings{table.text("address", 64),
                                 static_cast<std::uint16_t>(table.integer("port", 0, 65535)),
                                 table.text("token_file", 4096, 0)};
  const auto reach = reach_of(settings.address);
  if (!reach) {
    table.refuse("address", "must be an IP address");
  }
  if (reach == Reach::kNetwork && settings.token_file.empty()) {
    table.refuse("address",
                 "beyond loopback a token_file is needed: lodesman token --new FILE makes one");
  }
  return settings;
}

[[nodiscard]] DeviceAddresses read_devices(const TomlTable& table) {
  return {table.text("heading", 256), table.text("sonar", 256), table.text("position", 256),
          table.text("thrusters", 256)};
}

[[nodiscard]] SimulationSettings read_simulation(const TomlTable& table) {
  SimulationSettings settings;
  settings.scenario = table.text("scenario", 4096, 0);
  settings.vessel =
      static_cast<SimulatedVessel>(table.choice("vessel", {"thrust", "estimate", "bench"}));
  settings.hull = table.text("hull", 4096);
  settings.lockstep_jitter = table.duration("lockstep_jitter_s", Range::between(0.0, 0.1));
  settings.sonar_view_period = table.duration("sonar_view_period_s", Range::between(0.05, 60.0));
  settings.scene = static_cast<SimulatedScene>(
      table.choice("scene", {"scenario", "obstacles", "beams", "detections"}));
  settings.detections = read_detection_errors(table.table("detections"));
  if (settings.detections.any() && settings.scene != SimulatedScene::kDetections) {
    table.refuse("detections", "is of scene = \"detections\" alone");
  }
  return settings;
}

[[nodiscard]] std::optional<GeoPoint> read_origin(const TomlTable& table) {
  const auto deg = table.pair("deg", Range::between(-180.0, 180.0));
  if (std::abs(deg[0]) > 85.0) {
    table.refuse("deg", "latitude must be at least -85 and at most 85");
  }
  return table.boolean("at_start") ? std::nullopt : std::optional{GeoPoint{deg[0], deg[1]}};
}

[[nodiscard]] std::optional<PositionSource> read_position_source(const TomlTable& estimator) {
  const std::size_t word =
      estimator.choice("position_source", {"truth", "gps", "dead_reckoning", "auto"});
  return word < 3 ? std::optional{static_cast<PositionSource>(word)} : std::nullopt;
}

// Every key is read here, whichever part of it the program goes on to use: what is left is unknown.
[[nodiscard]] BoatConfig read(TomlDocument document) {
  BoatConfig config{std::move(document)};
  const TomlTable root = config.document.root();
  const TomlTable boat = root.table("boat");
  config.name = boat.text("name", 64);
  config.segment = boat.text("segment", 64);
  config.devices = read_devices(root.table("devices"));
  config.command_socket = read_command_socket(root.table("command_socket"));
  config.simulation = read_simulation(root.table("simulation"));
  static_cast<void>(read_recorder(root.table("recorder")));
  config.origin = read_origin(root.table("origin"));
  config.position = read_position_source(root.table("estimator"));
  config.mission = read_mission_defaults(root.table("mission"));
  config.speed_limit_m_s = root.table("mission").number("speed_limit_m_s", Range::above(0.0, 10.0));
  config.speeds = read_speed_table(root.table("vehicle"));
  config.thrust_shape = read_thrust_shape(root.table("vehicle"));
  config.low = read_low_level_options(root);
  config.high = read_high_level_options(root, config.speeds);
  config.document.require_all_keys_read();
  return config;
}

}  // namespace

BoatConfig load_configuration(const std::string& profile, const CommonOptions& options) {
  return read(put_together(profile, options));
}

BoatConfig configuration_of(const std::string& text, const std::string& name,
                            const std::vector<std::string>& sets) {
  TomlDocument configuration = TomlDocument::from_text(text, name);
  overlay(sets, configuration);
  return read(std::move(configuration));
}

}  // namespace lodesman
