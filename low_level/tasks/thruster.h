// SPDX-License-Identifier: Apache-2.0
// The Thruster task: turns the references of helm or stick into thrust commands (eqs 13-14) and
// hands them to the box, as far as the thrusters are armed; neutral whenever whoever commands has
// fallen silent, in every mode; and less than either asks for where the guard says so. What the box
// did not take is reported as not done.
// Stepped by its runner's thread.
#pragma once

#include "drivers/hal/devices.h"
#include "low_level/tasks/device_report.h"
#include "low_level/thrust/arming.h"
#include "low_level/thrust/battery.h"
#include "low_level/thrust/guard.h"
#include "mid_level/runtime/task.h"

namespace lodesman {

struct ThrusterOptions {
  BatteryOptions battery;
  GuardOptions guard;
  bool stop_is_latched = false;  // an emergency stop from before the power was off
  bool remembers = true;         // that a low level shortly before had the thrusters armed
};

class ThrusterTask final : public Task {
 public:
  // Without thrusters nothing is applied, and that is said. On a blackboard that a low level left
  // shortly before, they are armed if that had them armed.
  ThrusterTask(Blackboard& board, Role role, ThrusterPair* thrusters,
               const ThrusterOptions& options = {})
      : thrusters_{thrusters},
        helm_{board.helm_command},
        mission_{board.mission_status},
        orders_{board.thrust_order},
        stick_{board.manual_input},
        obstacles_{board.sonar_obstacles},
        attitude_{board.attitude},
        before_{board.thrust_status},
        status_{writer_of(board, board.thrust_status, role)},
        applied_{writer_of(board, board.thrust_applied, role)},
        guard_out_{writer_of(board, board.guard_status, role)},
        proof_before_{board.box_proof},
        applied_before_{board.thrust_applied},
        proof_{writer_of(board, board.box_proof, role)},
        battery_out_{writer_of(board, board.battery_status, role)},
        device_{board, role, DeviceId::kThrusters, max_age::kThrustApplied},
        battery_{options.battery},
        guard_{options.guard},
        stop_is_latched_{options.stop_is_latched},
        remembers_{options.remembers} {}

  void step(Time now) noexcept override;
  [[nodiscard]] std::uint64_t refused() const noexcept override {
    return refused_by(helm_, orders_, stick_, obstacles_, attitude_);
  }
  void enter_safe_state(Time now) noexcept override;

 private:
  void begin(Time now) noexcept;
  void recall_proof() noexcept;
  void keep_proof(Time now) noexcept;
  void look(Time now) noexcept;
  void obey_orders(Time now) noexcept;
  [[nodiscard]] ThrustApplied wanted(Time now) noexcept;
  [[nodiscard]] ThrustApplied by_helm(Time now) noexcept;
  [[nodiscard]] ThrustApplied by_stick(Time now) noexcept;
  [[nodiscard]] ThrustApplied guarded(const ThrustApplied& wanted, Time now) noexcept;
  [[nodiscard]] GuardView view_for(const ThrustApplied& wanted, Time now) noexcept;
  [[nodiscard]] ThrustReason command(ThrustCommand thrust, Time now) noexcept;
  void watch_battery(ThrustCommand thrust, Time now) noexcept;

  ThrusterPair* thrusters_;
  Reader<HelmCommand> helm_;
  Reader<MissionStatus> mission_;
  Reader<ThrustOrder> orders_;
  Reader<ManualInput> stick_;
  Reader<SonarObstacles> obstacles_;
  Reader<Attitude> attitude_;
  Reader<ThrustStatus> before_;
  Writer<ThrustStatus> status_;
  Writer<ThrustApplied> applied_;
  Writer<GuardStatus> guard_out_;
  Reader<BoxProof> proof_before_;
  Reader<ThrustApplied> applied_before_;
  Writer<BoxProof> proof_;
  Writer<BatteryStatus> battery_out_;
  DeviceReport device_;
  Arming arming_;
  BatteryMonitor battery_;
  Guard guard_;
  bool stop_is_latched_;
  bool remembers_;
  bool begun_ = false;
  CommandStatus box_ = CommandStatus::kNotReady;  // to the last command
  std::uint64_t obeyed_ = 0;                      // sequence of the last order that was taken
  Time helm_asks_{};                              // for thrust, since then; 0: it does not
  Time aborted_{};                                // the mission, since then; 0: it is not
  BoxProof told_proof_;
  BatteryLevel told_level_ = BatteryLevel::kUnknown;
  Time battery_told_{};
};

}  // namespace lodesman
