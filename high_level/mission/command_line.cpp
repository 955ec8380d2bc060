// SPDX-License-Identifier: Apache-2.0
#include "high_level/mission/command_line.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace lodesman {
namespace {

constexpr std::size_t kMaxName = 64;

[[nodiscard]] std::optional<std::string> text_of(const nlohmann::json& line, const char* key) {
  const auto found = line.find(key);
  return found != line.end() && found->is_string() ? std::optional{found->get<std::string>()}
                                                   : std::nullopt;
}

[[nodiscard]] bool is_reference(const nlohmann::json& value) {
  return value.is_number_integer() && value >= -100 && value <= 100;
}

// A key of the wrong kind is worse than none: what was meant would not be done.
[[nodiscard]] bool is_well_formed(const nlohmann::json& line) {
  const auto is_number = [](const nlohmann::json& value) { return value.is_number(); };
  return line.is_object() && text_of(line, "command") &&
         (!line.contains("mission") || line["mission"].is_string()) &&
         (!line.contains("name") || line["name"].is_string()) &&
         (!line.contains("force") || line["force"].is_boolean()) &&
         (!line.contains("release") || line["release"].is_boolean()) &&
         (!line.contains("override") || line["override"].is_boolean()) &&
         (!line.contains("surge") || is_reference(line["surge"])) &&
         (!line.contains("head") || is_reference(line["head"])) &&
         (!line.contains("set") ||
          (line["set"].is_object() &&
           std::all_of(line["set"].begin(), line["set"].end(), is_number)));
}

[[nodiscard]] CommandRequest request_of(const nlohmann::json& line, Scope scope) {
  CommandRequest request;
  request.scope = scope;
  request.command = *text_of(line, "command");
  request.name = text_of(line, "name").value_or("").substr(0, kMaxName);
  request.mission = text_of(line, "mission");
  request.force = line.value("force", false);
  request.release = line.value("release", false);
  request.surge_ref = line.value("surge", 0);
  request.head_ref = line.value("head", 0);
  request.overrides_guard = line.value("override", false);
  if (line.contains("set")) {
    for (const auto& [key, value] : line["set"].items()) {
      request.set[key] = value.get<double>();
    }
  }
  return request;
}

// Why a line may not be looked at, whoever sent it; empty where it may.
[[nodiscard]] std::string objection_to(const nlohmann::json& line) {
  if (!is_well_formed(line)) {
    return "a command is a line {\"command\": \"...\", \"token\": \"...\"}";
  }
  if (line.contains("protocol") && line["protocol"] != kCommandProtocol) {
    return "this is protocol " + std::to_string(kCommandProtocol);
  }
  return "";
}

}  // namespace

bool same_token(const std::string& shown, const std::string& token) noexcept {
  unsigned difference = shown.size() == token.size() && !token.empty() ? 0U : 1U;
  for (std::size_t i = 0; i < shown.size() && i < token.size(); ++i) {
    difference |= static_cast<unsigned>(shown[i] ^ token[i]);
  }
  return difference == 0U;
}

Scope scope_of(const std::string& shown, const CommandTokens& tokens) noexcept {
  const bool view = same_token(shown, tokens.view);
  const bool abort = same_token(shown, tokens.abort);
  const bool command = same_token(shown, tokens.command);
  return command ? Scope::kCommand : abort ? Scope::kAbort : view ? Scope::kView : Scope::kNone;
}

CommandLine read_command_line(const std::string& text, const CommandTokens& tokens) {
  const auto line = nlohmann::json::parse(text, nullptr, false);
  if (const std::string objection = objection_to(line); !objection.empty()) {
    return {{}, refusal(objection)};
  }
  const Scope scope = scope_of(text_of(line, "token").value_or(""), tokens);
  if (scope == Scope::kNone) {
    return {{}, refusal("wrong or missing token")};
  }
  return {request_of(line, scope), ""};
}

CommandLine read_command_line(const std::string& text, Scope proved) {
  const auto line = nlohmann::json::parse(text, nullptr, false);
  if (const std::string objection = objection_to(line); !objection.empty()) {
    return {{}, refusal(objection)};
  }
  if (line.contains("token")) {
    return {{}, refusal("a token is never sent where it was proved: take it for known to others")};
  }
  return {request_of(line, proved), ""};
}

std::string refusal(const std::string& reason) {
  return nlohmann::ordered_json{{"ok", false}, {"error", reason}}.dump(
      -1, ' ', false, nlohmann::json::error_handler_t::replace);
}

bool stops_the_boat(const std::string& command) noexcept {
  return command == "abort" || command == "estop";
}

}  // namespace lodesman
