// SPDX-License-Identifier: Apache-2.0
// The operator's way in: JSON lines over TCP, on loopback unless told otherwise. It runs a thread
// of its own, beside the tasks and never in their way, and calls its handler from there.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "high_level/mission/command_line.h"

namespace lodesman {

struct CommandSocketOptions {
  std::string address;     // an IP address; any but loopback needs a token
  std::uint16_t port = 0;  // 0: one that is free
  std::string token;       // empty: none is asked for
};

class CommandSocket {
 public:
  // Listens from here on. Throws StartupError when it cannot, or may not.
  CommandSocket(const CommandSocketOptions& options, CommandHandler handler);
  CommandSocket(const CommandSocket&) = delete;
  CommandSocket& operator=(const CommandSocket&) = delete;
  ~CommandSocket();

  [[nodiscard]] std::uint16_t port() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lodesman
