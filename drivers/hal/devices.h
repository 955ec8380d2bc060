// SPDX-License-Identifier: Apache-2.0
// The device contracts. Each is polled or commanded by one thread, never blocks, never throws
// and allocates nothing once made; tests/conformance says the rest, for every implementation.
#pragma once

#include "drivers/hal/reading.h"
#include "mid_level/base/time.h"
#include "mid_level/messages/arming.h"
#include "mid_level/messages/command.h"
#include "mid_level/messages/health.h"
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

  // What ails it, as far as it knows by its last poll or command.
  [[nodiscard]] virtual DeviceFault fault() const noexcept { return DeviceFault::kNone; }
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

// What became of a command to a thruster box.
enum class CommandStatus : std::uint8_t {
  kTaken,         // as far as it can be known, the thrusters run as commanded
  kNotReady,      // the box is there and gets neutral: it is being tried, or is at fault
  kDisconnected,  // it is gone; what it does by itself is to stop after its time-out
};

struct BatteryReading {
  Time measured{};     // [ns] 0: never
  double volts = 0.0;  // [V]
};

// Two thrusters behind one box. A command holds until the next one; the box stops both by itself
// when none comes for its time-out. It is commanded at every step of its task, neutral from the
// beginning: a driver gets on with its start-up in these calls, and none of its commands is taken
// until the box has been seen to stop by itself.
class ThrusterPair : public Device {
 public:
  [[nodiscard]] virtual CommandStatus command(ThrustCommand command, Time now) noexcept = 0;

  // Before the first command: what is on record of the box, and when a program that was here before
  // last commanded it. A driver that can find out that it is still so need not have it all proved.
  virtual void recall(const BoxProof& /*proof*/, Time /*last_command*/) noexcept {}
  // The proof that stands now; gone with the connection, and where anything is doubted.
  [[nodiscard]] virtual BoxProof proof() const noexcept { return {}; }

  // The newest that the box has told of the battery.
  [[nodiscard]] virtual BatteryReading battery() const noexcept { return {}; }
};

}  // namespace lodesman
