// SPDX-License-Identifier: Apache-2.0
// The console's sockets: HTTP and WebSocket on one port, and the sessions of the command socket
// that its viewers command by. It runs a thread of its own, in which all of the console happens;
// nothing that a client does, or does not do, makes that thread wait.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "deploy/operator/console/console.h"
#include "mid_level/base/startup_error.h"

namespace lodesman::console {

// Another program has the port.
class PortTaken : public StartupError {
 public:
  using StartupError::StartupError;
};

struct ServerOptions {
  std::string address;     // IP
  std::uint16_t port = 0;  // 0: one that is free
  bool or_next = false;    // where it is taken one of the next, up to kNextPorts
  std::string command_address;
  Duration header_limit = std::chrono::seconds{5};  // for a request's header, and then its body
  Duration stall_limit = std::chrono::seconds{10};  // in which a viewer takes no message
};
inline constexpr int kNextPorts = 20;

class ConsoleServer {
 public:
  // Listens from here on. Throws PortTaken, or StartupError where it cannot listen there.
  ConsoleServer(const ServerOptions& options, const ConsoleOptions& console);
  ConsoleServer(const ConsoleServer&) = delete;
  ConsoleServer& operator=(const ConsoleServer&) = delete;
  ~ConsoleServer();

  [[nodiscard]] std::uint16_t port() const noexcept;
  // For who starts it; before start().
  [[nodiscard]] std::string make_one_time_token();
  // From now on it answers.
  void start();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lodesman::console
