// SPDX-License-Identifier: Apache-2.0
// The blackboard: one struct of typed channels, all that passes between the two processes (the
// paper's mid level). The same struct lies in shared memory, or on the heap in lock-step.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>

#include "mid_level/blackboard/bell.h"
#include "mid_level/blackboard/channel.h"
#include "mid_level/blackboard/wake_edges.h"
#include "mid_level/messages/arming.h"
#include "mid_level/messages/command.h"
#include "mid_level/messages/coverage.h"
#include "mid_level/messages/guard.h"
#include "mid_level/messages/health.h"
#include "mid_level/messages/mission.h"
#include "mid_level/messages/origin.h"
#include "mid_level/messages/path.h"
#include "mid_level/messages/sonar.h"
#include "mid_level/messages/step_inputs.h"
#include "mid_level/messages/tracks.h"
#include "mid_level/messages/vehicle.h"

namespace lodesman {

// How old a value may be before its readers act as if its writer were dead.
namespace max_age {
using std::chrono::milliseconds;
inline constexpr Duration kWorldTruth = milliseconds{500};
inline constexpr Duration kAttitude = milliseconds{300};
inline constexpr Duration kPositionFix = milliseconds{3000};
inline constexpr Duration kVehicleState = milliseconds{400};
inline constexpr Duration kSonarFrame = milliseconds{2000};
inline constexpr Duration kMissionStatus = milliseconds{400};
inline constexpr Duration kHelmCommand = milliseconds{300};
inline constexpr Duration kManualInput = milliseconds{500};
inline constexpr Duration kThrustStatus = milliseconds{500};
inline constexpr Duration kThrustApplied = milliseconds{500};
inline constexpr Duration kGuardStatus = milliseconds{500};
inline constexpr Duration kBatteryStatus = milliseconds{3000};
inline constexpr Duration kDeviceHealth = milliseconds{3000};
inline constexpr Duration kNoLimit{};
}  // namespace max_age

// What of each task is recorded that it can be stepped again by: those that decide from what is on
// the blackboard alone.
struct StepInputsInfo {
  TaskId task;
  const char* channel;
  Role writer;
};
inline constexpr std::size_t kReplayedCount = 5;
inline constexpr std::array<StepInputsInfo, kReplayedCount> kStepInputsInfo{{
    {TaskId::kEstimator, "estimator_inputs", Role::kHigh},
    {TaskId::kDeltaT, "delta_t_inputs", Role::kLow},
    {TaskId::kPathFinder, "path_finder_inputs", Role::kLow},
    {TaskId::kPlanner, "planner_inputs", Role::kHigh},
    {TaskId::kController, "controller_inputs", Role::kHigh},
}};

struct Blackboard {
  Channel<WorldTruth, 256> world_truth;
  Channel<Attitude, 64> attitude;
  Channel<PositionFix, 16> position_fix;
  Channel<WorldOrigin, 4> world_origin;
  Channel<VehicleState, 64> vehicle_state;
  Channel<EstimatorMemory, 4> estimator_memory;
  Channel<SonarPing, 4> sonar_ping;
  Channel<SonarObstacles, 16> sonar_obstacles;
  Channel<Coverage, 8> coverage;
  Channel<Tracks, 8> tracks;
  Channel<PathRequest, 8> path_request;
  Channel<SonarPath, 8> sonar_path;
  Channel<Plan, 16> plan;
  Channel<MissionDefinition, 4> mission_definition;
  Channel<OperatorCommand, 8> operator_command;
  Channel<CommandLink, 8> command_link;
  Channel<Tunables, 4> tunables;
  Channel<MissionStatus, 64> mission_status;
  Channel<HelmCommand, 64> helm_command;
  Channel<ThrustOrder, 8> thrust_order;
  Channel<ManualInput, 16> manual_input;
  Channel<ThrustStatus, 64> thrust_status;
  Channel<ThrustApplied, 64> thrust_applied;
  Channel<GuardStatus, 64> guard_status;
  Channel<BoxProof, 4> box_proof;
  Channel<BatteryStatus, 4> battery_status;
  std::array<Channel<DeviceHealth, 4>, kDeviceCount> device_health;
  std::array<Channel<TaskHealth, 2>, kTaskCount> task_health;
  // So many that who comes a second late still has them from the first.
  std::array<Channel<StepInputs, 256>, kReplayedCount> step_inputs;
  std::array<Bell<>, kTaskCount> bells;  // no channel: rung by writers, waited for by their tasks

  [[nodiscard]] Bell<>& bell_of(TaskId task) noexcept {
    return bells[static_cast<std::size_t>(task)];
  }
};

// What is worth knowing of a channel besides its type: one row a channel, for displays and docs.
struct ChannelInfo {
  const char* name;
  Role writer;
  const char* writer_task;
  Duration max_age;  // zero: no limit
};

// By DeviceId: its health's channel, and the task that owns it.
struct DeviceInfo {
  const char* channel;
  const char* task;
};
inline constexpr std::array<DeviceInfo, kDeviceCount> kDeviceInfo{{
    {"heading_device", "ahrs"},
    {"sonar_device", "delta_t"},
    {"position_device", "position"},
    {"thruster_device", "thruster"},
}};

// Those that there are several of: a device's, a task's.
template <class Board, class Visit>
void for_each_numbered_channel(Board& board, Visit& visit) {
  for (std::size_t i = 0; i < kDeviceCount; ++i) {
    const DeviceInfo& info = kDeviceInfo[i];
    visit(ChannelInfo{info.channel, Role::kLow, info.task, max_age::kDeviceHealth},
          board.device_health[i]);
  }
  for (std::size_t i = 0; i < kTaskCount; ++i) {
    const auto task = static_cast<TaskId>(i);
    const bool high =
        task == TaskId::kEstimator || task == TaskId::kPlanner || task == TaskId::kController;
    visit(ChannelInfo{to_string(task), high ? Role::kHigh : Role::kLow, to_string(task),
                      max_age::kNoLimit},
          board.task_health[i]);
  }
  for (std::size_t i = 0; i < kReplayedCount; ++i) {
    const StepInputsInfo& info = kStepInputsInfo[i];
    visit(ChannelInfo{info.channel, info.writer, to_string(info.task), max_age::kNoLimit},
          board.step_inputs[i]);
  }
}

// Calls visit(ChannelInfo, channel) for every channel, in the order of the struct.
template <class Board, class Visit>
void for_each_channel(Board& board, Visit visit) {
  visit(ChannelInfo{"world_truth", Role::kLow, "world", max_age::kWorldTruth}, board.world_truth);
  visit(ChannelInfo{"attitude", Role::kLow, "ahrs", max_age::kAttitude}, board.attitude);
  visit(ChannelInfo{"position_fix", Role::kLow, "position", max_age::kPositionFix},
        board.position_fix);
  visit(ChannelInfo{"world_origin", Role::kHigh, "estimator", max_age::kNoLimit},
        board.world_origin);
  visit(ChannelInfo{"vehicle_state", Role::kHigh, "estimator", max_age::kVehicleState},
        board.vehicle_state);
  visit(ChannelInfo{"estimator_memory", Role::kHigh, "estimator", max_age::kNoLimit},
        board.estimator_memory);
  visit(ChannelInfo{"sonar_ping", Role::kLow, "delta_t", max_age::kSonarFrame}, board.sonar_ping);
  visit(ChannelInfo{"sonar_obstacles", Role::kLow, "delta_t", max_age::kSonarFrame},
        board.sonar_obstacles);
  visit(ChannelInfo{"coverage", Role::kLow, "delta_t", max_age::kSonarFrame}, board.coverage);
  visit(ChannelInfo{"tracks", Role::kLow, "delta_t", max_age::kSonarFrame}, board.tracks);
  visit(ChannelInfo{"path_request", Role::kHigh, "planner", max_age::kNoLimit}, board.path_request);
  visit(ChannelInfo{"sonar_path", Role::kLow, "path_finder", max_age::kNoLimit}, board.sonar_path);
  visit(ChannelInfo{"plan", Role::kHigh, "planner", max_age::kNoLimit}, board.plan);
  visit(ChannelInfo{"mission_definition", Role::kHigh, "command socket", max_age::kNoLimit},
        board.mission_definition);
  visit(ChannelInfo{"operator_command", Role::kHigh, "command socket", max_age::kNoLimit},
        board.operator_command);
  visit(ChannelInfo{"command_link", Role::kHigh, "command socket", max_age::kNoLimit},
        board.command_link);
  visit(ChannelInfo{"tunables", Role::kHigh, "command socket", max_age::kNoLimit}, board.tunables);
  visit(ChannelInfo{"mission_status", Role::kHigh, "planner", max_age::kMissionStatus},
        board.mission_status);
  visit(ChannelInfo{"helm_command", Role::kHigh, "controller", max_age::kHelmCommand},
        board.helm_command);
  visit(ChannelInfo{"thrust_order", Role::kHigh, "command socket", max_age::kNoLimit},
        board.thrust_order);
  visit(ChannelInfo{"manual_input", Role::kHigh, "command socket", max_age::kManualInput},
        board.manual_input);
  visit(ChannelInfo{"thrust_status", Role::kLow, "thruster", max_age::kThrustStatus},
        board.thrust_status);
  visit(ChannelInfo{"thrust_applied", Role::kLow, "thruster", max_age::kThrustApplied},
        board.thrust_applied);
  visit(ChannelInfo{"guard_status", Role::kLow, "thruster", max_age::kGuardStatus},
        board.guard_status);
  visit(ChannelInfo{"box_proof", Role::kLow, "thruster", max_age::kNoLimit}, board.box_proof);
  visit(ChannelInfo{"battery_status", Role::kLow, "thruster", max_age::kBatteryStatus},
        board.battery_status);
  for_each_numbered_channel(board, visit);
}

// The writer of one of the board's own channels, which rings those that the channel wakes. Throws
// StartupError when the channel has a writer already.
template <Wire T, std::size_t kDepth>
[[nodiscard]] Writer<T> writer_of(Blackboard& board, Channel<T, kDepth>& channel, Role role) {
  const char* name = nullptr;
  for_each_channel(board, [&](const ChannelInfo& info, const auto& other) {
    name = static_cast<const void*>(&other) == &channel ? info.name : name;
  });
  LODESMAN_CHECK(name != nullptr);
  Writer<T> writer{channel, role, name};
  for (std::size_t i = 0; i < kTaskCount; ++i) {
    if (wakes(name, static_cast<TaskId>(i))) {
      writer.rings(board.bells[i]);
    }
  }
  return writer;
}

}  // namespace lodesman
