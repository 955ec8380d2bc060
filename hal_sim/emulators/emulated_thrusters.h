// SPDX-License-Identifier: Apache-2.0
// A thruster box aboard the simulated vessel, set as its documents ask, with its wire, its faults
// and its motors: what stands at the far end of a driver's line. One thread.
#pragma once

#include <memory>
#include <vector>

#include "hal_sim/emulators/line_feed.h"
#include "hal_sim/emulators/maestro_box.h"
#include "hal_sim/emulators/roboclaw_box.h"
#include "hal_sim/emulators/thrust_output.h"
#include "hal_sim/world/sim_link.h"

namespace lodesman {

enum class ThrusterBoxKind : std::uint8_t { kMaestro, kRoboClaw };

struct EmulatedThrustersOptions {
  ThrusterBoxKind kind = ThrusterBoxKind::kMaestro;
  Duration time_out = std::chrono::milliseconds{500};  // as its owner has set it
  bool has_escs = false;  // speed controllers with their manners, behind a servo box
  WireSettings wire;
  std::uint64_t seed = 0;
};

class EmulatedThrusters {
 public:
  EmulatedThrusters(const EmulatedThrustersOptions& options, const std::vector<Fault>& faults,
                    Time now);

  void feel(const WorldSample& world, Time now);
  // What the motors are told at `now`, by when the box was stepped.
  [[nodiscard]] SimThrust output(Time now);
  // [-] [0, 1] the share of full load that this is.
  [[nodiscard]] double share() const noexcept { return share_; }

  [[nodiscard]] FaultyDevice& device() noexcept { return *device_; }
  [[nodiscard]] EmulatedWire& wire() noexcept { return wire_; }
  [[nodiscard]] FaultTimetable& faults() noexcept { return faults_; }

 private:
  bool has_escs_;
  std::unique_ptr<MaestroBox> maestro_;
  std::unique_ptr<RoboClawBox> roboclaw_;
  FaultyDevice* device_;
  EmulatedWire wire_;
  FaultTimetable faults_;
  EmulatedEsc left_;
  EmulatedEsc right_;
  double share_ = 0.0;
};

}  // namespace lodesman
