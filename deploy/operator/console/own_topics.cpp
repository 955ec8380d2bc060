// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/console/own_topics.h"

#include <algorithm>

#include "deploy/operator/console/boat_json.h"
#include "deploy/operator/console/json_values.h"
#include "deploy/operator/console/schemas.h"
#include "deploy/operator/console/sonar_json.h"
#include "deploy/operator/console/story.h"
#include "deploy/operator/console/utc_text.h"

namespace lodesman::console {
namespace {

constexpr Duration kTenthSecond = std::chrono::milliseconds{100};
constexpr Duration kFifthSecond = std::chrono::milliseconds{200};
constexpr Duration kHalfSecond = std::chrono::milliseconds{500};
constexpr Duration kSecond = std::chrono::seconds{1};

template <class T>
[[nodiscard]] std::uint64_t number_of(const Stamped<T>* value) noexcept {
  return value != nullptr ? value->sequence : 0;
}

[[nodiscard]] viewer::Shape clients_shape() {
  const Json commander = object_schema(
      "lodesman.Commander", {{"name", text_schema("as it said")}, {"for_s", number_schema("[s]")}});
  const Json you = object_schema("lodesman.You", {{"scope", text_schema("command, abort or view")},
                                                  {"name", text_schema("as others see it")}});
  return named_shape(
      "lodesman.Clients",
      {{"clients", number_schema("[-] that look on")}, {"commander", commander}, {"you", you}});
}

}  // namespace

OwnTopics::OwnTopics(const OwnOptions& options, TopicTable& topics, const BoardFeed& feed,
                     const Clients& clients, std::unique_ptr<CommandPort> status)
    : options_{options},
      topics_{topics},
      feed_{feed},
      clients_{clients},
      boat_{topics.add_topic("/lodesman/boat", boat_shape()), kTenthSecond},
      world_{topics.add_topic("/lodesman/world", world_shape()), kTenthSecond},
      coverage_{topics.add_topic("/lodesman/coverage", coverage_shape()), kSecond},
      sonar_{topics.add_topic("/lodesman/sonar", sonar_shape()), kFifthSecond},
      status_{
          topics.add_topic("/lodesman/status",
                           open_shape("lodesman.Status", "the command socket's reply to status")),
          kHalfSecond},
      story_{topics.add_topic("/lodesman/story", story_shape()), kFifthSecond},
      who_{topics.add_topic("/lodesman/clients", clients_shape()), kFifthSecond},
      events_{topics.add_topic("/lodesman/events", event_shape())},
      status_port_{std::move(status)} {}

void OwnTopics::listener(std::uint16_t topic) {
  for (Paced* paced : {&boat_, &world_, &coverage_, &sonar_, &status_, &story_, &who_}) {
    if (paced->topic == topic) {
      paced->due = {};
      paced->shown.clear();
    }
  }
  if (topic == story_.topic) {
    told_story_.clear();
  }
  if (topic == who_.topic) {
    told_clients_.clear();
  }
}

void OwnTopics::tell(const Event& event) {
  topics_.publish(events_, std::to_string(event_count_++ % kKeptEvents), now_,
                  text_of(event_json(event, now_, utc_text())));
}

// Keeps its phase; after a pause it begins anew.
bool OwnTopics::is_due(Paced& paced, Time now) const {
  if (topics_[paced.topic].listeners == 0 || now < paced.due) {
    return false;
  }
  paced.due = now - paced.due < paced.period ? paced.due + paced.period : now + paced.period;
  return true;
}

void OwnTopics::step(Time now) {
  now_ = now;
  for (const Event& event : changes_.look(feed_.picture(), feed_.is_attached())) {
    tell(event);
  }
  step_boat(now);
  step_world(now);
  step_coverage(now);
  step_sonar(now);
  step_status(now);
  step_story(now);
  step_clients(now);
}

void OwnTopics::step_boat(Time now) {
  if (is_due(boat_, now)) {
    topics_.publish(boat_.topic, "", now, text_of(boat_json(feed_.picture(), utc_text())));
  }
}

void OwnTopics::step_world(Time now) {
  const BoardPicture& picture = feed_.picture();
  const MissionStatus mission =
      picture.mission != nullptr ? picture.mission->value : MissionStatus{};
  std::vector<std::uint64_t> made_of{
      number_of(picture.tracks),
      picture.tracks == nullptr ? number_of(picture.obstacles) : 0,
      number_of(picture.request),
      number_of(picture.plan),
      number_of(picture.definition),
      mission.mission,
      static_cast<std::uint64_t>(mission.started.time_since_epoch().count()),
      mission.goal_index,
      mission.keeps_line ? 1U : 0U};
  if (made_of != world_.shown && is_due(world_, now)) {
    world_.shown = std::move(made_of);
    topics_.publish(world_.topic, "", now, text_of(world_json(picture, options_.hull)));
  }
}

void OwnTopics::step_coverage(Time now) {
  const auto* coverage = feed_.picture().coverage;
  if (coverage != nullptr && coverage_.shown != std::vector{coverage->sequence} &&
      is_due(coverage_, now)) {
    coverage_.shown = {coverage->sequence};
    topics_.publish(coverage_.topic, "", now, text_of(coverage_json(*coverage)));
  }
}

void OwnTopics::step_sonar(Time now) {
  const BoardPicture& picture = feed_.picture();
  if (picture.ping != nullptr && sonar_.shown != std::vector{picture.ping->sequence} &&
      is_due(sonar_, now)) {
    sonar_.shown = {picture.ping->sequence};
    topics_.publish(sonar_.topic, "", now,
                    text_of(sonar_json(picture, options_.min_range_m, drawer_)));
  }
}

void OwnTopics::step_story(Time now) {
  if (!is_due(story_, now)) {
    return;
  }
  std::string text = text_of(story_json(feed_.picture(), feed_.absence()));
  if (text != told_story_) {
    topics_.publish(story_.topic, "", now, text);
    told_story_ = std::move(text);
  }
}

// Each is told who it is itself.
void OwnTopics::step_clients(Time now) {
  if (!is_due(who_, now)) {
    return;
  }
  Json all{{"clients", clients_.size()}, {"commander", commander_}};
  std::string changed = std::to_string(clients_.size()) + "/";
  if (commander_.is_object()) {
    changed += text_of(commander_["name"]);
  }
  for (const auto& client : clients_) {
    changed += "/" + client->name();
  }
  if (changed == told_clients_) {
    return;
  }
  told_clients_ = changed;
  for (const auto& client : clients_) {
    if (client->listens_to(who_.topic)) {
      all["you"] = {{"scope", scope_word(client->rights().scope)}, {"name", client->name()}};
      client->offer(who_.topic, "", std::make_shared<const Message>(Message{now, text_of(all)}));
    }
  }
}

// The story and the list of viewers rest on it too.
void OwnTopics::step_status(Time now) {
  const bool wanted = topics_[status_.topic].listeners + topics_[who_.topic].listeners > 0;
  if (wanted && !awaits_status_ && now >= status_.due) {
    status_.due = now + status_.period;
    awaits_status_ = true;
    status_port_->ask(R"({"command":"status"})", [this](const BoatReply& reply) {
      awaits_status_ = false;
      heard_status(reply);
    });
  }
}

void OwnTopics::heard_status(const BoatReply& reply) {
  std::string text = reply.text;
  const Json status = reply.is_there ? parsed(text) : Json{};
  commander_ = nullptr;
  if (status.is_object()) {
    const auto commander = status.find("commander");
    if (commander != status.end() && commander->is_object() && commander->contains("name")) {
      commander_ = *commander;
    }
  } else {
    const std::string absence = feed_.is_attached() ? "" : feed_.absence() + "; ";
    text = text_of({{"ok", false}, {"error", absence + reply.text}});
  }
  topics_.publish(status_.topic, "", now_, text);
}

}  // namespace lodesman::console
