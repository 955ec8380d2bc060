// SPDX-License-Identifier: Apache-2.0
// The boat's configuration: the shipped defaults, a profile, overlays and single values, read
// strictly and accounted for key by key in every program. One thread, at start-up; everything that
// is wrong throws StartupError.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "deploy/boat/common_options.h"
#include "drivers/hal/thrust_shape.h"
#include "hal_sim/scenario/detection_errors.h"
#include "high_level/tasks/high_level.h"
#include "low_level/tasks/low_level.h"
#include "mid_level/base/geodesy.h"
#include "mid_level/config/read_mission.h"
#include "mid_level/config/toml_document.h"

namespace lodesman {

// The directory of deploy/config and hal_sim/scenarios: LODESMAN_SHARE where it is set, else
// found upwards from this program's own file.
[[nodiscard]] std::filesystem::path share_directory();

// A file of deploy/config.
[[nodiscard]] std::filesystem::path config_file(const std::string& name);

struct CommandSocketSettings {
  std::string address;
  std::uint16_t port = 0;
  std::string token_file;  // empty: lodesman-high writes one by itself
};

// "scheme:rest", or "none" where the device is optional.
struct DeviceAddresses {
  std::string heading;
  std::string sonar;
  std::string position;
  std::string thrusters;
};

// What moves the simulated vessel.
enum class SimulatedVessel : std::uint8_t {
  kThrust,    // what its simulated thrusters do
  kEstimate,  // it is where the real boat takes itself to be
  kBench,     // it is another program's, behind devices that are real to this one
};

// What the tracks of a simulated boat are made of.
enum class SimulatedScene : std::uint8_t {
  kScenario,    // as the scenario says
  kObstacles,   // the scenario's own obstacles
  kBeams,       // echoes
  kDetections,  // returns, a range a beam, with the errors that the configuration has
};

struct SimulationSettings {
  std::string scenario;  // a file, or the name of a shipped one; empty: no world
  SimulatedVessel vessel = SimulatedVessel::kThrust;
  std::string hull;  // the name of a shipped one, or a file
  Duration lockstep_jitter{};
  Duration sonar_view_period{};
  SimulatedScene scene = SimulatedScene::kScenario;
  DetectionErrors detections;  // of kDetections alone
};

struct BoatConfig {
  explicit BoatConfig(TomlDocument read_from) : document{std::move(read_from)} {}

  TomlDocument document;  // for refusals that name file and line
  std::string name;
  std::string segment;
  DeviceAddresses devices;
  CommandSocketSettings command_socket;
  SimulationSettings simulation;
  // Of the world frame, where no scenario has one; empty: by the first fixes.
  std::optional<GeoPoint> origin;
  std::optional<PositionSource> position;  // empty: what there is
  MissionDefaults mission;
  double speed_limit_m_s = 0.0;
  SpeedTable speeds = SpeedTable::proportional(1.0);
  ThrustShapeOptions thrust_shape;
  LowLevelOptions low;  // what of the levels does not depend on the voyage
  HighLevelOptions high;

  // As one file that holds every key.
  [[nodiscard]] std::string to_text() const { return document.to_text(); }
};

// default.toml, the profile's overlay, the files and values of the command line, in this order.
[[nodiscard]] BoatConfig load_configuration(const std::string& profile,
                                            const CommonOptions& options);

// As to_text() wrote it, with every key; `name` stands in the place of a file's in refusals.
// `sets`: single values to lay over it, as of a command line.
[[nodiscard]] BoatConfig configuration_of(const std::string& text, const std::string& name,
                                          const std::vector<std::string>& sets = {});

}  // namespace lodesman
