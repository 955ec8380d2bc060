// SPDX-License-Identifier: Apache-2.0
#include "deploy/boat/configuration.h"

#include <cstdlib>

#include "deploy/boat/level_options.h"

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

}  // namespace lodesman
