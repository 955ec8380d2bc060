// SPDX-License-Identifier: Apache-2.0
// Where the shipped files lie, and the configuration put together from profile, overlays and
// single values. One thread, at start-up; everything that is wrong throws StartupError.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "deploy/cli/common_options.h"
#include "hal_sim/world/scenario.h"
#include "high_level/tasks/high_level.h"
#include "low_level/tasks/low_level.h"
#include "mid_level/base/config/toml_document.h"

namespace lodesman::cli {

// The directory of deploy/config and hal_sim/scenarios: LODESMAN_SHARE where it is set, else
// found upwards from this program's own file.
[[nodiscard]] std::filesystem::path share_directory();

// A file of deploy/config.
[[nodiscard]] std::filesystem::path config_file(const std::string& name);

// default.toml, the profile's overlay, the files and values of the command line, in this order.
// Every key has been read and checked.
[[nodiscard]] TomlDocument load_configuration(const std::string& profile,
                                              const CommonOptions& options);

// A file that holds every key, as lodesman-low and lodesman-high are given it: checked as whole as
// the one above, whichever part of it the program goes on to use.
[[nodiscard]] TomlDocument load_whole_configuration(const std::filesystem::path& file);

// By path, or by the name of a shipped scenario.
[[nodiscard]] Scenario load_named_scenario(const std::string& name_or_path);
[[nodiscard]] std::filesystem::path scenario_file(const std::string& name_or_path);
[[nodiscard]] VesselParameters load_vessel_parameters();

// The options of each level for a scenario that is simulated.
[[nodiscard]] LowLevelOptions low_level_options(const TomlDocument& configuration,
                                                const Scenario& scenario);
[[nodiscard]] HighLevelOptions high_level_options(const TomlDocument& configuration,
                                                  const Scenario& scenario);

// The scenario with the zones that are planned with: its own, or those that the pilot makes round
// what it gives a zone to and is sure of.
[[nodiscard]] Scenario with_planned_zones(Scenario scenario, const HighLevelOptions& options);

// What the other sections say.
struct CommandSocketSettings {
  std::string address;
  std::uint16_t port = 0;
  std::string token_file;  // empty: lodesman-high writes one by itself
};
[[nodiscard]] CommandSocketSettings command_socket_settings(const TomlDocument& configuration);
struct DeviceAddresses {
  std::string heading;
  std::string sonar;
  std::string position;
  std::string thrusters;
};
[[nodiscard]] DeviceAddresses device_addresses(const TomlDocument& configuration);
struct SimulationSettings {
  Duration lockstep_jitter{};
  Duration sonar_view_period{};
};
[[nodiscard]] SimulationSettings simulation_settings(const TomlDocument& configuration);

}  // namespace lodesman::cli
