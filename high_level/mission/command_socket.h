// SPDX-License-Identifier: Apache-2.0
// The operator's way in: JSON lines over TCP. On loopback each shows a token; from beyond it a
// session proves one and seals its lines (handshake.h, sealed_lines.h). It runs a thread of its
// own, beside the tasks and never in their way, and calls its handler and the answers from there.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "high_level/mission/command_line.h"
#include "high_level/mission/session_places.h"
#include "mid_level/base/time.h"

namespace lodesman {

struct CommandSocketOptions {
  std::string address;     // IP; where it is beyond loopback, loopback is listened on too
  std::uint16_t port = 0;  // 0: one that is free
  CommandTokens tokens;    // of this run, good on loopback; that to command is not empty
  // How long a session may be silent: before its first command, and after one.
  Duration stranger_idle_limit = std::chrono::seconds{2};
  Duration idle_limit = std::chrono::seconds{60};
  // The same beyond loopback: no order that was held up on its way for longer is obeyed.
  Duration far_idle_limit = std::chrono::seconds{5};
  CommandTokens lasting_tokens{};  // good everywhere; that to command is not empty beyond loopback
};

// What else is called from the socket's thread; each may be empty.
struct CommandSocketEvents {
  std::function<void(std::uint64_t session)> ended;  // one that had shown a token
  std::function<void()> look;                        // every kLookPeriod
  // A token was not proved, from beyond loopback.
  std::function<void(const std::string& address)> refused;
};
inline constexpr Duration kLookPeriod = std::chrono::milliseconds{20};

class CommandSocket {
 public:
  // Listens from here on. Throws StartupError when it cannot, or may not.
  CommandSocket(const CommandSocketOptions& options, CommandHandler handler,
                CommandSocketEvents events = {});
  CommandSocket(const CommandSocket&) = delete;
  CommandSocket& operator=(const CommandSocket&) = delete;
  // Waits a moment for the answers that are still awaited.
  ~CommandSocket();

  [[nodiscard]] std::uint16_t port() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lodesman
