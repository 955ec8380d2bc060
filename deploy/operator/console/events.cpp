// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/console/events.h"

#include <algorithm>

#include "deploy/operator/console/json_values.h"
#include "deploy/operator/console/schemas.h"

namespace lodesman::console {
namespace {

constexpr std::size_t kMaxSaid = 200;  // [characters] of what a client chose

[[nodiscard]] std::string cut(std::string text) {
  if (text.size() > kMaxSaid) {
    text.resize(kMaxSaid);
  }
  return text;
}

[[nodiscard]] std::string details_of(const CommandNews& news) {
  std::string details;
  if (const auto set = news.request.find("set"); set != news.request.end() && set->is_object()) {
    for (const auto& [key, value] : set->items()) {
      details += (details.empty() ? " " : ", ") + key + " = " + text_of(value);
    }
  }
  for (const char* flag : {"force", "release"}) {
    const auto said = news.request.find(flag);
    if (said != news.request.end() && *said == true) {
      details += std::string{" ("} + flag + ")";
    }
  }
  return cut(details);
}

[[nodiscard]] std::string outcome_of(const BoatReply& reply, Severity& severity) {
  if (!reply.is_there) {
    severity = Severity::kWarning;
    return reply.text;
  }
  const Json answer = parsed(reply.text);
  const auto ok = answer.is_object() ? answer.find("ok") : answer.end();
  const bool done = answer.is_object() && ok != answer.end() && *ok == true;
  severity = done ? Severity::kInfo : Severity::kWarning;
  const char* key = done ? "state" : "error";
  const auto said = answer.is_object() ? answer.find(key) : answer.end();
  if (answer.is_object() && said != answer.end() && said->is_string()) {
    return (done ? "done, " : "refused: ") + said->get<std::string>();
  }
  return done ? "done" : "refused";
}

[[nodiscard]] Severity severity_of(MissionState state) noexcept {
  return state == MissionState::kAborted ? Severity::kWarning : Severity::kInfo;
}

[[nodiscard]] Severity severity_of(GuardState state) noexcept {
  const bool acts = state == GuardState::kBraking || state == GuardState::kHolding;
  return acts ? Severity::kCritical : Severity::kInfo;
}

}  // namespace

std::optional<Event> event_of(const CommandNews& news) {
  const bool looks = news.command == "status" ||
                     (news.command == "tune" && news.request.find("set") == news.request.end());
  if (looks || news.command == "heartbeat" || news.command == "manual") {
    return std::nullopt;
  }
  Event event;
  event.who = news.who;
  const std::string outcome = outcome_of(news.reply, event.severity);
  event.text = cut(news.command) + details_of(news) + ": " + outcome;
  return event;
}

Json event_json(const Event& event, Time at, const std::string& utc) {
  return {{"time_s", seconds_of(at)},
          {"wall_time", utc.empty() ? Json(nullptr) : Json(utc)},
          {"text", event.text},
          {"severity", to_string(event.severity)},
          {"who", event.who.empty() ? Json(nullptr) : Json(event.who)}};
}

viewer::Shape event_shape() {
  return named_shape("lodesman.Event", {{"time_s", number_schema("[s] of the boat's own clock")},
                                        {"wall_time", text_schema("ISO 8601, UTC")},
                                        {"text", text_schema("what happened")},
                                        {"severity", text_schema("info, warning or critical")},
                                        {"who", text_schema("ordered it; null: nobody")}});
}

// The first word of each is no change, but where it is grave.
void ChangeWatch::say(std::vector<Event>& events, const std::string& what, const std::string& state,
                      Severity severity) {
  const auto said = said_.find(what);
  const bool is_first = said == said_.end();
  if (!is_first && said->second == state) {
    return;
  }
  said_[what] = state;
  if (!is_first || severity == Severity::kCritical) {
    events.push_back({what + ": " + state, severity, ""});
  }
}

std::vector<Event> ChangeWatch::look(const BoardPicture& picture, bool is_attached) {
  std::vector<Event> events;
  if (!is_attached) {
    if (began_) {
      events.push_back({"the boat's shared memory is gone", Severity::kWarning, ""});
    }
    said_.clear();
    began_ = false;
    return events;
  }
  if (!began_) {
    began_ = true;
    events.push_back({"there is a boat", Severity::kInfo, ""});
  }
  const auto alive = [](bool is) { return is ? "runs" : "does not run"; };
  const auto grave = [](bool is) { return is ? Severity::kInfo : Severity::kCritical; };
  say(events, "lodesman-low", alive(picture.low_alive), grave(picture.low_alive));
  say(events, "lodesman-high", alive(picture.high_alive), grave(picture.high_alive));
  if (picture.mission != nullptr) {
    const MissionStatus& mission = picture.mission->value;
    const bool ordered = mission.cause == MissionCause::kOrder;
    say(events, "mission",
        std::string{to_string(mission.state)} +
            (ordered ? "" : std::string{" ("} + to_string(mission.cause) + ")"),
        severity_of(mission.state));
  }
  if (picture.thrust_status != nullptr) {
    const ThrustStatus& thrust = picture.thrust_status->value;
    say(events, "thrusters",
        std::string{to_string(thrust.state)} + " (" + to_string(thrust.cause) + ")",
        thrust.state == ThrustState::kStopped ? Severity::kWarning : Severity::kInfo);
  }
  if (picture.guard != nullptr) {
    const GuardState state = picture.guard->value.state;
    say(events, "guard", to_string(state), severity_of(state));
  }
  for (std::size_t i = 0; i < kDeviceCount; ++i) {
    if (picture.devices[i] != nullptr) {
      const DeviceHealth& device = picture.devices[i]->value;
      const std::string means = describe(device.fault);
      const bool well = device.status == DeviceStatus::kWorking && means.empty();
      say(events, kDeviceInfo[i].channel,
          std::string{to_string(device.status)} + (means.empty() ? "" : ": " + means),
          well ? Severity::kInfo : Severity::kWarning);
    }
  }
  if (picture.tunables != nullptr) {
    say(events, "settings", "version " + std::to_string(picture.tunables->value.version),
        Severity::kInfo);
  }
  return events;
}

}  // namespace lodesman::console
