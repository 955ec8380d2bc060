// SPDX-License-Identifier: Apache-2.0
// One line of the command socket, apart from the socket: what it asks for, and whether it may. Any
// thread. The protocol: docs/wire/command_socket.md.
#pragma once

#include <functional>
#include <optional>
#include <string>

namespace lodesman {

inline constexpr int kCommandProtocol = 1;

// The reply to a command, one JSON document on one line, or nothing yet: then it is asked again a
// few milliseconds later.
using Answer = std::function<std::optional<std::string>()>;
// Is handed the word of "command"; what it orders is on its way when it returns.
using CommandHandler = std::function<Answer(const std::string& command)>;

struct CommandLine {
  std::string command;  // the word, if it may be obeyed
  std::string refusal;  // else the reply, after which the session ends
};

// What a line {"command": "...", "token": "..."} asks for. It is refused where it is no such line,
// speaks another protocol or lacks the token; an empty `token` is nobody's.
[[nodiscard]] CommandLine read_command_line(const std::string& line, const std::string& token);

// {"ok": false, "error": "..."}
[[nodiscard]] std::string refusal(const std::string& reason);

// Whether it must come through whatever else is asked for.
[[nodiscard]] bool stops_the_boat(const std::string& command) noexcept;

}  // namespace lodesman
