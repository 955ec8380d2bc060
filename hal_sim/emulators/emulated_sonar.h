// SPDX-License-Identifier: Apache-2.0
// A Delta T with its program aboard the simulated vessel, with its network and its faults: what
// stands at the far end of a driver's socket, whatever kind of socket that is. One thread.
#pragma once

#include <cstdint>
#include <vector>

#include "drivers/stream/datagram_socket.h"
#include "hal_sim/emulators/delta_t_program.h"
#include "hal_sim/emulators/emulated_network.h"
#include "hal_sim/emulators/line_feed.h"
#include "hal_sim/scenario/scenario.h"
#include "hal_sim/sonar/heard_scene.h"
#include "hal_sim/world/sim_link.h"
#include "mid_level/base/geodesy.h"

namespace lodesman {

struct EmulatedSonarOptions {
  DeltaTProgramOptions program;
  std::vector<MovingObstacle> obstacles;
  GeoPoint origin;  // of the world
  std::uint64_t seed = 0;
};

// A head and its program, set as the scenario's [sonar] has it, as far as they can be.
[[nodiscard]] EmulatedSonarOptions emulated_sonar_options(const Scenario& scenario);

class EmulatedSonar {
 public:
  EmulatedSonar(const EmulatedSonarOptions& options, const std::vector<Fault>& faults, Time now);

  // Where the vessel is: it pings if it is time to.
  void feel(const WorldSample& world, Time now);
  // Goes on to `now`: obeys what came through the socket and sends what leaves by then.
  void exchange(DatagramSocket& socket, Time now);

  [[nodiscard]] DeltaTProgram& device() noexcept { return program_; }
  [[nodiscard]] EmulatedNetwork& network() noexcept { return network_; }
  [[nodiscard]] FaultTimetable& faults() noexcept { return faults_; }
  // Datagrams that the socket took. What it does not take is lost.
  [[nodiscard]] std::uint64_t sent() const noexcept { return sent_; }

 private:
  DeltaTProgram program_;
  EmulatedNetwork network_;
  FaultTimetable faults_;
  HeardScene scene_;
  LocalFrame frame_;
  std::vector<double> surfaces_m_;
  std::vector<std::uint8_t> received_;
  std::vector<Utterance> said_;
  std::uint64_t sent_ = 0;
};

}  // namespace lodesman
