// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/console/foxglove.h"

#include <algorithm>
#include <array>

#include "deploy/operator/console/json_values.h"

namespace lodesman::console::foxglove {
namespace {

// The first that a client offers too is spoken.
constexpr std::array<std::string_view, 2> kSubprotocols{"foxglove.sdk.v1", "foxglove.websocket.v1"};
// Of binary messages.
constexpr char kMessageData = 1;
constexpr char kServiceCallRequest = 2;
constexpr char kServiceCallResponse = 3;
constexpr std::size_t kCallHead_bytes = 13;
constexpr std::size_t kMaxListed = 256;  // of one text's subscriptions

void put(std::string& to, std::uint64_t number, std::size_t bytes) {
  for (std::size_t i = 0; i < bytes; ++i) {
    to += static_cast<char>(number >> (8 * i) & 0xffU);
  }
}

[[nodiscard]] std::uint32_t number_at(std::string_view bytes, std::size_t place) noexcept {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    number |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[place + i])) << (8 * i);
  }
  return number;
}

[[nodiscard]] std::optional<std::uint32_t> number_of(const Json& json) {
  if (!json.is_number_unsigned() || json.get<std::uint64_t>() > UINT32_MAX) {
    return std::nullopt;
  }
  return json.get<std::uint32_t>();
}

[[nodiscard]] const Json* member(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

void read_subscriptions(const Json& text, ClientText& read) {
  const Json* list = member(text, "subscriptions");
  if (list == nullptr || !list->is_array() || list->size() > kMaxListed) {
    return;
  }
  for (const Json& asked : *list) {
    if (!asked.is_object()) {
      continue;
    }
    const Json* id = member(asked, "id");
    const Json* channel = member(asked, "channelId");
    const auto id_number = id != nullptr ? number_of(*id) : std::nullopt;
    const auto channel_number = channel != nullptr ? number_of(*channel) : std::nullopt;
    if (id_number && channel_number) {
      read.subscribe.push_back({*id_number, *channel_number});
    }
  }
}

void read_unsubscriptions(const Json& text, ClientText& read) {
  const Json* list = member(text, "subscriptionIds");
  if (list == nullptr || !list->is_array() || list->size() > kMaxListed) {
    return;
  }
  for (const Json& id : *list) {
    if (const auto number = number_of(id)) {
      read.unsubscribe.push_back(*number);
    }
  }
}

}  // namespace

std::string subprotocol_of(std::string_view offered) {
  constexpr std::string_view kBlank = " \t,";
  std::vector<std::string_view> words;
  for (std::size_t from = offered.find_first_not_of(kBlank); from != std::string_view::npos;) {
    const std::size_t to = std::min(offered.find_first_of(kBlank, from), offered.size());
    words.push_back(offered.substr(from, to - from));
    from = offered.find_first_not_of(kBlank, to);
  }
  for (const std::string_view known : kSubprotocols) {
    if (std::find(words.begin(), words.end(), known) != words.end()) {
      return std::string{known};
    }
  }
  return {};
}

std::string server_info(const std::string& name, const std::string& session, bool has_services) {
  Json capabilities = Json::array();
  if (has_services) {
    capabilities.push_back("services");
  }
  return text_of({{"op", "serverInfo"},
                  {"name", name},
                  {"capabilities", capabilities},
                  {"supportedEncodings", Json::array({"json"})},
                  {"metadata", Json::object()},
                  {"sessionId", session}});
}

std::string advertise(const TopicTable& topics) {
  Json channels = Json::array();
  for (std::size_t i = 0; i < topics.size(); ++i) {
    const auto& topic = topics[static_cast<std::uint16_t>(i)];
    channels.push_back({{"id", i + 1},
                        {"topic", topic.name},
                        {"encoding", "json"},
                        {"schemaName", topic.schema_name},
                        {"schema", topic.schema},
                        {"schemaEncoding", "jsonschema"}});
  }
  return text_of({{"op", "advertise"}, {"channels", channels}});
}

std::string advertise_services() {
  const auto side = [](const char* name, const char* description) -> Json {
    const Json schema{{"title", name}, {"type", "object"}, {"description", description}};
    return {{"encoding", "json"},
            {"schemaName", name},
            {"schemaEncoding", "jsonschema"},
            {"schema", schema.dump()}};
  };
  const Json command{
      {"id", kCommandService},
      {"name", kCommandServiceName},
      {"type", "lodesman.Command"},
      {"request",
       side("lodesman.CommandRequest", "a line of the command socket without token and protocol")},
      {"response", side("lodesman.CommandReply", "the command socket's reply to it")}};
  return text_of({{"op", "advertiseServices"}, {"services", Json::array({command})}});
}

std::string status(StatusLevel level, const std::string& message) {
  return text_of({{"op", "status"}, {"level", static_cast<unsigned>(level)}, {"message", message}});
}

std::string call_failure(std::uint32_t service, std::uint32_t call, const std::string& message) {
  return text_of({{"op", "serviceCallFailure"},
                  {"serviceId", service},
                  {"callId", call},
                  {"message", message}});
}

std::string message_head(std::uint32_t subscription, Time stamp) {
  std::string head{kMessageData};
  put(head, subscription, 4);
  put(head, static_cast<std::uint64_t>(stamp.time_since_epoch().count()), 8);
  return head;
}

std::string call_response(std::uint32_t service, std::uint32_t call, std::string_view json) {
  constexpr std::string_view kEncoding = "json";
  std::string response{kServiceCallResponse};
  put(response, service, 4);
  put(response, call, 4);
  put(response, kEncoding.size(), 4);
  response += kEncoding;
  response += json;
  return response;
}

ClientText read_text(std::string_view text) {
  ClientText read;
  const Json said = parsed(text);
  if (!said.is_object()) {
    return read;
  }
  const Json* op = member(said, "op");
  if (op == nullptr || !op->is_string()) {
    return read;
  }
  read.is_understood = true;
  if (*op == "subscribe") {
    read_subscriptions(said, read);
  } else if (*op == "unsubscribe") {
    read_unsubscriptions(said, read);
  }
  return read;
}

std::optional<ServiceCall> read_call(std::string_view bytes) {
  if (bytes.size() < kCallHead_bytes || bytes[0] != kServiceCallRequest) {
    return std::nullopt;
  }
  const std::size_t encoding = number_at(bytes, 9);
  if (encoding > bytes.size() - kCallHead_bytes) {
    return std::nullopt;
  }
  return ServiceCall{number_at(bytes, 1), number_at(bytes, 5),
                     bytes.substr(kCallHead_bytes, encoding),
                     bytes.substr(kCallHead_bytes + encoding)};
}

}  // namespace lodesman::console::foxglove
