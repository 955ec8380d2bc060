// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/world/world_task.h"

#include <algorithm>

namespace lodesman {

WorldTask::WorldTask(const Scenario& scenario, const VesselParameters& vessel,
                     Blackboard& blackboard, SimLink& link)
    : world_{scenario, vessel},
      mission_status_{blackboard.mission_status},
      box_{link.thrust},
      truth_out_{blackboard.world_truth, Role::kLow, "world_truth"},
      sample_out_{link.world, Role::kLow, "world sample"} {}

void WorldTask::step(Time now) noexcept {
  const Stamped<MissionStatus>* mission = mission_status_.latest();
  const bool started = mission != nullptr && mission->value.started != Time{};
  if (started) {
    if (mission->value.started != mission_started_) {
      mission_started_ = mission->value.started;
      world_.forget_the_least();
    }
    // The first step after the start moves on from the start alone.
    const Time from = std::max(stepped_to_, std::min(mission->value.started, now));
    const Duration dt = std::clamp(now - from, Duration{}, kLongestStep);
    const Duration scenario_time = std::max(now - mission->value.started, Duration{});
    world_.step(to_seconds(dt), to_seconds(scenario_time), thrust_at(box_, now));
  }
  stepped_to_ = now;
  publish(now, started);
}

void WorldTask::publish(Time now, bool started) noexcept {
  const WorldTruth& truth = world_.truth();
  WorldSample sample;
  sample.stamp = now;
  sample.started = started ? 1 : 0;
  sample.scenario_time_s = truth.scenario_time_s;
  sample.x_m = truth.x_m;
  sample.y_m = truth.y_m;
  sample.heading_rad = truth.heading_rad;
  sample.surge_m_s = truth.surge_m_s;
  sample.sway_m_s = truth.sway_m_s;
  sample.yaw_rate_rad_s = truth.yaw_rate_rad_s;
  sample_out_.publish(sample, now);
  truth_out_.publish(truth, now);
}

}  // namespace lodesman
