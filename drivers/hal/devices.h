// SPDX-License-Identifier: Apache-2.0
// The device contracts. Each is polled or commanded by one thread, never blocks, never throws
// and allocates nothing once made; tests/conformance says the rest, for every implementation.
#pragma once

#include "drivers/hal/reading.h"
#include "mid_level/base/time.h"
#include "mid_level/messages/command.h"
#include "mid_level/messages/sonar.h"
#include "mid_level/messages/vehicle.h"

namespace lodesman {

// Everything every contract has in common.
class Device {
 public:
  Device() = default;
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  virtual ~Device() = default;
};

// An AHRS. True heading; samples are given once each, in the order they were measured.
class HeadingSensor : public Device {
 public:
  [[nodiscard]] virtual Reading<Attitude> poll(Time now) noexcept = 0;
};

// A multibeam forward-looking sonar delivers pings, nothing else. `out` is the caller's buffer (a
// ping is too large to return by value); it is written only when the answer is kFresh.
class ImagingSonar : public Device {
 public:
  [[nodiscard]] virtual ReadStatus poll(Time now, SonarPing& out) noexcept = 0;
};

// A satellite receiver, or what stands for one.
class PositionSensor : public Device {
 public:
  [[nodiscard]] virtual Reading<PositionFix> poll(Time now) noexcept = 0;
};

// Two thrusters behind one box. A command holds until the next one; the box stops both by itself
// when none comes for its time-out.
class ThrusterPair : public Device {
 public:
  // False when the box did not take the command.
  [[nodiscard]] virtual bool command(ThrustCommand command, Time now) noexcept = 0;
};

}  // namespace lodesman
