// SPDX-License-Identifier: Apache-2.0
// The tasks of both processes, and which publication wakes which of them: one table. Plain
// constants.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace lodesman {

// Every task of both processes, in lock-step order of precedence.
enum class TaskId : std::uint8_t {
  kWorld,
  kAhrs,
  kPosition,
  kEstimator,
  kDeltaT,
  kPathFinder,
  kPlanner,
  kController,
  kThruster,
};
inline constexpr std::size_t kTaskCount = 9;
[[nodiscard]] const char* to_string(TaskId task) noexcept;

enum class WakeWhen : std::uint8_t {
  kPublished,  // at every publication
  kNewState,   // where the writer says that this one is news (Writer::publish_quietly otherwise)
  kNewSample,  // a simulated device has a sample to be polled
  kQuestion,   // of question and answer, the one circle there is: each question has a new id
};

// A publication on `channel` by `writer` rings the bell of `wakes`.
struct WakeEdge {
  std::string_view channel;
  TaskId writer = TaskId::kWorld;
  TaskId wakes = TaskId::kWorld;
  WakeWhen when = WakeWhen::kPublished;
};

// What comes from outside of the tasks: the words of the command socket.
struct OrderEdge {
  std::string_view channel;
  TaskId wakes = TaskId::kPlanner;
};
inline constexpr std::array kOrderEdges{
    OrderEdge{"operator_command", TaskId::kPlanner},
    OrderEdge{"thrust_order", TaskId::kThruster},
    OrderEdge{"manual_input", TaskId::kThruster},
};
// The simulated devices' end of the world (hal_sim/world/sim_link.h), which is no channel here.
inline constexpr std::string_view kSimDevices = "sim:";

// From a ping to thrust. The attitude is in it because what a ping shows is placed at an estimate
// of its own time.
inline constexpr std::array kWakeEdges{
    WakeEdge{kSimDevices, TaskId::kWorld, TaskId::kAhrs, WakeWhen::kNewSample},
    WakeEdge{kSimDevices, TaskId::kWorld, TaskId::kPosition, WakeWhen::kNewSample},
    WakeEdge{kSimDevices, TaskId::kWorld, TaskId::kDeltaT, WakeWhen::kNewSample},
    WakeEdge{"attitude", TaskId::kAhrs, TaskId::kEstimator},
    WakeEdge{"vehicle_state", TaskId::kEstimator, TaskId::kDeltaT},
    WakeEdge{"tracks", TaskId::kDeltaT, TaskId::kPlanner},
    WakeEdge{"path_request", TaskId::kPlanner, TaskId::kPathFinder, WakeWhen::kQuestion},
    WakeEdge{"sonar_path", TaskId::kPathFinder, TaskId::kPlanner},
    WakeEdge{"plan", TaskId::kPlanner, TaskId::kController},
    WakeEdge{"mission_status", TaskId::kPlanner, TaskId::kController, WakeWhen::kNewState},
    WakeEdge{"helm_command", TaskId::kController, TaskId::kThruster},
};

// Whether a ring can come back to the task that began it, questions apart: then it might go round
// for ever. Follows the edges as far as there are tasks.
[[nodiscard]] constexpr bool wakes_go_round() noexcept {
  std::array<bool, kTaskCount> ended{};  // no edge leads on from here but to tasks that have ended
  for (std::size_t round = 0; round < kTaskCount; ++round) {
    for (std::size_t task = 0; task < kTaskCount; ++task) {
      bool leads_on = false;
      for (const WakeEdge& edge : kWakeEdges) {
        leads_on |= static_cast<std::size_t>(edge.writer) == task &&
                    edge.when != WakeWhen::kQuestion &&
                    !ended[static_cast<std::size_t>(edge.wakes)];
      }
      ended[task] = !leads_on;
    }
  }
  for (const bool end : ended) {
    if (!end) {
      return true;
    }
  }
  return false;
}
static_assert(!wakes_go_round());

// Whom a publication on that channel wakes.
[[nodiscard]] constexpr bool wakes(std::string_view channel, TaskId task) noexcept {
  for (const OrderEdge& edge : kOrderEdges) {
    if (edge.channel == channel && edge.wakes == task) {
      return true;
    }
  }
  for (const WakeEdge& edge : kWakeEdges) {
    if (edge.channel == channel && edge.wakes == task) {
      return true;
    }
  }
  return false;
}

// What was applied is the end of the chain: it wakes nobody, so that no circle leads through it.
static_assert([] {
  for (std::size_t task = 0; task < kTaskCount; ++task) {
    if (wakes("thrust_applied", static_cast<TaskId>(task))) {
      return false;
    }
  }
  return true;
}());

}  // namespace lodesman
