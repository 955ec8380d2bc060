// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/emulators/emulated_thrusters.h"

namespace lodesman {
namespace {

[[nodiscard]] MaestroBoxOptions maestro_as_set(const EmulatedThrustersOptions& options) {
  MaestroBoxOptions box;
  box.time_out_10ms = static_cast<std::uint16_t>(
      std::chrono::duration_cast<std::chrono::milliseconds>(options.time_out).count() / 10);
  for (MaestroChannel& channel : box.channel) {
    channel.home = MaestroHome::kGoTo;
  }
  box.seed = options.seed;
  return box;
}

[[nodiscard]] RoboClawBoxOptions roboclaw_as_set(const EmulatedThrustersOptions& options) {
  RoboClawBoxOptions box;
  box.stored_time_out_100ms = static_cast<std::uint8_t>(
      std::chrono::duration_cast<std::chrono::milliseconds>(options.time_out).count() / 100);
  return box;
}

}  // namespace

EmulatedThrusters::EmulatedThrusters(const EmulatedThrustersOptions& options,
                                     const std::vector<Fault>& faults, Time now)
    : has_escs_{options.has_escs},
      maestro_{options.kind == ThrusterBoxKind::kMaestro
                   ? std::make_unique<MaestroBox>(maestro_as_set(options), now)
                   : nullptr},
      roboclaw_{options.kind == ThrusterBoxKind::kRoboClaw
                    ? std::make_unique<RoboClawBox>(roboclaw_as_set(options), now)
                    : nullptr},
      device_{maestro_ ? static_cast<FaultyDevice*>(maestro_.get()) : roboclaw_.get()},
      wire_{"thrusters", options.seed, options.wire},
      faults_{faults, FaultDevice::kThruster} {}

void EmulatedThrusters::feel(const WorldSample& world, Time now) {
  device_->set_thrust_share(share_);
  wire_.set_thrust_share(share_);
  if (world.started != 0) {
    faults_.advance(world.scenario_time_s, now, *device_, wire_);
  }
}

SimThrust EmulatedThrusters::output(Time now) {
  SimThrust thrust;
  if (maestro_ && has_escs_) {
    thrust = {left_.step(maestro_->pulse_quarter_us(0), now),
              right_.step(maestro_->pulse_quarter_us(1), now)};
  } else if (maestro_) {
    thrust = {thrust_command_of_pulse(maestro_->pulse_quarter_us(0)),
              thrust_command_of_pulse(maestro_->pulse_quarter_us(1))};
  } else {
    thrust = {thrust_command_of_duty(roboclaw_->duty(0)),
              thrust_command_of_duty(roboclaw_->duty(1))};
  }
  share_ = thrust_load({thrust.left, thrust.right});
  return thrust;
}

}  // namespace lodesman
