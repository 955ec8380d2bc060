// SPDX-License-Identifier: Apache-2.0
// The controller task: tracks the waypoints of the newest plan with the mission's constant surge
// and the P controller of the heading (eqs 7-9); neutral, with the reason, whenever an input is
// missing. Stepped by its runner's thread.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "high_level/guidance/steering.h"
#include "high_level/guidance/waypoints.h"
#include "mid_level/runtime/task.h"

namespace lodesman {

struct ControllerOptions {
  SteeringOptions steering;
  double waypoint_radius_m = 0.0;  // [m] > 0
  double look_ahead_m = 0.0;       // [m] > 0 of steering by line of sight, at rest
  double look_ahead_s = 0.0;       // [s] what of it comes with a metre a second
};

class ControllerTask final : public Task {
 public:
  ControllerTask(Blackboard& board, Role role, const ControllerOptions& options);
  void step(Time now) noexcept override;
  void enter_safe_state(Time now) noexcept override;
  [[nodiscard]] std::uint64_t refused() const noexcept override {
    return refused_by(attitude_, vehicle_state_, mission_status_, plan_, tunables_);
  }
  [[nodiscard]] std::span<ChannelLook<>* const> inputs() noexcept override { return inputs_; }

 private:
  void take_tunables() noexcept;
  [[nodiscard]] HelmCommand decide(Time now) noexcept;
  void steer_for_waypoint(const Plan& plan, const WorldPoint& position, Heading heading,
                          HelmCommand& helm) noexcept;
  void steer_by_pilot(const Plan& plan, const VehicleState& state, const Attitude& attitude,
                      HelmCommand& helm) noexcept;
  [[nodiscard]] Steering steering_of(const Plan& plan, const SteeringPoint& ahead,
                                     const VehicleState& state,
                                     const Attitude& attitude) const noexcept;
  static void set(const Helm& wanted, HelmCommand& helm) noexcept;

  ControllerOptions options_;
  std::optional<Time> begun_;  // its first step
  Cruise cruise_;              // of the mission
  WaypointTracker tracker_;
  Reader<Attitude> attitude_;
  Reader<VehicleState> vehicle_state_;
  Reader<MissionStatus> mission_status_;
  Reader<Plan> plan_;
  Reader<Tunables> tunables_;
  std::array<ChannelLook<>*, 5> inputs_{&tunables_, &attitude_, &vehicle_state_, &plan_,
                                        &mission_status_};
  Writer<HelmCommand> commands_;
};

}  // namespace lodesman
