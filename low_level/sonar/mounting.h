// SPDX-License-Identifier: Apache-2.0
// Where the sonar's head sits in the vehicle, and what it sees brought from the head's frame into
// the vehicle's. Pure functions; any thread.
#pragma once

#include "mid_level/messages/sonar.h"

namespace lodesman {

// As it stands the head is the vehicle's origin, and changes nothing.
struct SonarMounting {
  double x_m = 0.0;       // [m] [vehicle] to starboard of the origin
  double y_m = 0.0;       // [m] [vehicle] ahead of it
  double turn_rad = 0.0;  // [rad] [-pi, pi] clockwise from ahead, of where it looks
};

void move_to_vehicle(const SonarMounting& mounting, SonarObstacles& obstacles) noexcept;

}  // namespace lodesman
