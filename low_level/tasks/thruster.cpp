// SPDX-License-Identifier: Apache-2.0
#include "low_level/tasks/thruster.h"

#include "low_level/thrust/thrust_map.h"

namespace lodesman {
namespace {

constexpr Duration kBatteryPeriod = std::chrono::seconds{1};

// The share of full load: thrust, and with it current, grows with the square of the command.
[[nodiscard]] double load_of(ThrustCommand thrust) noexcept {
  const auto share = [](std::uint8_t command) noexcept {
    const double offset = (static_cast<double>(command) - 127.5) / 127.5;
    return offset * offset;
  };
  return (share(thrust.left) + share(thrust.right)) / 2.0;
}

// Whether the helm steers, or is at rest by decision; else it does not know how to.
[[nodiscard]] bool is_decision(HelmReason reason) noexcept {
  return reason == HelmReason::kTracking || reason == HelmReason::kNotUnderWay;
}

}  // namespace

void ThrusterTask::step(Time now) noexcept {
  if (!begun_) {
    begin(now);
  }
  look(now);
  obey_orders(now);
  ThrustApplied applied = guarded(wanted(now), now);
  const bool turns = applied.surge_ref != 0 || applied.head_ref != 0;
  if (turns && thrusters_ != nullptr && box_ != CommandStatus::kTaken) {
    // A box that was not ready, or gone, gets neutral first.
    applied = ThrustApplied{};
    applied.reason = ThrustReason::kDeviceFailed;
  }
  const ThrustCommand thrust = map_thrust(applied.surge_ref, applied.head_ref);
  applied.left = thrust.left;
  applied.right = thrust.right;
  if (const ThrustReason done = command(thrust, now); done != ThrustReason::kCommanded) {
    // Nobody downstream may reckon with it.
    applied = ThrustApplied{};
    applied.reason = done;
  }
  guard_.applied({applied.surge_ref, applied.head_ref}, now);
  status_.publish(arming_.status(), now);
  guard_out_.publish(guard_.status(), now);
  applied_.publish(applied, now);
  device_.publish(now);
  keep_proof(now);
  watch_battery({applied.left, applied.right}, now);
}

// What stands on the blackboard from before is known once there is a time to judge it by.
void ThrusterTask::begin(Time now) noexcept {
  begun_ = true;
  const auto* order = orders_.latest();
  const std::uint64_t stops = order != nullptr ? order->value.stops : 0;
  if (const auto* before = before_.latest(); before != nullptr) {
    const Duration age = remembers_ ? now - before->stamp : kArmedMemory + Duration{1};
    arming_.remember(before->value, stops, age, now);
    obeyed_ = before->value.order;
  }
  if (stop_is_latched_) {
    arming_.latch(now);
  }
  recall_proof();
}

// Until the driver says that it goes by it, none stands: who dies before that leaves none.
void ThrusterTask::recall_proof() noexcept {
  const auto* proof = proof_before_.latest();
  const auto* applied = applied_before_.latest();
  if (proof == nullptr) {
    return;
  }
  told_proof_ = proof->value;
  if (thrusters_ != nullptr && applied != nullptr && remembers_) {
    thrusters_->recall(proof->value, applied->stamp);
  }
}

void ThrusterTask::keep_proof(Time now) noexcept {
  const BoxProof proof = thrusters_ != nullptr ? thrusters_->proof() : BoxProof{};
  if (proof.proved != told_proof_.proved || proof.power_up != told_proof_.power_up) {
    told_proof_ = proof;
    proof_.publish(proof, now);
  }
}

void ThrusterTask::look(Time now) noexcept {
  ArmingView view;
  if (thrusters_ != nullptr) {
    view.box = box_ == CommandStatus::kTaken      ? ArmingView::Box::kReady
               : box_ == CommandStatus::kNotReady ? ArmingView::Box::kNotReady
                                                  : ArmingView::Box::kGone;
  }
  const auto* helm = helm_.fresh(now, max_age::kHelmCommand);
  if (helm == nullptr || (helm->value.surge_ref == 0 && helm->value.head_ref == 0)) {
    helm_asks_ = Time{};
  } else if (helm_asks_ == Time{}) {
    helm_asks_ = helm->stamp;
  }
  view.high_is_heard = helm != nullptr;
  view.helm_asks = helm_asks_;
  if (const auto* stick = stick_.fresh(now, max_age::kManualInput); stick != nullptr) {
    view.stick = stick->stamp;
    view.stick_is_at_rest = stick->value.surge_ref == 0 && stick->value.head_ref == 0;
  }
  if (const auto* mission = mission_.latest();
      mission != nullptr && mission->value.state == MissionState::kAborted) {
    view.aborted = mission->value.ended;
  }
  aborted_ = view.aborted;
  view.battery_is_critical = battery_.status().level == BatteryLevel::kCritical;
  arming_.look(view, now);
}

void ThrusterTask::obey_orders(Time now) noexcept {
  const std::uint64_t newest = orders_.newest_sequence();
  if (newest <= obeyed_) {
    return;
  }
  // One that waits for its answer is the newest: the command socket gives one at a time, but for
  // stops, and those are counted.
  const auto* order = orders_.latest();
  if (order != nullptr && order->sequence > obeyed_) {
    obeyed_ = order->sequence;
    arming_.obey(order->value, order->sequence, order->stamp, now);
  }
}

ThrustApplied ThrusterTask::wanted(Time now) noexcept {
  ThrustApplied neutral;
  switch (arming_.status().state) {
    case ThrustState::kArmed: return by_helm(now);
    case ThrustState::kManual: return by_stick(now);
    case ThrustState::kDisarmed: neutral.reason = ThrustReason::kDisarmed; break;
    case ThrustState::kStopped: neutral.reason = ThrustReason::kStopped; break;
  }
  return neutral;
}

// One look at the helm: what is fresh now stays so for this step.
ThrustApplied ThrusterTask::by_helm(Time now) noexcept {
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

// A stick that was silent for a while is not believed where it last was.
ThrustApplied ThrusterTask::by_stick(Time now) noexcept {
  ThrustApplied applied;
  applied.reason = ThrustReason::kStickSilent;
  const auto* stick = stick_.fresh(now, max_age::kManualInput);
  if (stick != nullptr && stick->stamp > arming_.status().armed) {
    applied.reason = ThrustReason::kManual;
    applied.surge_ref = stick->value.surge_ref;
    applied.head_ref = stick->value.head_ref;
    applied.command_stamp = stick->stamp;
  }
  return applied;
}

// Below the emergency stop and an abort, above stick and mission.
ThrustApplied ThrusterTask::guarded(const ThrustApplied& wanted, Time now) noexcept {
  const auto* attitude = attitude_.fresh(now, max_age::kAttitude);
  guard_.advance(now, attitude != nullptr ? &attitude->value : nullptr);
  while (const auto* seen = obstacles_.next()) {
    guard_.see(seen->value);
  }
  const auto instead =
      guard_.judge({wanted.surge_ref, wanted.head_ref}, view_for(wanted, now), now);
  if (!instead) {
    return wanted;
  }
  ThrustApplied applied;
  applied.reason = ThrustReason::kGuarded;
  applied.surge_ref = instead->surge_ref;
  applied.head_ref = instead->head_ref;
  return applied;
}

GuardView ThrusterTask::view_for(const ThrustApplied& wanted, Time now) noexcept {
  const ThrustStatus& arming = arming_.status();
  const bool is_armed = arming.state == ThrustState::kArmed || arming.state == ThrustState::kManual;
  const bool by_hand = wanted.reason == ThrustReason::kManual;
  const auto* stick = stick_.fresh(now, max_age::kManualInput);
  GuardView view;
  view.may_turn = is_armed && (aborted_ == Time{} || aborted_ < arming.armed);
  view.is_overridden = by_hand && stick != nullptr && stick->value.overrides_guard;
  const auto* helm = helm_.fresh(now, max_age::kHelmCommand);
  view.is_silent = !by_hand && helm_.newest_sequence() != 0 &&
                   (helm == nullptr || !is_decision(helm->value.reason));
  return view;
}

// kCommanded where the box took it, else why it did not.
ThrustReason ThrusterTask::command(ThrustCommand thrust, Time now) noexcept {
  if (thrusters_ == nullptr) {
    device_.keeper().absent(now);
    return ThrustReason::kNoThrusters;
  }
  box_ = thrusters_->command(thrust, now);
  device_.keeper().commanded(box_, now);
  device_.keeper().ails(thrusters_->fault());
  return box_ == CommandStatus::kTaken ? ThrustReason::kCommanded : ThrustReason::kDeviceFailed;
}

void ThrusterTask::watch_battery(ThrustCommand thrust, Time now) noexcept {
  if (thrusters_ == nullptr) {
    return;
  }
  const BatteryReading reading = thrusters_->battery();
  battery_.look(reading.volts, reading.measured, load_of(thrust), now);
  const BatteryStatus& status = battery_.status();
  if (status.level != told_level_ || now - battery_told_ >= kBatteryPeriod) {
    told_level_ = status.level;
    battery_told_ = now;
    battery_out_.publish(status, now);
  }
}

void ThrusterTask::enter_safe_state(Time now) noexcept {
  ThrustApplied neutral;
  if (const ThrustReason done = command(kNeutralThrust, now); done != ThrustReason::kCommanded) {
    neutral.reason = done;
  }
  applied_.publish(neutral, now);
}

}  // namespace lodesman
