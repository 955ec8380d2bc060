// SPDX-License-Identifier: Apache-2.0
#include "high_level/tasks/operator_desk.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "mid_level/base/heading.h"

namespace lodesman {
namespace {

using nlohmann::ordered_json;

[[nodiscard]] std::string done(MissionState state) {
  return ordered_json{{"ok", true}, {"state", to_string(state)}}.dump();
}

[[nodiscard]] std::string not_confirmed(const std::string& reason) {
  return ordered_json{{"ok", false}, {"error", "not confirmed: " + reason}, {"confirmed", false}}
      .dump();
}

[[nodiscard]] std::string reply_of(OrderAnswer answer, MissionState state) {
  switch (answer) {
    case OrderAnswer::kObeyed: return done(state);
    case OrderAnswer::kNotUnderWay:
      return refusal(std::string{"not under way but "} + to_string(state));
    case OrderAnswer::kNotHolding:
      return refusal(std::string{"not holding but "} + to_string(state));
    case OrderAnswer::kAborted: return refusal("an abort came first");
    case OrderAnswer::kTooOld:
    case OrderAnswer::kNone: break;
  }
  return not_confirmed("the mission did not take it up in time");
}

[[nodiscard]] OperatorOrder order_of(const std::string& command) noexcept {
  return command == "start"    ? OperatorOrder::kStart
         : command == "hold"   ? OperatorOrder::kHold
         : command == "resume" ? OperatorOrder::kResume
                               : OperatorOrder::kNone;
}

}  // namespace

OperatorDesk::OperatorDesk(Blackboard& board, Role role, Now now)
    : now_{std::move(now)},
      orders_{writer_of(board, board.operator_command, role)},
      mission_{board.mission_status},
      state_{board.vehicle_state},
      plan_{board.plan},
      helm_{board.helm_command} {
  // Goes on counting where a program that was here before has left off.
  Reader<OperatorCommand> before{board.operator_command};
  if (const auto* last = before.latest(); last != nullptr) {
    aborts_ = last->value.aborts;
  }
}

Answer OperatorDesk::answer(const std::string& command) {
  if (stops_the_boat(command)) {
    return abort();
  }
  if (command == "status") {
    return [reply = status()] { return reply; };
  }
  if (const OperatorOrder word = order_of(command); word != OperatorOrder::kNone) {
    return [this, order = Order{word, now_(), aborts_, 0}]() mutable { return reply_to(order); };
  }
  return [reply = refusal("unknown command: " + command)] { return reply; };
}

Answer OperatorDesk::abort() {
  look_at_mission();
  const Time given = now_();
  // One that has yet to be obeyed will be obeyed after this one was given: it stands for both.
  if (!abort_is_on_its_way()) {
    ++aborts_;
    orders_.publish({OperatorOrder::kAbort, aborts_}, given);
  }
  return [this, count = aborts_, given] { return reply_to_abort(count, given); };
}

std::optional<std::string> OperatorDesk::reply_to_abort(std::uint64_t count, Time given) {
  look_at_mission();
  const auto* mission = mission_.latest();
  if (mission != nullptr && obeyed_aborts_ >= count) {
    return done(mission->value.state);
  }
  if (now_() - given > kOrderPatience) {
    return not_confirmed("the mission does not answer");
  }
  return std::nullopt;
}

// Keeps what was answered until all who wait for it have asked.
void OperatorDesk::look_at_mission() {
  const auto* mission = mission_.latest();
  if (mission == nullptr) {
    return;
  }
  obeyed_aborts_ = mission->value.aborts;
  aborts_ = std::max(aborts_, obeyed_aborts_);
  if (in_hand_ && mission->value.order >= in_hand_->sequence) {
    answered_[in_hand_->sequence % answered_.size()] = {in_hand_->sequence, mission->value.answer,
                                                        mission->value.state};
    in_hand_.reset();
  }
  if (in_hand_ && now_() - in_hand_->given > kOrderPatience) {
    in_hand_.reset();  // void for the mission too
  }
}

std::optional<std::string> OperatorDesk::reply_to(Order& order) {
  look_at_mission();
  const Time now = now_();
  const Answered& answered = answered_[order.sequence % answered_.size()];
  if (order.sequence != 0 && answered.sequence == order.sequence) {
    return reply_of(answered.answer, answered.state);
  }
  if (now - order.given > kOrderPatience) {
    return not_confirmed("the mission does not answer");
  }
  const auto* mission = mission_.fresh(now, max_age::kMissionStatus);
  if (order.sequence != 0 || mission == nullptr) {
    return std::nullopt;
  }
  return take_turn(order, mission->value);
}

std::optional<std::string> OperatorDesk::take_turn(Order& order, const MissionStatus& mission) {
  if (order.aborts != aborts_ || abort_is_on_its_way()) {
    return reply_of(OrderAnswer::kAborted, mission.state);
  }
  if (in_hand_) {
    if (in_hand_->order == order.order) {
      order.sequence = in_hand_->sequence;  // the same word: one publication does for both
    }
    return std::nullopt;
  }
  const Ruling ruling = ruling_on(order.order, mission.state);
  if (ruling.answer != OrderAnswer::kObeyed || ruling.state == mission.state) {
    return reply_of(ruling.answer, mission.state);  // nothing to change: nothing to publish
  }
  const Time now = now_();
  orders_.publish({order.order, aborts_}, now);
  order.sequence = orders_.sequence();
  in_hand_ = order;
  in_hand_->given = now;
  return std::nullopt;
}

std::string OperatorDesk::status() {
  const Time now = now_();
  ordered_json reply{{"ok", true}, {"protocol", kCommandProtocol}};
  if (const auto* mission = mission_.latest(); mission != nullptr) {
    const MissionStatus& m = mission->value;
    reply["state"] = to_string(m.state);
    reply["time_s"] = m.started == Time{} ? 0.0 : to_seconds(now - m.started);
    reply["goal_m"] = {m.goal_x_m, m.goal_y_m};
    reply["aborts"] = m.aborts;
    if (m.no_way != NoWayCause::kNone) {
      reply["no_way"] = {{"cause", to_string(m.no_way)},
                         {"for_s", to_seconds(now - m.no_way_since)}};
    }
  }
  if (const auto* state = state_.latest(); state != nullptr) {
    reply["position_m"] = {state->value.x_m, state->value.y_m};
    reply["heading_deg"] = compass_deg(state->value.heading_rad);
    reply["state_age_s"] = to_seconds(now - state->stamp);
  }
  if (const auto* plan = plan_.latest(); plan != nullptr) {
    reply["plan"] = {{"id", plan->value.id},
                     {"reason", to_string(plan->value.reason)},
                     {"rung", to_string(plan->value.rung)},
                     {"waypoints", to_string(plan->value.source)},
                     {"age_s", to_seconds(now - plan->stamp)}};
  }
  if (const auto* helm = helm_.latest(); helm != nullptr) {
    reply["helm"] = to_string(helm->value.reason);
  }
  return reply.dump();
}

}  // namespace lodesman
