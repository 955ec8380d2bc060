// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/console/client.h"

#include <algorithm>

#include "deploy/operator/console/json_values.h"

namespace lodesman::console {
namespace {

constexpr std::size_t kMaxName = 64;  // [bytes] as the command socket has it

// What ends thrust, and does no harm when it is said twice.
[[nodiscard]] bool is_urgent(const std::string& command, const Json& request) {
  const auto release = request.find("release");
  const bool releases = release != request.end() && *release == true;
  return (stops_the_boat(command) || command == "disarm") && !releases;
}

}  // namespace

bool RateLimit::allows(Time now) noexcept {
  const double since_s = std::max(0.0, to_seconds(now - counted_));
  left_ = std::min(per_second_, left_ + since_s * per_second_);
  counted_ = now;
  if (left_ < 1.0) {
    return false;
  }
  left_ -= 1.0;
  return true;
}

Client::Client(std::uint64_t number, const ClientRights& rights, TopicTable& topics,
               const Pulse& pulse)
    : number_{number},
      rights_{rights},
      topics_{topics},
      pulse_{pulse},
      name_{"viewer " + std::to_string(number)} {}

Client::~Client() { leave(); }

void Client::leave() {
  is_over_ = true;
  on_work = nullptr;
  on_command = nullptr;
  on_listener = nullptr;
  urgent_.reset();
  port_.reset();
  for (const auto& [id, subscription] : subscriptions_) {
    --topics_[subscription.topic].listeners;
  }
  subscriptions_.clear();
  replies_.clear();
}

void Client::set_ports(std::unique_ptr<CommandPort> port, std::unique_ptr<CommandPort> urgent) {
  port_ = std::move(port);
  urgent_ = std::move(urgent);
}

void Client::wake() const {
  if (on_work) {
    on_work();
  }
}

void Client::end() {
  is_over_ = true;
  wake();
}

void Client::reply(Frame frame) {
  if (replies_.size() >= kMaxReplies) {
    end();  // it asks and never takes
    return;
  }
  replies_.push_back(std::move(frame));
  wake();
}

void Client::greet(const std::string& boat, const std::string& console) {
  reply({true, foxglove::server_info(boat, console, rights_.may_ask), nullptr});
  reply({true, foxglove::advertise(topics_), nullptr});
  if (rights_.may_ask) {
    reply({true, foxglove::advertise_services(), nullptr});
  }
}

void Client::hear(bool is_text, std::string_view bytes, Time now) {
  if (is_over_) {
    return;
  }
  if (is_text) {
    hear_text(bytes, now);
  } else if (const auto call = foxglove::read_call(bytes)) {
    hear_call(*call, now);
  } else if (!texts_.allows(now)) {
    end();
  } else {
    reply({true, foxglove::status(foxglove::StatusLevel::kError, "not understood"), nullptr});
  }
}

void Client::hear_text(std::string_view bytes, Time now) {
  if (!texts_.allows(now)) {
    end();
    return;
  }
  const foxglove::ClientText text = foxglove::read_text(bytes);
  if (!text.is_understood) {
    reply({true, foxglove::status(foxglove::StatusLevel::kError, "not understood"), nullptr});
  }
  for (const std::uint32_t id : text.unsubscribe) {
    unsubscribe(id);
  }
  for (const auto& asked : text.subscribe) {
    subscribe(asked.id, asked.channel);
  }
}

void Client::subscribe(std::uint32_t id, std::uint32_t channel) {
  if (channel == 0 || channel > topics_.size() || subscriptions_.size() >= kMaxSubscriptions ||
      subscriptions_.count(id) > 0) {
    reply({true, foxglove::status(foxglove::StatusLevel::kWarning, "no such channel is to be had"),
           nullptr});
    return;
  }
  const auto topic = static_cast<std::uint16_t>(channel - 1);
  Subscription& subscription = subscriptions_[id];
  subscription.topic = topic;
  ++topics_[topic].listeners;
  topics_[topic].kept.for_each([&](const std::string& part, const MessagePtr& message) {
    subscription.waiting.put(part, message);
  });
  if (on_listener) {
    on_listener(topic);
  }
  wake();
}

void Client::unsubscribe(std::uint32_t id) {
  const auto found = subscriptions_.find(id);
  if (found != subscriptions_.end()) {
    --topics_[found->second.topic].listeners;
    subscriptions_.erase(found);
  }
}

bool Client::listens_to(std::uint16_t topic) const {
  return std::any_of(subscriptions_.begin(), subscriptions_.end(),
                     [&](const auto& entry) { return entry.second.topic == topic; });
}

void Client::fail(const foxglove::ServiceCall& call, const std::string& why) {
  reply({true, foxglove::call_failure(call.service, call.call, why), nullptr});
}

void Client::hear_call(const foxglove::ServiceCall& call, Time now) {
  if (!commands_.allows(now)) {
    if (!texts_.allows(now)) {
      end();
      return;
    }
    return fail(call, "too many commands");
  }
  if (call.service != foxglove::kCommandService || call.encoding != "json") {
    return fail(call, "there is no such service");
  }
  if (!rights_.may_ask || port_ == nullptr || urgent_ == nullptr) {
    return fail(call, "this session may only look on");
  }
  Json request = parsed(call.payload);
  const auto word = request.is_object() ? request.find("command") : request.end();
  if (!request.is_object() || word == request.end() || !word->is_string()) {
    return fail(call, "a command is an object with the word \"command\"");
  }
  if (calls_ >= kMaxCalls) {
    return fail(call, "too many commands are under way");
  }
  const std::string command = word->get<std::string>();
  if (pulse_.is_held_up(now) && !stops_the_boat(command)) {
    return fail(call, "the console was held up, and this may be of a while ago: order it again");
  }
  request.erase("token");
  request.erase("protocol");
  if (command == "take" && request.contains("name") && request["name"].is_string()) {
    name_ = request["name"].get<std::string>().substr(0, kMaxName);
  }
  ++calls_;
  CommandPort& port = is_urgent(command, request) ? *urgent_ : *port_;
  port.ask(text_of(request),
           [this, service = call.service, number = call.call, request](const BoatReply& answer) {
             answered(service, number, answer, request);
           });
}

void Client::answered(std::uint32_t service, std::uint32_t call, const BoatReply& answer,
                      const Json& request) {
  --calls_;
  if (on_command) {
    on_command({name_, request["command"].get<std::string>(), request, answer});
  }
  if (answer.is_there) {
    reply({false, foxglove::call_response(service, call, answer.text), nullptr});
  } else {
    reply({true, foxglove::call_failure(service, call, answer.text), nullptr});
  }
}

void Client::offer(std::uint16_t topic, const std::string& part, const MessagePtr& message) {
  bool offered = false;
  for (auto& [id, subscription] : subscriptions_) {
    if (subscription.topic == topic) {
      subscription.waiting.put(part, message);
      offered = true;
    }
  }
  if (offered) {
    wake();
  }
}

std::optional<Frame> Client::take() {
  if (!replies_.empty()) {
    Frame frame = std::move(replies_.front());
    replies_.pop_front();
    return frame;
  }
  // In turn, so that no topic keeps another waiting.
  auto next = subscriptions_.upper_bound(last_served_);
  for (std::size_t i = 0; i < subscriptions_.size(); ++i, ++next) {
    next = next == subscriptions_.end() ? subscriptions_.begin() : next;
    if (!next->second.waiting.empty()) {
      last_served_ = next->first;
      MessagePtr message = next->second.waiting.take();
      return Frame{false, foxglove::message_head(next->first, message->stamp), message};
    }
  }
  return std::nullopt;
}

}  // namespace lodesman::console
