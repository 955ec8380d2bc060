// SPDX-License-Identifier: Apache-2.0
// A way to the boat's command socket, as the console sees it. The console's thread.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "mid_level/base/time.h"

namespace lodesman::console {

// The boat's line, or why there is none.
struct BoatReply {
  bool is_there = false;
  std::string text;
};

// One session of the command socket, opened when something is asked for; it commands what its
// session commands, and ends with this.
class CommandPort {
 public:
  CommandPort() = default;
  CommandPort(const CommandPort&) = delete;
  CommandPort& operator=(const CommandPort&) = delete;
  virtual ~CommandPort() = default;

  using Done = std::function<void(const BoatReply& reply)>;
  // `request`: an object of JSON without token and protocol. One after the other, in order; `done`
  // comes once for each, but for those that are under way when this ends.
  virtual void ask(const std::string& request, Done done) = 0;
};

// The token that a session shows, as it is then; empty where there is none.
using TokenOf = std::function<std::string()>;
// Whether a word is said again where the session ended without an answer: what stops the boat may
// be.
enum class Insistence : std::uint8_t { kOnce, kAgain };
using PortMaker = std::function<std::unique_ptr<CommandPort>(TokenOf token, Insistence insistence)>;

}  // namespace lodesman::console
