// SPDX-License-Identifier: Apache-2.0
#include "high_level/tasks/operator_desk.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "high_level/guidance/areas.h"
#include "high_level/tasks/desk_replies.h"
#include "high_level/tasks/tuning.h"

namespace lodesman {
namespace {

using nlohmann::ordered_json;

[[nodiscard]] OperatorOrder order_of(const std::string& command) noexcept {
  return command == "start"    ? OperatorOrder::kStart
         : command == "hold"   ? OperatorOrder::kHold
         : command == "resume" ? OperatorOrder::kResume
                               : OperatorOrder::kNone;
}

[[nodiscard]] Scope needed_for(const std::string& command) noexcept {
  return command == "status"                              ? Scope::kView
         : stops_the_boat(command) || command == "disarm" ? Scope::kAbort
                                                          : Scope::kCommand;
}

}  // namespace

OperatorDesk::OperatorDesk(Blackboard& board, Role role, DeskOptions options, Now now)
    : options_{std::move(options)},
      origin_{board.world_origin},
      now_{std::move(now)},
      made_{now_()},
      readiness_{board, options_.arms_by_itself},
      thrust_{board, role, options_.arms_by_itself, now_},
      definitions_{writer_of(board, board.mission_definition, role)},
      orders_{writer_of(board, board.operator_command, role)},
      links_{writer_of(board, board.command_link, role)},
      tunables_{writer_of(board, board.tunables, role)},
      at_hand_{board.mission_definition},
      mission_{board.mission_status},
      state_{board.vehicle_state},
      boat_status_{board, options_.arms_by_itself} {
  if (options_.origin) {
    frame_.move_to(*options_.origin);
  }
  // Goes on counting where a program that was here before has left off.
  Reader<OperatorCommand> before{board.operator_command};
  if (const auto* last = before.latest(); last != nullptr) {
    aborts_ = last->value.aborts;
  }
  // A commander's link is left as it was: it is lost, unless somebody takes command again.
  if (const auto left = tunables_left(board)) {
    options_.tunables = *left;
  } else {
    links_.publish({}, now_());
  }
  options_.tunables.version = tunables_.sequence() + 1;
  tunables_.publish(options_.tunables, now_());
  if (options_.at_hand) {
    require_possible(*options_.at_hand);
    if (at_hand() == nullptr) {
      lay_out(*options_.at_hand);
    }
  }
}

const LocalFrame& OperatorDesk::frame() {
  const auto* fixed = options_.origin ? nullptr : origin_.latest();
  if (fixed != nullptr && fixed->value.source == OriginSource::kFirstFix) {
    frame_.move_to({fixed->value.latitude_deg, fixed->value.longitude_deg});
  }
  return frame_;
}

void OperatorDesk::require_possible(const MissionDefinition& mission) const {
  if (const std::string no = options_.speeds.objection(mission.speed_m_s); !no.empty()) {
    throw StartupError("speed_m_s: " + no);
  }
  if (mission.area_count > 0 && !options_.plans_in_world) {
    throw StartupError("fence_m, keep_out_m: the paper's planner knows none (planner.space)");
  }
  if (mission.legs != Legs::kFree && !options_.plans_in_world) {
    throw StartupError("legs: the paper's planner keeps to no line (planner.space)");
  }
  for (std::uint32_t i = 0; i < mission.goal_count; ++i) {
    const WorldPoint goal{{mission.goals[i].x_m, mission.goals[i].y_m}};
    for (const MissionArea& area : areas_of(mission)) {
      if (!allows(area, goal)) {
        throw StartupError(
            std::string{i + 1 < mission.goal_count ? "waypoints" : "goal"} + ": lies " +
            (area.kind == AreaKind::kFence ? "outside the fence" : "in a keep-out area"));
      }
    }
  }
}

void OperatorDesk::lay_out(const MissionDefinition& mission) {
  MissionDefinition next = mission;
  next.id = definitions_.sequence() + 1;
  definitions_.publish(next, now_());
}

const MissionDefinition* OperatorDesk::at_hand() {
  const auto* definition = at_hand_.latest();
  return definition != nullptr ? &definition->value : nullptr;
}

std::string OperatorDesk::objections(const MissionDefinition& mission) {
  std::vector<std::string> reasons = readiness_.reasons(now_());
  const auto* state = state_.fresh(now_(), max_age::kVehicleState);
  for (const MissionArea& area : areas_of(mission)) {
    if (state != nullptr && !allows(area, {{state->value.x_m, state->value.y_m}})) {
      reasons.emplace_back(area.kind == AreaKind::kFence ? "the boat lies outside the fence"
                                                         : "the boat lies in a keep-out area");
    }
  }
  std::string text;
  for (const std::string& reason : reasons) {
    text += (text.empty() ? "not ready: " : "; ") + reason;
  }
  return text;
}

std::vector<std::string> OperatorDesk::warnings_for(OperatorOrder order) {
  return order == OperatorOrder::kStart ? readiness_.warnings() : std::vector<std::string>{};
}

const Stamped<MissionStatus>* OperatorDesk::fresh_mission(Time now) {
  const auto* mission = mission_.fresh(now, max_age::kMissionStatus);
  return mission != nullptr && mission->stamp >= made_ ? mission : nullptr;
}

void OperatorDesk::look() {
  thrust_.look();
  const Time now = now_();
  const auto* mission = fresh_mission(now);
  const MissionDefinition* definition = at_hand();
  if (!options_.starts_by_itself || mission == nullptr || definition == nullptr) {
    return;
  }
  look_at_mission();
  if (mission->value.state != MissionState::kIdle || abort_is_on_its_way()) {
    options_.starts_by_itself = false;  // somebody has given an order, or an abort stands
  } else if (!in_hand_ && objections(*definition).empty()) {
    Order order{OperatorOrder::kStart, now, aborts_};
    publish(order);
  }
}

void OperatorDesk::session_ended(std::uint64_t session) { commander_.ended(session); }

Answer OperatorDesk::answer(const CommandRequest& request) {
  const std::string& command = request.command;
  const auto at_once = [](std::string reply) {
    return [reply = std::move(reply)] { return reply; };
  };
  if (request.scope < needed_for(command) || (request.release && request.scope < Scope::kCommand)) {
    return at_once(refusal("this token is not good for " + command));
  }
  if (command == "abort") {
    return abort();
  }
  if ((command == "estop" && !request.release) || command == "disarm") {
    end_mission();
    return thrust_.order(request);
  }
  if (command == "status") {
    return at_once(status());
  }
  if (command == "take" || command == "heartbeat" || command == "release") {
    return at_once(change_commander(request));
  }
  const bool is_thrust = command == "arm" || command == "estop";
  if (command == "tune" || command == "manual" || is_thrust ||
      order_of(command) != OperatorOrder::kNone) {
    if (const auto no = commander_.objection(request.session, now_())) {
      return at_once(refusal(*no));
    }
    return command == "tune"     ? at_once(tune(request))
           : command == "manual" ? at_once(manual(request))
           : is_thrust           ? thrust_.order(request)
                                 : order(request);
  }
  return at_once(refusal("unknown command: " + command));
}

Answer OperatorDesk::order(const CommandRequest& request) {
  Order order{order_of(request.command), now_(), aborts_};
  if (order.order == OperatorOrder::kStart) {
    try {
      if (request.mission) {
        auto mission = std::make_shared<MissionDefinition>(
            read_mission_text(*request.mission, "mission", options_.mission, &frame()));
        require_possible(*mission);
        order.mission = std::move(mission);
      }
    } catch (const StartupError& error) {
      return [reply = refusal(error.what())] { return reply; };
    }
    const MissionDefinition* meant = order.mission ? order.mission.get() : at_hand();
    if (meant == nullptr) {
      return [reply = reply_of(OrderAnswer::kNoMission, MissionState::kIdle)] { return reply; };
    }
    if (const std::string no = objections(*meant); !no.empty()) {
      return [reply = refusal(no)] { return reply; };
    }
    if (commander_.link().session != request.session) {
      commander_.forget_the_lost(now_());
      publish_link();
    }
  }
  options_.starts_by_itself = false;
  return [this, order]() mutable { return reply_to(order); };
}

std::string OperatorDesk::change_commander(const CommandRequest& request) {
  const Time now = now_();
  const auto no = request.command == "take"
                      ? commander_.take(request.session, request.name, request.force, now)
                  : request.command == "release" ? commander_.release(request.session)
                                                 : commander_.beat(request.session, now);
  if (no) {
    return refusal(*no);
  }
  publish_link();
  const auto* mission = mission_.latest();
  return done(mission != nullptr ? mission->value.state : MissionState::kIdle);
}

void OperatorDesk::publish_link() { links_.publish(commander_.link(), now_()); }

std::string OperatorDesk::tune(const CommandRequest& request) {
  Tunables next = options_.tunables;
  if (std::string no = tune_by(request.set, options_.least_margin_m, next); !no.empty()) {
    return refusal(no);
  }
  if (!request.set.empty()) {
    ++next.version;
    options_.tunables = next;
    tunables_.publish(next, now_());
  }
  return ordered_json{{"ok", true}, {"tunables", json_of(next)}}.dump();
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

// What is sailed without thrust must not go on where it stood once there is thrust again.
void OperatorDesk::end_mission() {
  const auto* mission = mission_.latest();
  if (mission != nullptr && (mission->value.state == MissionState::kUnderWay ||
                             mission->value.state == MissionState::kHolding)) {
    static_cast<void>(abort());
  }
  options_.starts_by_itself = false;
}

// Whoever has the stick in hand has the boat: a mission under way waits where the stick leaves it.
std::string OperatorDesk::manual(const CommandRequest& request) {
  if (const auto no = thrust_.move_stick(request)) {
    return refusal(*no);
  }
  look_at_mission();
  options_.starts_by_itself = false;
  const auto* mission = mission_.latest();
  if (mission != nullptr && mission->value.state == MissionState::kUnderWay && !in_hand_ &&
      !abort_is_on_its_way()) {
    Order hold{OperatorOrder::kHold, now_(), aborts_};
    publish(hold);
  }
  return ordered_json{{"ok", true}, {"state", to_string(ThrustState::kManual)}}.dump();
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
    return reply_of(answered.answer, answered.state, warnings_for(order.order));
  }
  if (now - order.given > kOrderPatience) {
    return not_confirmed("the mission does not answer");
  }
  const auto* mission = fresh_mission(now);
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
    if (in_hand_->order == order.order && !order.mission) {
      order.sequence = in_hand_->sequence;  // the same word: one publication does for both
    }
    return std::nullopt;
  }
  const Ruling ruling = ruling_on(order.order, mission.state);
  if (ruling.answer != OrderAnswer::kObeyed || (ruling.state == mission.state && !order.mission)) {
    if (ruling.answer == OrderAnswer::kObeyed && order.order == OperatorOrder::kStart) {
      thrust_.make_way();
    }
    return reply_of(ruling.answer, mission.state,
                    warnings_for(order.order));  // nothing to change: nothing to publish
  }
  publish(order);
  return std::nullopt;
}

void OperatorDesk::publish(Order& order) {
  if (order.mission) {
    lay_out(*order.mission);
  }
  if (order.order == OperatorOrder::kStart || order.order == OperatorOrder::kResume) {
    thrust_.make_way();
  }
  const MissionDefinition* definition = at_hand();
  const Time now = now_();
  orders_.publish({order.order, aborts_, definition != nullptr ? definition->id : 0}, now);
  order.sequence = orders_.sequence();
  in_hand_ = order;
  in_hand_->given = now;
}

std::string OperatorDesk::status() {
  const Time now = now_();
  ordered_json reply{{"ok", true}, {"protocol", kCommandProtocol}};
  boat_status_.add_to(reply, now);
  if (commander_.commands(now)) {
    reply["commander"] = {{"name", commander_.name()},
                          {"for_s", to_seconds(now - commander_.link().opened)}};
  }
  reply["tunables"] = json_of(options_.tunables);
  return reply.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

}  // namespace lodesman
