// SPDX-License-Identifier: Apache-2.0
// What keeps the boat from setting out, as the blackboard has it. Part of the operator's desk; one
// thread.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mid_level/blackboard/blackboard.h"

namespace lodesman {

class Readiness {
 public:
  // `arms_by_itself`: a start arms thrusters that are disarmed and may be armed.
  Readiness(const Blackboard& board, bool arms_by_itself);

  // Every reason not to start at `now`; none: it may.
  [[nodiscard]] std::vector<std::string> reasons(Time now);
  // What ails devices that work nevertheless, each with its name: it may start, and whoever starts
  // it is told.
  [[nodiscard]] std::vector<std::string> warnings();
  // The newest of a device; nullptr before the first.
  [[nodiscard]] const Stamped<DeviceHealth>* device(DeviceId device) {
    return devices_[static_cast<std::size_t>(device)].latest();
  }

 private:
  // "no heading", and what its device says of it.
  [[nodiscard]] std::string lacking(const char* what, DeviceId device, Time now);
  void add_thrust(std::vector<std::string>& reasons, Time now);
  void add_sonar(std::vector<std::string>& reasons, Time now);

  bool arms_by_itself_;

  Reader<Attitude> attitude_;
  Reader<VehicleState> state_;
  Reader<SonarObstacles> obstacles_;
  Reader<ThrustApplied> thrust_;
  Reader<ThrustStatus> arming_;
  std::array<Reader<DeviceHealth>, kDeviceCount> devices_;
};

}  // namespace lodesman
