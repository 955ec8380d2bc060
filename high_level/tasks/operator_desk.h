// SPDX-License-Identifier: Apache-2.0
// Between the command socket and the mission: takes missions and orders, sees that whoever gives
// them may, and answers once the mission's own status says what became of them. One thread; nothing
// here waits.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "high_level/mission/command_line.h"
#include "high_level/mission/commander.h"
#include "high_level/mission/mission.h"
#include "high_level/tasks/boat_status.h"
#include "high_level/tasks/readiness.h"
#include "high_level/tasks/thrust_desk.h"
#include "mid_level/base/geodesy.h"
#include "mid_level/blackboard/blackboard.h"
#include "mid_level/config/read_mission.h"

namespace lodesman {

struct DeskOptions {
  MissionDefaults mission;
  std::optional<GeoPoint> origin{};  // of the world frame; empty: as the blackboard says, in time
  SpeedTable speeds = SpeedTable::proportional(0.01);
  Tunables tunables;            // as the configuration has them
  double least_margin_m = 0.0;  // [m] no margin is tuned below it
  bool plans_in_world = true;   // the paper's planner knows neither fence nor line
  // The mission at hand for a start that names none, unless one was given before.
  std::optional<MissionDefinition> at_hand{};
  bool starts_by_itself = false;  // that, once the boat is ready, unless somebody gives an order
  bool arms_by_itself = false;    // a start arms the thrusters, if nothing speaks against it
};

class OperatorDesk {
 public:
  using Now = std::function<Time()>;

  // Throws StartupError when the orders have a writer already, or the mission at hand cannot be.
  OperatorDesk(Blackboard& board, Role role, DeskOptions options, Now now);

  // To be called now and then.
  void look();

  // What a command comes to. An abort is on the blackboard when this returns; another order waits
  // for the one before it and for every abort. The desk must outlive the answer.
  [[nodiscard]] Answer answer(const CommandRequest& request);
  // A session of the socket is over.
  void session_ended(std::uint64_t session);

 private:
  // An order other than abort, from when it was given until it is answered.
  struct Order {
    OperatorOrder order = OperatorOrder::kNone;
    Time given{};
    std::uint64_t aborts = 0;                            // ordered when it was given
    std::uint64_t sequence = 0;                          // of its publication; 0: it waits its turn
    std::shared_ptr<const MissionDefinition> mission{};  // start: another than that at hand
  };
  struct Answered {
    std::uint64_t sequence = 0;
    OrderAnswer answer = OrderAnswer::kNone;
    MissionState state = MissionState::kIdle;
  };

  [[nodiscard]] std::string status();
  [[nodiscard]] Answer abort();
  void end_mission();
  [[nodiscard]] std::string manual(const CommandRequest& request);
  [[nodiscard]] Answer order(const CommandRequest& request);
  [[nodiscard]] std::string change_commander(const CommandRequest& request);
  [[nodiscard]] std::string tune(const CommandRequest& request);
  // The world's frame, as far as its origin is known by now.
  [[nodiscard]] const LocalFrame& frame();
  // Every reason against a start now, in words; empty where there is none.
  [[nodiscard]] std::string objections(const MissionDefinition& mission);
  // What whoever gives such an order is told though it is obeyed.
  [[nodiscard]] std::vector<std::string> warnings_for(OperatorOrder order);
  void require_possible(const MissionDefinition& mission) const;
  void lay_out(const MissionDefinition& mission);
  [[nodiscard]] const MissionDefinition* at_hand();
  [[nodiscard]] std::optional<std::string> reply_to_abort(std::uint64_t count, Time given);
  [[nodiscard]] std::optional<std::string> reply_to(Order& order);
  [[nodiscard]] std::optional<std::string> take_turn(Order& order, const MissionStatus& mission);
  void publish(Order& order);
  void publish_link();
  void look_at_mission();
  // The mission's newest word, where it is fresh and not that of a program that was here before.
  [[nodiscard]] const Stamped<MissionStatus>* fresh_mission(Time now);
  [[nodiscard]] bool abort_is_on_its_way() const noexcept { return obeyed_aborts_ < aborts_; }

  DeskOptions options_;
  LocalFrame frame_;
  Reader<WorldOrigin> origin_;
  Now now_;
  Time made_;
  Commander commander_;
  Readiness readiness_;
  ThrustDesk thrust_;
  Writer<MissionDefinition> definitions_;
  Writer<OperatorCommand> orders_;
  Writer<CommandLink> links_;
  Writer<Tunables> tunables_;
  Reader<MissionDefinition> at_hand_;
  Reader<MissionStatus> mission_;
  Reader<VehicleState> state_;
  BoatStatus boat_status_;
  std::uint64_t aborts_ = 0;         // ordered
  std::uint64_t obeyed_aborts_ = 0;  // by the mission's last word
  std::optional<Order> in_hand_;     // published, not yet answered: one at a time
  std::array<Answered, 8> answered_{};
};

}  // namespace lodesman
