// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/replay/stepped_task.h"

#include <array>

#include "mid_level/recording/raw_codec.h"

namespace lodesman::cli {

bool RecordedSonar::prepare(Time stepped, const ChannelLog& pings) {
  bool all = true;
  has_ping_ = false;
  for (const Recorded* next = pings.after(taken_); next != nullptr && next->stamp <= stepped;
       next = pings.after(taken_)) {
    all &= next->stamp == stepped && next->sequence == taken_ + 1;
    taken_ = next->sequence;
    has_ping_ = next->stamp == stepped && decode_raw(next->raw, *ping_);
    all &= has_ping_ || next->stamp != stepped;
  }
  const Recorded* later = pings.after(taken_);
  return all && (has_ping_ || later == nullptr || later->sequence == taken_ + 1);
}

ReadStatus RecordedSonar::poll(Time /*now*/, SonarPing& out) noexcept {
  if (!has_ping_) {
    return ReadStatus::kNothingNew;
  }
  has_ping_ = false;
  out = *ping_;
  return ReadStatus::kFresh;
}

std::unique_ptr<Task> make_task(TaskId task, Blackboard& board, const ReplayOptions& options,
                                RecordedSonar& sonar) {
  switch (task) {
    case TaskId::kEstimator:
      return std::make_unique<EstimatorTask>(board, Role::kHigh, options.high.estimator);
    case TaskId::kDeltaT:
      return std::make_unique<DeltaTTask>(board, Role::kLow, sonar, options.low.delta_t);
    case TaskId::kPathFinder: return std::make_unique<PathFinderTask>(board, Role::kLow);
    case TaskId::kPlanner:
      return std::make_unique<PlannerTask>(board, Role::kHigh, options.high.planner);
    case TaskId::kController:
      return std::make_unique<ControllerTask>(board, Role::kHigh, options.high.controller);
    case TaskId::kWorld:
    case TaskId::kAhrs:
    case TaskId::kPosition:
    case TaskId::kThruster: break;
  }
  return nullptr;
}

std::span<const char* const> decisions_of(TaskId task) noexcept {
  static constexpr std::array kEstimator{"world_origin", "vehicle_state", "estimator_memory"};
  static constexpr std::array kDeltaT{"sonar_obstacles", "coverage", "tracks"};
  static constexpr std::array kPathFinder{"sonar_path"};
  static constexpr std::array kPlanner{"path_request", "plan", "mission_status"};
  static constexpr std::array kController{"helm_command"};
  switch (task) {
    case TaskId::kEstimator: return kEstimator;
    case TaskId::kDeltaT: return kDeltaT;
    case TaskId::kPathFinder: return kPathFinder;
    case TaskId::kPlanner: return kPlanner;
    case TaskId::kController: return kController;
    case TaskId::kWorld:
    case TaskId::kAhrs:
    case TaskId::kPosition:
    case TaskId::kThruster: break;
  }
  return {};
}

}  // namespace lodesman::cli
