// SPDX-License-Identifier: Apache-2.0
#include "high_level/tasks/planner.h"

#include <algorithm>
#include <utility>

namespace lodesman {

namespace {

// A frame is given its full age before its absence counts.
[[nodiscard]] ReplannerOptions with_silence_limit(ReplannerOptions options) noexcept {
  options.silence_limit = options.replan_period + max_age::kSonarFrame;
  return options;
}

// Above those of a program that was here before, so that a late answer to it fits no question.
[[nodiscard]] std::uint64_t first_free_id(const Blackboard& board) {
  Reader<Plan> plans{board.plan};
  Reader<PathRequest> requests{board.path_request};
  const auto* plan = plans.latest();
  const auto* request = requests.latest();
  return 1 +
         std::max(plan != nullptr ? plan->value.id : 0, request != nullptr ? request->value.id : 0);
}

}  // namespace

PlannerTask::PlannerTask(Blackboard& board, Role role, PlannerOptions options)
    : options_{std::move(options)},
      mission_{options_.mission},
      replanner_{with_silence_limit(options_.replanner), first_free_id(board)},
      orders_{board.operator_command},
      vehicle_state_{board.vehicle_state},
      obstacles_{board.sonar_obstacles},
      tracks_{board.tracks},
      sonar_path_{board.sonar_path},
      requests_{board.path_request, role, "path_request"},
      plans_{board.plan, role, "plan"},
      statuses_{board.mission_status, role, "mission_status"} {
  // Orders from before this program started are not for it, but an abort stands.
  std::uint64_t aborts = 0;
  while (const auto* order = orders_.next()) {
    aborts = std::max(aborts, order->value.aborts);
  }
  Reader<MissionStatus> before{board.mission_status};
  const auto* last = before.latest();
  if (mission_.inherit(last != nullptr ? last->value : MissionStatus{}, aborts)) {
    options_.start_by_itself = false;
  }
}

void PlannerTask::step(Time now) noexcept {
  const auto* state = vehicle_state_.fresh(now, max_age::kVehicleState);
  if (state != nullptr) {
    poses_.add(state->value);
    position_ = {{state->value.x_m, state->value.y_m}};
  }
  take_orders(now, state != nullptr);
  if (state != nullptr) {
    mission_.advance(position_, now);
  }
  // Places are held by the pilot alone; the paper knows nothing of it.
  if (mission_.under_way() || (mission_.holding() && options_.replanner.pilot)) {
    replan(now);
  }
  statuses_.publish(mission_.status(), now);
}

void PlannerTask::take_orders(Time now, bool estimate_is_fresh) noexcept {
  const Time started = mission_.status().started;
  const std::uint64_t aborts = mission_.status().aborts;
  while (const auto* order = orders_.next()) {
    mission_.take({order->value, order->sequence, order->stamp}, position_, now);
  }
  if (mission_.status().aborts != aborts) {
    options_.start_by_itself = false;  // not any more
  }
  if (options_.start_by_itself && estimate_is_fresh) {
    options_.start_by_itself = false;
    mission_.start(now);
  }
  if (mission_.status().started != started) {
    replanner_.start(now);
  }
}

void PlannerTask::replan(Time now) noexcept {
  if (options_.replanner.pilot) {
    replan_in_world(now);
  } else {
    replan_in_view(now);
  }
  publish(replanner_.silence(now), now);
}

void PlannerTask::replan_in_view(Time now) noexcept {
  if (const auto* path = sonar_path_.latest(); path != nullptr) {
    publish(replanner_.answer(now, path->value, options_.sonar_range_m), now);
  }
  const auto* frame = obstacles_.fresh(now, max_age::kSonarFrame);
  if (frame == nullptr) {
    return;
  }
  const auto* request =
      replanner_.request(now, frame->value.frame, frame->value.captured, mission_.goal(), poses_);
  if (request != nullptr) {
    requests_.publish(*request, now);
  }
}

void PlannerTask::replan_in_world(Time now) noexcept {
  const auto* state = vehicle_state_.fresh(now, max_age::kVehicleState);
  const auto* tracks = tracks_.fresh(now, max_age::kSonarFrame);
  if (state == nullptr || tracks == nullptr) {
    return;
  }
  if (const auto* path = sonar_path_.latest(); path != nullptr) {
    publish(replanner_.answer(now, path->value, tracks->value, state->value), now);
  }
  const auto* request =
      replanner_.request(now, tracks->value, state->value, mission_.goal(), mission_.holding());
  if (request != nullptr) {
    requests_.publish(*request, now);
  }
}

void PlannerTask::publish(const Plan* plan, Time now) noexcept {
  if (plan != nullptr) {
    plans_.publish(*plan, now);
  }
}

}  // namespace lodesman
