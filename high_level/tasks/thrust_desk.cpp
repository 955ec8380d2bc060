// SPDX-License-Identifier: Apache-2.0
#include "high_level/tasks/thrust_desk.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

namespace lodesman {
namespace {

using nlohmann::ordered_json;

constexpr Duration kPatience = std::chrono::seconds{2};

[[nodiscard]] std::string done(const ThrustStatus& status) {
  return ordered_json{{"ok", true}, {"state", to_string(status.state)}}.dump();
}

[[nodiscard]] std::string not_confirmed() {
  return ordered_json{{"ok", false},
                      {"error", "not confirmed: the thruster task does not answer"},
                      {"confirmed", false}}
      .dump();
}

[[nodiscard]] std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) {
    text += (text.empty() ? "" : "; ") + part;
  }
  return text;
}

[[nodiscard]] ThrustOrderKind kind_of(const CommandRequest& request) noexcept {
  return request.command == "arm"      ? ThrustOrderKind::kArm
         : request.command == "disarm" ? ThrustOrderKind::kDisarm
         : request.release             ? ThrustOrderKind::kRelease
                                       : ThrustOrderKind::kStop;
}

[[nodiscard]] const char* meaning(ArmObjection objection) noexcept {
  switch (objection) {
    case ArmObjection::kStopped: return "the emergency stop is latched (lodesman estop --release)";
    case ArmObjection::kNoThrusters: return "the configuration has no thrusters";
    case ArmObjection::kBoxGone: return "the thruster box is gone";
    case ArmObjection::kBoxNotReady: return "the thruster box is not ready";
    case ArmObjection::kHighSilent: return "the controller is silent";
    case ArmObjection::kHelmNotAtRest: return "the helm asks for thrust already (lodesman abort)";
    case ArmObjection::kStickNotAtRest: return "the stick asks for thrust already";
    case ArmObjection::kBatteryCritical: return "the battery is all but empty";
  }
  return "";
}

}  // namespace

std::vector<std::string> in_words(std::uint32_t objections, const DeviceHealth* box) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < kArmObjectionCount; ++i) {
    const auto objection = static_cast<ArmObjection>(i);
    if ((objections & bit(objection)) == 0) {
      continue;
    }
    std::string text = meaning(objection);
    const bool is_the_box =
        objection == ArmObjection::kBoxGone || objection == ArmObjection::kBoxNotReady;
    if (is_the_box && box != nullptr && box->fault != DeviceFault::kNone) {
      text += ": " + std::string{describe(box->fault)};
    }
    words.push_back(std::move(text));
  }
  return words;
}

ThrustDesk::ThrustDesk(Blackboard& board, Role role, bool arms_by_itself, Now now)
    : arms_by_itself_{arms_by_itself},
      now_{std::move(now)},
      made_{now_()},
      orders_{writer_of(board, board.thrust_order, role)},
      stick_{writer_of(board, board.manual_input, role)},
      status_{board.thrust_status},
      mission_{board.mission_status},
      device_{board.device_health[static_cast<std::size_t>(DeviceId::kThrusters)]} {
  // Goes on counting where a program that was here before has left off.
  Reader<ThrustOrder> before{board.thrust_order};
  if (const auto* last = before.latest(); last != nullptr) {
    stops_ = last->value.stops;
  }
}

const ThrustStatus* ThrustDesk::status() {
  const auto* newest = status_.fresh(now_(), max_age::kThrustStatus);
  return newest != nullptr ? &newest->value : nullptr;
}

bool ThrustDesk::is_armed() {
  const ThrustStatus* now = status();
  return now != nullptr &&
         (now->state == ThrustState::kArmed || now->state == ThrustState::kManual);
}

void ThrustDesk::hear() {
  const ThrustStatus* newest = status();
  if (newest != nullptr) {
    stops_ = std::max(stops_, newest->stops);
  }
  if (in_hand_ != 0 &&
      ((newest != nullptr && newest->order >= in_hand_) || now_() - in_hand_since_ > kPatience)) {
    in_hand_ = 0;
  }
}

void ThrustDesk::publish(Order& order) {
  orders_.publish({order.kind, order.stops}, order.given);
  order.sequence = orders_.sequence();
  in_hand_ = order.sequence;
  in_hand_since_ = now_();
}

Answer ThrustDesk::order(const CommandRequest& request) {
  hear();
  Order order{kind_of(request), now_(), stops_};
  if (order.kind == ThrustOrderKind::kStop) {
    order.stops = ++stops_;
    publish(order);
  } else if (order.kind == ThrustOrderKind::kDisarm) {
    publish(order);
  }
  return [this, order]() mutable { return reply_to(order); };
}

// One that is answered by a later sequence was overtaken by what makes safe.
std::optional<std::string> ThrustDesk::reply_to(Order& order) {
  hear();
  const ThrustStatus* newest = status();
  if (newest != nullptr && order.sequence != 0 && newest->order >= order.sequence) {
    return reply_of(order, *newest);
  }
  if (now_() - order.given > kPatience) {
    return not_confirmed();
  }
  if (order.sequence == 0 && in_hand_ == 0) {
    publish(order);
  }
  return std::nullopt;
}

std::string ThrustDesk::reply_of(const Order& order, const ThrustStatus& status) {
  if (order.kind == ThrustOrderKind::kStop || order.kind == ThrustOrderKind::kDisarm) {
    return done(status);
  }
  if (order.stops < status.stops || status.order > order.sequence) {
    return refusal("a stop came first");
  }
  const auto* box = device_.latest();
  switch (status.answer) {
    case ThrustAnswer::kObeyed: return done(status);
    case ThrustAnswer::kRefused:
      return refusal(joined(in_words(status.refused_for, box != nullptr ? &box->value : nullptr)));
    case ThrustAnswer::kNotStopped:
      return refusal(std::string{"not stopped but "} + to_string(status.state));
    case ThrustAnswer::kNotArmed:
      return refusal(std::string{"not armed but "} + to_string(status.state));
    case ThrustAnswer::kStopCame: return refusal("a stop came first");
    case ThrustAnswer::kTooOld:
    case ThrustAnswer::kNone: break;
  }
  return not_confirmed();
}

std::optional<std::string> ThrustDesk::move_stick(const CommandRequest& request) {
  const ThrustStatus* newest = status();
  if (newest == nullptr) {
    return "the low level is silent";
  }
  if (newest->state != ThrustState::kArmed && newest->state != ThrustState::kManual) {
    return std::string{"the thrusters are "} + to_string(newest->state);
  }
  const auto* mission = mission_.latest();
  if (mission != nullptr && mission->value.state == MissionState::kAborted &&
      mission->value.ended >= newest->armed) {
    return "an abort stands: arm again first";
  }
  stick_.publish({request.surge_ref, request.head_ref, request.overrides_guard}, now_());
  return std::nullopt;
}

void ThrustDesk::make_way() {
  hear();
  const ThrustStatus* newest = status();
  if (newest == nullptr) {
    return;
  }
  Order order{ThrustOrderKind::kToMission, now_(), stops_};
  if (newest->state == ThrustState::kManual) {
    publish(order);
  } else if (newest->state == ThrustState::kDisarmed && arms_by_itself_ &&
             newest->objections == 0) {
    order.kind = ThrustOrderKind::kArm;
    publish(order);
    way_ = order;
  }
}

// It counts from when it was first given: a helm that asks for thrust since does so for the
// mission.
void ThrustDesk::look() {
  hear();
  const ThrustStatus* newest = status();
  if (!way_ || in_hand_ != 0 || newest == nullptr) {
    return;
  }
  const bool was_refused = newest->order == way_->sequence &&
                           newest->answer == ThrustAnswer::kRefused &&
                           newest->state == ThrustState::kDisarmed && stops_ == way_->stops;
  if (!was_refused || now_() - way_->given > kPatience) {
    way_.reset();
  } else if ((newest->objections & ~bit(ArmObjection::kHelmNotAtRest)) == 0) {
    publish(*way_);
  }
}

}  // namespace lodesman
