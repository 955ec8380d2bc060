// SPDX-License-Identifier: Apache-2.0
// One connection of the command socket and the lines that pass over it. The socket's thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>  // Boost 1.74 uses std::exchange without including it

#include <boost/asio/awaitable.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>

#include "high_level/mission/command_line.h"
#include "high_level/mission/sealed_lines.h"
#include "high_level/mission/session_places.h"
#include "mid_level/base/time.h"

namespace lodesman {

// The time of the socket's own thread, which is no task.
[[nodiscard]] Time socket_time() noexcept;

// What a session has proved, and how its lines are sealed since.
struct ProvedToken {
  Scope scope;
  SealedLines lines;
};

struct CommandSession {
  CommandSession(boost::asio::ip::tcp::socket socket_in, const std::string& address_in);

  void end() noexcept;
  // Beyond loopback.
  [[nodiscard]] bool is_far() const noexcept { return place.network != kOwnMachine; }
  [[nodiscard]] bool is_stranger() const noexcept { return place.standing == Standing::kStranger; }

  boost::asio::ip::tcp::socket socket;
  boost::asio::steady_timer timer;
  std::string buffer;
  std::uint64_t id = 0;
  std::string address;  // of the client
  SessionPlace place;
  std::optional<ProvedToken> proved;
};

// Each throws where the session has ended meanwhile.
[[nodiscard]] boost::asio::awaitable<void> wait(CommandSession& session, Duration pause);
// Without its line feed, and as it came, sealed or not. Throws where it is too long.
[[nodiscard]] boost::asio::awaitable<std::string> next_line(CommandSession& session);
// Sealed where a token was proved.
[[nodiscard]] boost::asio::awaitable<void> send_line(CommandSession& session, std::string line);

}  // namespace lodesman
