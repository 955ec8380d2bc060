// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/emulators/emulated_position.h"

#include <cmath>

namespace lodesman {

EmulatedPositionOptions emulated_position_options(const Scenario& scenario) {
  EmulatedPositionOptions options;
  options.receiver.origin = {scenario.environment.origin_latitude_deg,
                             scenario.environment.origin_longitude_deg};
  options.receiver.sigma_m = scenario.position.gps_sigma_m;
  options.receiver.seed = options.seed = scenario.seed;
  return options;
}

EmulatedPosition::EmulatedPosition(const EmulatedPositionOptions& options,
                                   const std::vector<Fault>& faults, Time now)
    : receiver_{options.receiver, now},
      wire_{"position", options.seed, options.wire},
      faults_{faults, FaultDevice::kPosition} {}

void EmulatedPosition::feel(const WorldSample& world, double thrust_share, Time now) {
  const double sine = std::sin(world.heading_rad);
  const double cosine = std::cos(world.heading_rad);
  AntennaMotion motion;
  motion.x_m = world.x_m;
  motion.y_m = world.y_m;
  motion.east_m_s = world.surge_m_s * sine + world.sway_m_s * cosine;
  motion.north_m_s = world.surge_m_s * cosine - world.sway_m_s * sine;
  motion.heading_true_rad = world.heading_rad;
  motion.measured = world.stamp;
  receiver_.set_motion(motion);
  receiver_.set_thrust_share(thrust_share);
  wire_.set_thrust_share(thrust_share);
  if (world.started != 0) {
    faults_.advance(world.scenario_time_s, now, receiver_, wire_);
  }
}

}  // namespace lodesman
