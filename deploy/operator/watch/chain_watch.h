// SPDX-License-Identifier: Apache-2.0
// Follows the newest ping that was acted on from its capture to thrust, step by step. One thread;
// it writes nothing to the blackboard.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "mid_level/blackboard/blackboard.h"

namespace lodesman::cli {

// In the order in which a ping goes through them.
enum class ChainStep : std::uint8_t {
  kPing,
  kObstacles,
  kTracks,
  kRequest,
  kPath,
  kPlan,
  kHelm,
  kApplied,
};
inline constexpr std::size_t kChainSteps = 8;
[[nodiscard]] constexpr auto enumerators(ChainStep) noexcept {
  return enumerators_to<ChainStep::kApplied>("ping", "obstacles", "tracks", "request", "path",
                                             "plan", "helm", "applied");
}

// Of the newest plan that thrust followed. Each time is from the capture of what the plan was made
// from to when that step was published; nothing where it was written over before it was looked at.
struct PingToThrust {
  std::uint64_t frame = 0;
  std::uint64_t plan = 0;
  std::array<std::optional<double>, kChainSteps> after_s{};  // [s] by ChainStep
};

class ChainWatch {
 public:
  // `board` must outlive it.
  explicit ChainWatch(const Blackboard& board);

  // To be called so often that rings of a few values are not written over in between.
  void poll();
  // As of the last poll; empty where no plan was followed yet.
  [[nodiscard]] const std::optional<PingToThrust>& newest() const noexcept { return newest_; }

 private:
  void follow(const Stamped<ThrustApplied>& applied);

  Reader<SonarPing> pings_;
  Reader<SonarObstacles> obstacles_;
  Reader<Tracks> tracks_;
  Reader<PathRequest> requests_;
  Reader<SonarPath> paths_;
  Reader<Plan> plans_;
  Reader<HelmCommand> helm_;
  Reader<ThrustApplied> applied_;
  std::uint64_t followed_plan_ = 0;
  std::optional<PingToThrust> newest_;
};

}  // namespace lodesman::cli
