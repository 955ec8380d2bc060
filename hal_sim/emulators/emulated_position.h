// SPDX-License-Identifier: Apache-2.0
// A satellite receiver aboard the simulated vessel, with its wire and its faults: what stands at
// the far end of a driver's line, whatever kind of line that is. One thread.
#pragma once

#include <cstdint>
#include <vector>

#include "hal_sim/emulators/line_feed.h"
#include "hal_sim/emulators/nmea_receiver.h"
#include "hal_sim/scenario/scenario.h"
#include "hal_sim/world/sim_link.h"

namespace lodesman {

struct EmulatedPositionOptions {
  NmeaReceiverOptions receiver;
  WireSettings wire;
  std::uint64_t seed = 0;
};

// A receiver whose error is as the scenario's [position] has it.
[[nodiscard]] EmulatedPositionOptions emulated_position_options(const Scenario& scenario);

class EmulatedPosition {
 public:
  EmulatedPosition(const EmulatedPositionOptions& options, const std::vector<Fault>& faults,
                   Time now);

  // What the vessel does, and the thrusters that its line feels.
  void feel(const WorldSample& world, double thrust_share, Time now);

  [[nodiscard]] EmulatedNmeaReceiver& device() noexcept { return receiver_; }
  [[nodiscard]] EmulatedWire& wire() noexcept { return wire_; }
  [[nodiscard]] FaultTimetable& faults() noexcept { return faults_; }

 private:
  EmulatedNmeaReceiver receiver_;
  EmulatedWire wire_;
  FaultTimetable faults_;
};

}  // namespace lodesman
