// SPDX-License-Identifier: Apache-2.0
// In a line what a program of the boat does, for `systemctl status`. The main thread of the program
// that it speaks of.
#pragma once

#include <array>
#include <string>

#include "mid_level/blackboard/blackboard.h"

namespace lodesman {

// "thrusters disarmed; heading working, sonar disconnected (no_way), ..."
class LowStatusLine {
 public:
  explicit LowStatusLine(const Blackboard& board);
  [[nodiscard]] std::string text();

 private:
  Reader<ThrustStatus> thrust_;
  std::array<Reader<DeviceHealth>, kDeviceCount> devices_;
};

// "mission under_way"
class HighStatusLine {
 public:
  explicit HighStatusLine(const Blackboard& board);
  [[nodiscard]] std::string text(bool low_is_alive);

 private:
  Reader<MissionStatus> mission_;
};

}  // namespace lodesman
