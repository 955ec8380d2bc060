// SPDX-License-Identifier: Apache-2.0
#include "high_level/mission/command_line.h"

#include <nlohmann/json.hpp>

namespace lodesman {
namespace {

// The same time for every wrong token, whatever it has right.
[[nodiscard]] bool same_token(const std::string& a, const std::string& b) noexcept {
  unsigned difference = a.size() == b.size() ? 0U : 1U;
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i) {
    difference |= static_cast<unsigned>(a[i] ^ b[i]);
  }
  return difference == 0U;
}

[[nodiscard]] std::string text_of(const nlohmann::json& request, const char* key) {
  const auto found = request.find(key);
  return found != request.end() && found->is_string() ? found->get<std::string>() : "";
}

}  // namespace

CommandLine read_command_line(const std::string& line, const std::string& token) {
  const auto request = nlohmann::json::parse(line, nullptr, false);
  if (!request.is_object() || !request.contains("command") || !request["command"].is_string()) {
    return {"", refusal("a command is a line {\"command\": \"...\", \"token\": \"...\"}")};
  }
  if (request.contains("protocol") && request["protocol"] != kCommandProtocol) {
    return {"", refusal("this is protocol " + std::to_string(kCommandProtocol))};
  }
  if (token.empty() || !same_token(text_of(request, "token"), token)) {
    return {"", refusal("wrong or missing token")};
  }
  return {request["command"].get<std::string>(), ""};
}

std::string refusal(const std::string& reason) {
  return nlohmann::ordered_json{{"ok", false}, {"error", reason}}.dump();
}

bool stops_the_boat(const std::string& command) noexcept { return command == "abort"; }

}  // namespace lodesman
