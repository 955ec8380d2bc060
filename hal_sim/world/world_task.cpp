// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/world/world_task.h"

#include <algorithm>

namespace lodesman {
namespace {

// Where the boat lies when nobody has moved it yet: at its start, or, in a segment taken over from
// a low level that died with its world, where that left it.
[[nodiscard]] Scenario from_where_it_lies(Scenario scenario, const Blackboard& blackboard) {
  Reader<WorldTruth> truths{blackboard.world_truth};
  if (const auto* last = truths.latest(); last != nullptr) {
    scenario.mission.start = {{{last->value.x_m, last->value.y_m}},
                              Heading::clockwise_from_y_rad(last->value.heading_rad)};
  }
  return scenario;
}

[[nodiscard]] bool thrusts(ThrustCommand thrust) noexcept {
  const auto turns = [](std::uint8_t command) { return command != 127 && command != 128; };
  return turns(thrust.left) || turns(thrust.right);
}

}  // namespace

WorldTask::WorldTask(const Scenario& scenario, const VesselParameters& vessel,
                     Blackboard& blackboard, SimLink& link, MovedBy moved_by)
    : moved_by_{moved_by},
      world_{from_where_it_lies(scenario, blackboard), vessel},
      vehicle_state_{blackboard.vehicle_state},
      mission_status_{blackboard.mission_status},
      box_{link.thrust},
      sample_out_{link.world, Role::kLow, "world sample"},
      sensors_{Rung{link.heading_due, blackboard.bell_of(TaskId::kAhrs)},
               Rung{link.position_due, blackboard.bell_of(TaskId::kPosition)},
               Rung{link.sonar_due, blackboard.bell_of(TaskId::kDeltaT)}} {
  if (moved_by_ == MovedBy::kThrust) {
    truth_out_.emplace(writer_of(blackboard, blackboard.world_truth, Role::kLow));
  }
}

void WorldTask::step(Time now) noexcept {
  const Stamped<MissionStatus>* mission = mission_status_.latest();
  if (mission != nullptr && mission->value.first_started != mission_started_) {
    mission_started_ = mission->value.first_started;
    world_.forget_the_least();
  }
  if (moved_by_ == MovedBy::kEstimate) {
    publish_estimate(now);
    return;
  }
  const ThrustCommand thrust = thrust_at(box_, now);
  const bool started = mission_started_ != Time{};
  cast_off_ = cast_off_ || started || thrusts(thrust);
  if (cast_off_) {
    // The first step after the start moves on from the start alone.
    const Time from =
        started ? std::max(stepped_to_, std::min(mission_started_, now)) : stepped_to_;
    const Duration dt = std::clamp(now - from, Duration{}, kLongestStep);
    const Duration scenario_time =
        started ? std::max(now - mission_started_, Duration{}) : Duration{};
    world_.step(to_seconds(dt), to_seconds(scenario_time), thrust);
  }
  stepped_to_ = now;
  publish_truth(now, thrust);
}

void WorldTask::publish_truth(Time now, ThrustCommand thrust) noexcept {
  WorldTruth truth = world_.truth();
  truth.thrust_left = thrust.left;
  truth.thrust_right = thrust.right;
  WorldSample sample;
  sample.stamp = now;
  sample.started = mission_started_ != Time{} ? 1 : 0;
  sample.scenario_time_s = truth.scenario_time_s;
  sample.x_m = truth.x_m;
  sample.y_m = truth.y_m;
  sample.heading_rad = truth.heading_rad;
  sample.surge_m_s = truth.surge_m_s;
  sample.sway_m_s = truth.sway_m_s;
  sample.yaw_rate_rad_s = truth.yaw_rate_rad_s;
  sample.thrust_load = thrust_load(thrust);
  // The truth first: whoever is woken by a sample may look at it.
  truth_out_->publish(truth, now);
  sample_out_.publish(sample, now);
  ring_for_samples(now);
}

// Nothing is simulated round a boat that does not know where it is.
void WorldTask::publish_estimate(Time now) noexcept {
  const auto* state = vehicle_state_.fresh(now, max_age::kVehicleState);
  if (state == nullptr) {
    return;
  }
  WorldSample sample;
  sample.stamp = now;
  sample.started = mission_started_ != Time{} ? 1 : 0;
  sample.scenario_time_s =
      sample.started != 0 ? to_seconds(std::max(now - mission_started_, Duration{})) : 0.0;
  sample.x_m = state->value.x_m;
  sample.y_m = state->value.y_m;
  sample.heading_rad = state->value.heading_rad;
  sample.surge_m_s = state->value.surge_m_s;
  sample_out_.publish(sample, now);
  ring_for_samples(now);
}

void WorldTask::ring_for_samples(Time now) noexcept {
  for (const Rung& sensor : sensors_) {
    if (sensor.due.has_come(now)) {
      ring(sensor.bell);
    }
  }
}

}  // namespace lodesman
