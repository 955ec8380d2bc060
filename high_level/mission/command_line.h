// SPDX-License-Identifier: Apache-2.0
// One line of the command socket, apart from the socket: what it asks for, and whether it may. Any
// thread.
#pragma once

#include <functional>
#include <string>

namespace lodesman {

// Is handed the word of "command" and gives the reply, one JSON document on one line.
using CommandHandler = std::function<std::string(const std::string& command)>;

// The reply to a line {"command": "...", "token": "..."}: the handler's, or {"ok": false, "error":
// "..."} where the line is no command or lacks the token. An empty `token` asks for none.
[[nodiscard]] std::string reply_to(const std::string& line, const std::string& token,
                                   const CommandHandler& handler);

}  // namespace lodesman
