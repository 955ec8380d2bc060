// SPDX-License-Identifier: Apache-2.0
// One line of the command socket, apart from the socket: what it asks for, and whether it may. Any
// thread. The protocol: docs/wire/command_socket.md.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>

namespace lodesman {

inline constexpr int kCommandProtocol = 2;

// What a token is good for, each for all before it too.
enum class Scope : std::uint8_t { kNone, kView, kAbort, kCommand };

// The tokens of a boat; one that is empty is nobody's.
struct CommandTokens {
  std::string command;
  std::string abort;
  std::string view;
};

// Whether a token is that one, in the same time for every wrong one, whatever it has right.
[[nodiscard]] bool same_token(const std::string& shown, const std::string& token) noexcept;
// What the token shown is good for; kNone where it is none of these.
[[nodiscard]] Scope scope_of(const std::string& shown, const CommandTokens& tokens) noexcept;

struct CommandRequest {
  std::string command;                 // the word
  Scope scope = Scope::kNone;          // of the token shown
  std::uint64_t session = 0;           // > 0, never used again; the socket fills it in
  std::string name;                    // of who asks, for other people; may be empty
  std::optional<std::string> mission;  // the text of a mission file
  std::map<std::string, double> set;   // settings, by their keys in the configuration
  bool force = false;
  bool release = false;          // of the emergency stop
  std::int32_t surge_ref = 0;    // [-] [-100, 100] of the stick
  std::int32_t head_ref = 0;     // [-] [-100, 100]
  bool overrides_guard = false;  // so does the stick
};

// The reply to a command, one JSON document on one line, or nothing yet: then it is asked again a
// few milliseconds later.
using Answer = std::function<std::optional<std::string>()>;
// Is handed what is asked for; what it orders is on its way when it returns.
using CommandHandler = std::function<Answer(const CommandRequest& request)>;

struct CommandLine {
  CommandRequest request;  // if it may be looked at
  std::string refusal;     // else the reply, after which the session ends
};

// What a line {"command": "...", "token": "..."} asks for. It is refused where it is no such line,
// speaks another protocol or lacks a token of the boat's.
[[nodiscard]] CommandLine read_command_line(const std::string& line, const CommandTokens& tokens);

// The same of a line in a session that has proved its token: it shows none.
[[nodiscard]] CommandLine read_command_line(const std::string& line, Scope proved);

// {"ok": false, "error": "..."}
[[nodiscard]] std::string refusal(const std::string& reason);

// Whether it must come through whatever else is asked for.
[[nodiscard]] bool stops_the_boat(const std::string& command) noexcept;

}  // namespace lodesman
