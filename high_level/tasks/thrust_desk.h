// SPDX-License-Identifier: Apache-2.0
// Between the command socket and the arming of the thrusters, which lives in the low level: gives
// the words, and answers once the thruster task says what became of them. Part of the operator's
// desk; one thread; nothing here waits.
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "high_level/mission/command_line.h"
#include "mid_level/blackboard/blackboard.h"

namespace lodesman {

class ThrustDesk {
 public:
  using Now = std::function<Time()>;

  // `arms_by_itself`: a start arms what is disarmed, since nothing real can turn, or since whoever
  // started the boat wanted it to sail. Throws StartupError when the orders have a writer already.
  ThrustDesk(Blackboard& board, Role role, bool arms_by_itself, Now now);

  // arm, disarm, estop (released with `release`): the answer, when there is one. What makes safe is
  // on the blackboard when this returns.
  [[nodiscard]] Answer order(const CommandRequest& request);
  // A word of the stick: why it is not taken, or nothing.
  [[nodiscard]] std::optional<std::string> move_stick(const CommandRequest& request);
  // A mission is about to be sailed: the stick is out of the hand, and what may be armed is.
  void make_way();
  // Every now and then: arming that was refused for what was over at once is tried once more.
  void look();

  [[nodiscard]] bool is_armed();

 private:
  struct Order {
    ThrustOrderKind kind = ThrustOrderKind::kNone;
    Time given{};
    std::uint64_t stops = 0;     // ordered when it was given
    std::uint64_t sequence = 0;  // of its publication; 0: it waits its turn
  };

  void publish(Order& order);
  void hear();
  [[nodiscard]] const ThrustStatus* status();
  [[nodiscard]] std::optional<std::string> reply_to(Order& order);
  [[nodiscard]] std::string reply_of(const Order& order, const ThrustStatus& status);

  bool arms_by_itself_;
  Now now_;
  Time made_;
  Writer<ThrustOrder> orders_;
  Writer<ManualInput> stick_;
  Reader<ThrustStatus> status_;
  Reader<MissionStatus> mission_;
  Reader<DeviceHealth> device_;
  std::uint64_t stops_ = 0;    // ordered
  std::uint64_t in_hand_ = 0;  // published, not yet answered; 0: none
  Time in_hand_since_{};
  std::optional<Order> way_;  // the arming that a mission waits for
};

// What speaks against arming, in words, each followed by what mends it where there is something.
// `box`: the thruster box's health; may be nullptr.
[[nodiscard]] std::vector<std::string> in_words(std::uint32_t objections, const DeviceHealth* box);

}  // namespace lodesman
