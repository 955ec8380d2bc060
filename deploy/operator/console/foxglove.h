// SPDX-License-Identifier: Apache-2.0
// The Foxglove WebSocket protocol, as far as the console speaks it: what is said, and what of a
// client's bytes can be understood. Pure functions on bytes that may be anything; any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "deploy/operator/console/topics.h"

namespace lodesman::console::foxglove {

// The one to speak of those that a client offers in Sec-WebSocket-Protocol; empty where none fits.
[[nodiscard]] std::string subprotocol_of(std::string_view offered);

// Number of a service, and what it is called.
inline constexpr std::uint32_t kCommandService = 1;
inline constexpr const char* kCommandServiceName = "/lodesman/command";

[[nodiscard]] std::string server_info(const std::string& name, const std::string& session,
                                      bool has_services);
// A channel's number is its topic's and one.
[[nodiscard]] std::string advertise(const TopicTable& topics);
[[nodiscard]] std::string advertise_services();
enum class StatusLevel : std::uint8_t { kInfo, kWarning, kError };
[[nodiscard]] std::string status(StatusLevel level, const std::string& message);
[[nodiscard]] std::string call_failure(std::uint32_t service, std::uint32_t call,
                                       const std::string& message);

// What stands before a message's JSON.
[[nodiscard]] std::string message_head(std::uint32_t subscription, Time stamp);
// A whole reply to a call.
[[nodiscard]] std::string call_response(std::uint32_t service, std::uint32_t call,
                                        std::string_view json);

// Of a client's text: what it asks for, of what is known here; unknown words are let be.
struct ClientText {
  struct Subscription {
    std::uint32_t id = 0;
    std::uint32_t channel = 0;
  };
  bool is_understood = false;  // else it is no such text, and `subscribe` and so on are empty
  std::vector<Subscription> subscribe;
  std::vector<std::uint32_t> unsubscribe;
};
[[nodiscard]] ClientText read_text(std::string_view text);

struct ServiceCall {
  std::uint32_t service = 0;
  std::uint32_t call = 0;
  std::string_view encoding;
  std::string_view payload;
};
// Points into `bytes`. Nothing where it is no call.
[[nodiscard]] std::optional<ServiceCall> read_call(std::string_view bytes);

}  // namespace lodesman::console::foxglove
