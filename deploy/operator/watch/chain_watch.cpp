// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/watch/chain_watch.h"

namespace lodesman::cli {
namespace {

// No ring of the chain is longer, but that of the helm, whose number is known.
constexpr std::uint64_t kMostBack = 16;

// When that was published which `is_it` says yes to, if it is still there.
template <class T, class IsIt>
[[nodiscard]] std::optional<Time> stamp_of(Reader<T>& reader, IsIt is_it) {
  const std::uint64_t newest = reader.newest_sequence();
  for (std::uint64_t back = 0; back < kMostBack && back < newest; ++back) {
    if (const auto* value = reader.at(newest - back); value != nullptr && is_it(value->value)) {
      return value->stamp;
    }
  }
  return std::nullopt;
}

}  // namespace

ChainWatch::ChainWatch(const Blackboard& board)
    : pings_{board.sonar_ping},
      obstacles_{board.sonar_obstacles},
      tracks_{board.tracks},
      requests_{board.path_request},
      paths_{board.sonar_path},
      plans_{board.plan},
      helm_{board.helm_command},
      applied_{board.thrust_applied} {}

void ChainWatch::poll() {
  while (const auto* applied = applied_.next()) {
    const ThrustApplied& thrust = applied->value;
    if (thrust.reason == ThrustReason::kCommanded && thrust.plan_captured != Time{} &&
        thrust.plan_id != followed_plan_) {
      followed_plan_ = thrust.plan_id;
      follow(*applied);
    }
  }
}

void ChainWatch::follow(const Stamped<ThrustApplied>& applied) {
  const ThrustApplied& thrust = applied.value;
  PingToThrust chain;
  chain.plan = thrust.plan_id;
  const auto note = [&](ChainStep step, std::optional<Time> at) {
    if (at) {
      chain.after_s[static_cast<std::size_t>(step)] = to_seconds(*at - thrust.plan_captured);
    }
  };
  note(ChainStep::kPlan, stamp_of(plans_, [&](const Plan& plan) {
         chain.frame = plan.id == chain.plan ? plan.frame : chain.frame;
         return plan.id == chain.plan;
       }));
  note(ChainStep::kPing,
       stamp_of(pings_, [&](const SonarPing& ping) { return ping.number == chain.frame; }));
  note(ChainStep::kObstacles, stamp_of(obstacles_, [&](const SonarObstacles& obstacles) {
         return obstacles.frame == chain.frame;
       }));
  note(ChainStep::kTracks,
       stamp_of(tracks_, [&](const Tracks& tracks) { return tracks.frame == chain.frame; }));
  note(ChainStep::kRequest,
       stamp_of(requests_, [&](const PathRequest& request) { return request.id == chain.plan; }));
  note(ChainStep::kPath,
       stamp_of(paths_, [&](const SonarPath& path) { return path.request == chain.plan; }));
  if (const auto* helm = helm_.at(thrust.command_sequence); helm != nullptr) {
    note(ChainStep::kHelm, helm->stamp);
  }
  note(ChainStep::kApplied, applied.stamp);
  newest_ = chain;
}

}  // namespace lodesman::cli
