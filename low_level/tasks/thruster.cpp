// SPDX-License-Identifier: Apache-2.0
#include "low_level/tasks/thruster.h"

#include "low_level/thrust/thrust_map.h"

namespace lodesman {

void ThrusterTask::step(Time now) noexcept {
  ThrustApplied applied;
  if (const auto* helm = helm_.latest(); helm == nullptr) {
    applied.reason = ThrustReason::kNoCommand;
  } else {
    applied.command_sequence = helm->sequence;
    applied.command_stamp = helm->stamp;
    applied.plan_id = helm->value.plan_id;
    applied.plan_captured = helm->value.plan_captured;
    if (helm_.fresh(now, max_age::kHelmCommand) == nullptr) {
      applied.reason = ThrustReason::kStaleCommand;
    } else {
      applied.reason = ThrustReason::kCommanded;
      applied.surge_ref = helm->value.surge_ref;
      applied.head_ref = helm->value.head_ref;
    }
  }
  const ThrustCommand thrust = map_thrust(applied.surge_ref, applied.head_ref);
  applied.left = thrust.left;
  applied.right = thrust.right;
  if (!thrusters_.command(thrust, now)) {
    applied.reason = ThrustReason::kDeviceFailed;
  }
  applied_.publish(applied, now);
}

void ThrusterTask::enter_safe_state(Time now) noexcept {
  ThrustApplied neutral;
  if (!thrusters_.command(kNeutralThrust, now)) {
    neutral.reason = ThrustReason::kDeviceFailed;
  }
  applied_.publish(neutral, now);
}

}  // namespace lodesman
