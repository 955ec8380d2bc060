// SPDX-License-Identifier: Apache-2.0
// The PathFinder task: answers each path request once, in the sonar frame that it names.
// Stepped by its runner's thread.
#pragma once

#include <array>
#include <memory>
#include <span>

#include "low_level/path/path_finder.h"
#include "low_level/path/world_path_finder.h"
#include "mid_level/runtime/task.h"

namespace lodesman {

class PathFinderTask final : public Task {
 public:
  PathFinderTask(Blackboard& board, Role role);
  void step(Time now) noexcept override;
  [[nodiscard]] std::uint64_t refused() const noexcept override {
    return refused_by(requests_, obstacles_);
  }
  [[nodiscard]] std::span<ChannelLook<>* const> inputs() noexcept override { return inputs_; }

 private:
  void find(const PathRequest& request) noexcept;
  void find_in_view(const PathRequest& request) noexcept;
  void find_in_world(const PathRequest& request) noexcept;

  PathFinder finder_;
  WorldPathFinder world_finder_;
  Reader<PathRequest> requests_;
  Reader<SonarObstacles> obstacles_;
  std::array<ChannelLook<>*, 2> inputs_{&obstacles_, &requests_};
  Writer<SonarPath> paths_;
  std::uint64_t answered_;  // the last one's number
  std::unique_ptr<SonarPath> path_ = std::make_unique<SonarPath>();
};

}  // namespace lodesman
