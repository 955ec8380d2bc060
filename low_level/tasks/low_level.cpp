// SPDX-License-Identifier: Apache-2.0
#include "low_level/tasks/low_level.h"

#include <utility>

#include "low_level/sonar/segmentation_config.h"
#include "mid_level/runtime/task_table.h"

namespace lodesman {

LowLevelOptions read_low_level_options(const TomlTable& configuration) {
  LowLevelOptions options;
  options.delta_t.segmentation = read_segmentation_options(configuration.table("segmentation"));
  const TomlTable zones = configuration.table("zones");
  const OwnZones own{zones.number("hull_radius_m", Range::between(0.0, 10.0)),
                     zones.number("margin_m", Range::between(0.0, 20.0))};
  if (zones.choice("source", {"own", "protection"}) == 0) {
    options.delta_t.own_zones = own;
  }
  const TomlTable tracks = configuration.table("tracks");
  auto& oracle = options.delta_t.track_oracle;
  oracle.delay = tracks.duration("delay_s", Range::between(0.0, 2.0));
  oracle.place_sigma_m = tracks.number("place_sigma_m", Range::between(0.0, 5.0));
  oracle.velocity_sigma_m_s = tracks.number("velocity_sigma_m_s", Range::between(0.0, 1.0));
  oracle.dropout = tracks.number("dropout", Range::between(0.0, 0.99));
  oracle.memory = tracks.duration("memory_s", Range::between(0.0, 3600.0));
  return options;
}

LowLevel::LowLevel(Blackboard& board, Role role, LowLevelDevices devices, LowLevelOptions options)
    : devices_{std::move(devices)},
      ahrs_{board, role, *devices_.heading},
      position_{devices_.position != nullptr
                    ? std::make_unique<PositionTask>(board, role, *devices_.position)
                    : nullptr},
      delta_t_{board, role, *devices_.sonar, std::move(options.delta_t)},
      path_finder_{board, role, options.sonar_range_m},
      thruster_{board, role, *devices_.thrusters} {}

std::vector<TaskEntry> LowLevel::tasks() {
  std::vector<TaskEntry> entries{
      scheduled(TaskId::kAhrs, ahrs_), scheduled(TaskId::kDeltaT, delta_t_),
      scheduled(TaskId::kPathFinder, path_finder_), scheduled(TaskId::kThruster, thruster_)};
  if (position_ != nullptr) {
    entries.push_back(scheduled(TaskId::kPosition, *position_));
  }
  return entries;
}

}  // namespace lodesman
