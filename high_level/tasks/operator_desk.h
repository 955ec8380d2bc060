// SPDX-License-Identifier: Apache-2.0
// Between the command socket and the mission: passes orders on and answers once the mission's own
// status says what became of them. The socket's thread alone; nothing here waits.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>

#include "high_level/mission/command_line.h"
#include "high_level/mission/mission.h"
#include "mid_level/blackboard/blackboard.h"

namespace lodesman {

class OperatorDesk {
 public:
  using Now = std::function<Time()>;

  // Throws StartupError when the orders have a writer already.
  OperatorDesk(Blackboard& board, Role role, Now now);

  // What a command comes to. An abort is on the blackboard when this returns; another order waits
  // for the one before it and for every abort. The desk must outlive the answer.
  [[nodiscard]] Answer answer(const std::string& command);

 private:
  // An order other than abort, from when it was given until it is answered.
  struct Order {
    OperatorOrder order = OperatorOrder::kNone;
    Time given{};
    std::uint64_t aborts = 0;    // ordered when it was given
    std::uint64_t sequence = 0;  // of its publication; 0: it waits for its turn
  };
  struct Answered {
    std::uint64_t sequence = 0;
    OrderAnswer answer = OrderAnswer::kNone;
    MissionState state = MissionState::kIdle;
  };

  [[nodiscard]] std::string status();
  [[nodiscard]] Answer abort();
  [[nodiscard]] std::optional<std::string> reply_to_abort(std::uint64_t count, Time given);
  [[nodiscard]] std::optional<std::string> reply_to(Order& order);
  [[nodiscard]] std::optional<std::string> take_turn(Order& order, const MissionStatus& mission);
  void look_at_mission();
  [[nodiscard]] bool abort_is_on_its_way() const noexcept { return obeyed_aborts_ < aborts_; }

  Now now_;
  Writer<OperatorCommand> orders_;
  Reader<MissionStatus> mission_;
  Reader<VehicleState> state_;
  Reader<Plan> plan_;
  Reader<HelmCommand> helm_;
  std::uint64_t aborts_ = 0;         // ordered
  std::uint64_t obeyed_aborts_ = 0;  // by the mission's last word
  std::optional<Order> in_hand_;     // published, not yet answered: one at a time
  std::array<Answered, 8> answered_{};
};

}  // namespace lodesman
