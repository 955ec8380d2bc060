// SPDX-License-Identifier: Apache-2.0
// The low level put together: its tasks on a blackboard, for the devices it is given. Made before
// any task runs, by the main file of the process or by the lock-step simulation.
#pragma once

#include <memory>
#include <vector>

#include "drivers/hal/devices.h"
#include "low_level/tasks/delta_t.h"
#include "low_level/tasks/path_finder.h"
#include "low_level/tasks/sensors.h"
#include "low_level/tasks/thruster.h"

namespace lodesman {

struct LowLevelDevices {
  std::unique_ptr<HeadingSensor> heading;
  std::unique_ptr<ImagingSonar> sonar;
  std::unique_ptr<PositionSensor> position;  // none where the boat has no receiver
  std::unique_ptr<ThrusterPair> thrusters;   // none on a dry run
};

struct LowLevelOptions {
  DeltaTOptions delta_t;
  ThrusterOptions thruster;
  PositionTaskOptions position;
  double heading_turn_rad = 0.0;  // [rad] [-pi, pi] of the heading sensor in the vehicle, clockwise
};

class LowLevel {
 public:
  LowLevel(Blackboard& board, Role role, LowLevelDevices devices, LowLevelOptions options);
  [[nodiscard]] std::vector<TaskEntry> tasks();

 private:
  LowLevelDevices devices_;
  AhrsTask ahrs_;
  PositionTask position_;
  DeltaTTask delta_t_;
  PathFinderTask path_finder_;
  ThrusterTask thruster_;
};

}  // namespace lodesman
