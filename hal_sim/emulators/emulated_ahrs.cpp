// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/emulators/emulated_ahrs.h"

#include <cmath>

namespace lodesman {

EmulatedAhrs::EmulatedAhrs(const EmulatedAhrsOptions& options, const std::vector<Fault>& faults,
                           Time now)
    : unit_{options.unit, now, options.on_for},
      wire_{"ahrs", options.seed, options.wire},
      faults_{faults, FaultDevice::kAhrs} {}

void EmulatedAhrs::feel(const WorldSample& world, double thrust_share, Time now) {
  EmulatedMotion motion;
  motion.heading_true_rad = world.heading_rad;
  motion.yaw_rate_rad_s = world.yaw_rate_rad_s;
  const double sine = std::sin(world.heading_rad);
  const double cosine = std::cos(world.heading_rad);
  motion.north_m_s = world.surge_m_s * cosine - world.sway_m_s * sine;
  motion.east_m_s = world.surge_m_s * sine + world.sway_m_s * cosine;
  motion.measured = world.stamp;
  unit_.set_motion(motion);
  unit_.set_thrust_share(thrust_share);
  wire_.set_thrust_share(thrust_share);
  if (world.started != 0) {
    faults_.advance(world.scenario_time_s, now, unit_, wire_);
  }
}

}  // namespace lodesman
