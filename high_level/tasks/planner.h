// SPDX-License-Identifier: Apache-2.0
// The planner task: the mission and the paper's Fig. 1, step by step.
#pragma once

#include "high_level/guidance/replanner.h"
#include "high_level/mission/mission.h"
#include "mid_level/runtime/task.h"

namespace lodesman {

struct PlannerOptions {
  ReplannerOptions replanner;
  MissionOptions mission;
  double sonar_range_m = 0.0;    // [m] > 0 the range setting, the radius of the sonar view
  bool start_by_itself = false;  // as soon as there is an estimate, without an operator's word
};

class PlannerTask final : public Task {
 public:
  PlannerTask(Blackboard& board, Role role, PlannerOptions options);
  void step(Time now) noexcept override;

 private:
  void take_orders(Time now, bool estimate_is_fresh) noexcept;
  void replan(Time now) noexcept;
  void replan_in_view(Time now) noexcept;
  void replan_in_world(Time now) noexcept;
  void publish(const Plan* plan, Time now) noexcept;

  PlannerOptions options_;
  Mission mission_;
  Replanner replanner_;
  PoseHistory poses_;
  WorldPoint position_;  // the last known
  Reader<OperatorCommand> orders_;
  Reader<VehicleState> vehicle_state_;
  Reader<SonarObstacles> obstacles_;
  Reader<Tracks> tracks_;
  Reader<SonarPath> sonar_path_;
  Writer<PathRequest> requests_;
  Writer<Plan> plans_;
  Writer<MissionStatus> statuses_;
};

}  // namespace lodesman
