// SPDX-License-Identifier: Apache-2.0
// A NAV440 aboard the simulated vessel, with its wire and its faults: what stands at the far end of
// a driver's line, whatever kind of line that is. One thread.
#pragma once

#include <cstdint>
#include <vector>

#include "hal_sim/emulators/line_feed.h"
#include "hal_sim/emulators/nav440_unit.h"
#include "hal_sim/world/sim_link.h"

namespace lodesman {

struct EmulatedAhrsOptions {
  Nav440UnitOptions unit;
  WireSettings wire;
  std::uint64_t seed = 0;
  // It has been switched on for so long when it is first stepped.
  Duration on_for = std::chrono::minutes{10};
};

class EmulatedAhrs {
 public:
  EmulatedAhrs(const EmulatedAhrsOptions& options, const std::vector<Fault>& faults, Time now);

  // What the vessel does, and the thrusters that it feels.
  void feel(const WorldSample& world, double thrust_share, Time now);

  [[nodiscard]] Nav440Unit& device() noexcept { return unit_; }
  [[nodiscard]] EmulatedWire& wire() noexcept { return wire_; }
  [[nodiscard]] FaultTimetable& faults() noexcept { return faults_; }

 private:
  Nav440Unit unit_;
  EmulatedWire wire_;
  FaultTimetable faults_;
};

}  // namespace lodesman
