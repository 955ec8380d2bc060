// SPDX-License-Identifier: Apache-2.0
#include "high_level/mission/command_line.h"

#include <nlohmann/json.hpp>

namespace lodesman {
namespace {

[[nodiscard]] std::string refusal(const std::string& reason) {
  return nlohmann::json{{"ok", false}, {"error", reason}}.dump();
}

// The same time for every wrong token, whatever it has right.
[[nodiscard]] bool same_token(const std::string& a, const std::string& b) noexcept {
  unsigned difference = a.size() == b.size() ? 0U : 1U;
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i) {
    difference |= static_cast<unsigned>(a[i] ^ b[i]);
  }
  return difference == 0U;
}

}  // namespace

std::string reply_to(const std::string& line, const std::string& token,
                     const CommandHandler& handler) {
  const auto request = nlohmann::json::parse(line, nullptr, false);
  if (!request.is_object() || !request.contains("command") || !request["command"].is_string()) {
    return refusal("a command is a line {\"command\": \"...\"}");
  }
  const auto found = request.find("token");
  const std::string given =
      found != request.end() && found->is_string() ? found->get<std::string>() : "";
  if (!token.empty() && !same_token(given, token)) {
    return refusal("wrong or missing token");
  }
  return handler(request["command"].get<std::string>());
}

}  // namespace lodesman
