// SPDX-License-Identifier: Apache-2.0
// Where the shipped files lie, and the configuration put together from profile, overlays and
// single values. One thread, at start-up; everything that is wrong throws StartupError.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "deploy/boat/program_options.h"
#include "mid_level/config/toml_document.h"

namespace lodesman {

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

}  // namespace lodesman
