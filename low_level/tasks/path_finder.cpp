// SPDX-License-Identifier: Apache-2.0
#include "low_level/tasks/path_finder.h"

#include <limits>

#include "mid_level/base/stopwatch.h"

namespace lodesman {

PathFinderTask::PathFinderTask(Blackboard& board, Role role)
    : requests_{board.path_request},
      obstacles_{board.sonar_obstacles},
      paths_{writer_of(board, board.sonar_path, role)},
      // What was asked before this task existed is nobody's question any more.
      answered_{requests_.newest_when_made()} {}

void PathFinderTask::step(Time now) noexcept {
  const auto* request = requests_.latest();
  if (request == nullptr || request->sequence == answered_) {
    return;
  }
  answered_ = request->sequence;
  find(request->value);
  paths_.publish(*path_, now);
}

void PathFinderTask::find(const PathRequest& request) noexcept {
  const Stopwatch stopwatch;
  path_->point_count = 0;
  if (request.space == PathSpace::kWorld) {
    find_in_world(request);
  } else {
    find_in_view(request);
  }
  const auto took_ns = stopwatch.elapsed().count();
  constexpr std::int64_t kMost = std::numeric_limits<std::uint32_t>::max();
  path_->plan_time_ns = static_cast<std::uint32_t>(took_ns < kMost ? took_ns : kMost);
}

void PathFinderTask::find_in_view(const PathRequest& request) noexcept {
  const auto* newest = obstacles_.latest();
  // Frames are numbered as they are published, so the one asked for is a few places back.
  while (newest != nullptr && newest->value.frame > request.frame) {
    newest = obstacles_.at(newest->sequence - 1);
  }
  if (newest == nullptr || newest->value.frame != request.frame) {
    path_->request = request.id;
    path_->frame = request.frame;
    path_->reason = PathReason::kNoFrame;
    path_->range_m = 0.0;
    path_->cost_10_14 = 0;
    path_->expansions = 0;
    path_->pixel_count = 0;
  } else {
    finder_.find_path(newest->value, request, *path_);
  }
}

void PathFinderTask::find_in_world(const PathRequest& request) noexcept {
  path_->request = request.id;
  path_->frame = request.frame;
  path_->range_m = 0.0;
  path_->captured = Time{};  // what it was planned in came with the request
  path_->cost_10_14 = 0;
  path_->pixel_count = 0;
  world_finder_.find_path(request, *path_);
}

}  // namespace lodesman
