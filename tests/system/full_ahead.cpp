// SPDX-License-Identifier: Apache-2.0
#include "tests/system/full_ahead.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "deploy/boat/assembled_boat.h"
#include "hal_sim/world/clearance.h"
#include "mid_level/runtime/run_lockstep.h"
#include "mid_level/runtime/task_table.h"

namespace lodesman::testing {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr Duration kAtRest = seconds{1};  // before it asks for thrust, so that it may be armed

// In the place of all of the high level: says where the truth has the boat, since a known scene is
// drawn there, that a mission is under way, and full ahead.
class MadHighLevel final : public Task {
 public:
  MadHighLevel(Blackboard& board, const FullAhead& order)
      : order_{order},
        truth_{board.world_truth},
        state_{writer_of(board, board.vehicle_state, Role::kHigh)},
        mission_{writer_of(board, board.mission_status, Role::kHigh)},
        helm_{writer_of(board, board.helm_command, Role::kHigh)},
        orders_{writer_of(board, board.thrust_order, Role::kHigh)} {}

  void step(Time now) noexcept override {
    if (began_ == Time{}) {
      began_ = now;
    }
    const Duration since = now - began_;
    say_where(now);
    say_mission(now);
    if (since >= kAtRest + from_seconds(std::min(order_.silent_at_s, 1e6))) {
      return;
    }
    HelmCommand helm;
    helm.reason = HelmReason::kTracking;
    helm.surge_ref = since >= kAtRest ? order_.surge_ref : 0;
    helm_.publish(helm, now);
    if (since >= kAtRest / 2 && !armed_) {
      armed_ = true;
      orders_.publish({ThrustOrderKind::kArm, 0}, now);
    }
  }

 private:
  void say_where(Time now) noexcept {
    const auto* truth = truth_.latest();
    if (truth == nullptr) {
      return;
    }
    VehicleState state;
    state.valid_at = truth->stamp;
    state.x_m = state.odometry_x_m = truth->value.x_m;
    state.y_m = state.odometry_y_m = truth->value.y_m;
    state.heading_rad = truth->value.heading_rad;
    state_.publish(state, now);
  }
  void say_mission(Time now) noexcept {
    MissionStatus mission;
    mission.state = MissionState::kUnderWay;
    mission.first_started = mission.started = began_;
    mission_.publish(mission, now);
  }

  FullAhead order_;
  Reader<WorldTruth> truth_;
  Writer<VehicleState> state_;
  Writer<MissionStatus> mission_;
  Writer<HelmCommand> helm_;
  Writer<ThrustOrder> orders_;
  Time began_{};
  bool armed_ = false;
};

// For so long that nothing else is to come.
[[nodiscard]] bool has_held(Reader<GuardStatus>& guard, Time now) {
  const auto* status = guard.latest();
  return status != nullptr && status->value.state == GuardState::kHolding &&
         now - status->value.since > seconds{4};
}

}  // namespace

FullAheadEnd sail_full_ahead(const BoatConfig& config, const Scenario& scenario,
                             const FullAhead& order) {
  const auto board = std::make_unique<Blackboard>();
  AssembledBoat boat{*board, config, &scenario};
  MadHighLevel high{*board, order};
  std::vector<TaskEntry> tasks = boat.tasks();
  tasks.push_back(scheduled(TaskId::kController, high));
  SimClock clock;
  clock.advance_to(Time{seconds{1}});
  LockstepRunner runner{tasks, clock, *board, {}};
  Reader<WorldTruth> truths{board->world_truth};
  Reader<GuardStatus> guard{board->guard_status};
  FullAheadEnd end;
  const Time until = clock.now() + kAtRest + from_seconds(order.for_s);
  while (clock.now() < until && !has_held(guard, clock.now())) {
    runner.step();
    while (const auto* truth = truths.next()) {
      const WorldTruth& now = truth->value;
      end.least_clearance_m = now.least_hull_clearance_m;
      end.speed_m_s = now.surge_m_s;
      end.fastest_m_s = std::max(end.fastest_m_s, now.surge_m_s);
      end.least_m_s = std::min(end.least_m_s, now.surge_m_s);
      end.way_m = std::hypot(now.x_m - scenario.mission.start.p_WV.xy_m.x(),
                             now.y_m - scenario.mission.start.p_WV.xy_m.y());
    }
  }
  if (const auto* status = guard.latest(); status != nullptr) {
    end.guard = status->value;
  }
  return end;
}

double clearance_m(const Scenario& scenario, const VehiclePose& pose) {
  constexpr HullSize kHull{2.04, 1.20};
  double least_m = std::numeric_limits<double>::infinity();
  for (const MovingObstacle& obstacle : scenario.obstacles) {
    least_m = std::min(least_m, hull_clearance_m(obstacle.at_start, pose, kHull));
  }
  return least_m;
}

bool all_rests(const Scenario& scenario) {
  const bool still_water =
      std::hypot(scenario.environment.current_x_m_s, scenario.environment.current_y_m_s) <= 0.0;
  return still_water &&
         std::all_of(scenario.obstacles.begin(), scenario.obstacles.end(),
                     [](const MovingObstacle& obstacle) {
                       return std::hypot(obstacle.velocity_x_m_s, obstacle.velocity_y_m_s) <= 0.0 &&
                              obstacle.appears_at_s <= 0.0 &&
                              !std::isfinite(obstacle.vanishes_at_s);
                     });
}

}  // namespace lodesman::testing
