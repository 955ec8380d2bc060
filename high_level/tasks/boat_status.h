// SPDX-License-Identifier: Apache-2.0
// What the boat is doing, as the blackboard has it and as an operator is told. Part of the
// operator's desk; one thread.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "high_level/tasks/readiness.h"

namespace lodesman {

class BoatStatus {
 public:
  BoatStatus(const Blackboard& board, bool arms_by_itself);

  // Mission, place, plan, helm and devices, as far as they are known.
  void add_to(nlohmann::ordered_json& reply, Time now);

 private:
  void add_thrust(nlohmann::ordered_json& reply, Time now);
  void add_guard(nlohmann::ordered_json& reply, Time now);
  void add_place(nlohmann::ordered_json& reply, Time now);
  void add_devices(nlohmann::ordered_json& reply, Time now);

  Readiness readiness_;
  Reader<MissionStatus> mission_;
  Reader<VehicleState> state_;
  Reader<WorldOrigin> origin_;
  Reader<Plan> plan_;
  Reader<HelmCommand> helm_;
  Reader<ThrustStatus> thrust_;
  Reader<BatteryStatus> battery_;
  Reader<GuardStatus> guard_;
};

}  // namespace lodesman
