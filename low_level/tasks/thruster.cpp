// SPDX-License-Identifier: Apache-2.0
#include "low_level/tasks/thruster.h"

#include "low_level/thrust/thrust_map.h"

namespace lodesman {

void ThrusterTask::step(Time now) noexcept {
  ThrustApplied wanted = as_commanded(now);
  const ThrustCommand thrust = map_thrust(wanted.surge_ref, wanted.head_ref);
  wanted.left = thrust.left;
  wanted.right = thrust.right;
  if (const ThrustReason done = command(thrust, now); done != ThrustReason::kCommanded) {
    // Nobody downstream may reckon with it.
    wanted = ThrustApplied{};
    wanted.reason = done;
  }
  applied_.publish(wanted, now);
  device_.publish(now);
}

// kCommanded where the box took it, else why it did not.
ThrustReason ThrusterTask::command(ThrustCommand thrust, Time now) noexcept {
  if (thrusters_ == nullptr) {
    device_.keeper().absent(now);
    return ThrustReason::kNoThrusters;
  }
  const CommandStatus status = thrusters_->command(thrust, now);
  device_.keeper().commanded(status, now);
  device_.keeper().ails(thrusters_->fault());
  return status == CommandStatus::kTaken ? ThrustReason::kCommanded : ThrustReason::kDeviceFailed;
}

// One look at the helm: what is fresh now stays so for this step.
ThrustApplied ThrusterTask::as_commanded(Time now) noexcept {
  ThrustApplied applied;
  const auto* helm = helm_.fresh(now, max_age::kHelmCommand);
  if (helm == nullptr) {
    applied.reason =
        helm_.newest_sequence() == 0 ? ThrustReason::kNoCommand : ThrustReason::kStaleCommand;
    return applied;
  }
  applied.reason = ThrustReason::kCommanded;
  applied.surge_ref = helm->value.surge_ref;
  applied.head_ref = helm->value.head_ref;
  applied.command_sequence = helm->sequence;
  applied.command_stamp = helm->stamp;
  applied.plan_id = helm->value.plan_id;
  applied.plan_captured = helm->value.plan_captured;
  return applied;
}

void ThrusterTask::enter_safe_state(Time now) noexcept {
  ThrustApplied neutral;
  if (const ThrustReason done = command(kNeutralThrust, now); done != ThrustReason::kCommanded) {
    neutral.reason = done;
  }
  applied_.publish(neutral, now);
}

}  // namespace lodesman
