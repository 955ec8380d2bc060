// SPDX-License-Identifier: Apache-2.0
#include "high_level/tasks/desk_replies.h"

#include <nlohmann/json.hpp>

#include "high_level/mission/command_line.h"

namespace lodesman {

std::string done(MissionState state, const std::vector<std::string>& warnings) {
  nlohmann::ordered_json reply{{"ok", true}, {"state", to_string(state)}};
  if (!warnings.empty()) {
    reply["warnings"] = warnings;
  }
  return reply.dump();
}

std::string not_confirmed(const std::string& reason) {
  return nlohmann::ordered_json{
      {"ok", false}, {"error", "not confirmed: " + reason}, {"confirmed", false}}
      .dump();
}

std::string reply_of(OrderAnswer answer, MissionState state,
                     const std::vector<std::string>& warnings) {
  switch (answer) {
    case OrderAnswer::kObeyed: return done(state, warnings);
    case OrderAnswer::kNotUnderWay:
      return refusal(std::string{"not under way but "} + to_string(state));
    case OrderAnswer::kNotHolding:
      return refusal(std::string{"not holding but "} + to_string(state));
    case OrderAnswer::kAborted: return refusal("an abort came first");
    case OrderAnswer::kNoMission: return refusal("there is no mission: give one");
    case OrderAnswer::kTooOld:
    case OrderAnswer::kNone: break;
  }
  return not_confirmed("the mission did not take it up in time");
}

}  // namespace lodesman
