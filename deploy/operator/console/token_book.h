// SPDX-License-Identifier: Apache-2.0
// Which token is good for what on this boat: its own tokens of the run, which it leaves in a file
// as long as it lives, and the lasting ones that its configuration names. Files are read anew each
// time, so that what is no token any more is none. The console's thread.
#pragma once

#include <optional>
#include <string>

#include "high_level/mission/command_line.h"

namespace lodesman::console {

class TokenBook {
 public:
  // `port`: of the command socket. `lasting`: a file; empty where there is none.
  TokenBook(std::uint16_t port, std::string lasting) : port_{port}, lasting_{std::move(lasting)} {}

  [[nodiscard]] Scope scope_of(const std::string& token) const;
  // Of this run; nothing where no boat that lives has left any, or they may not be read.
  [[nodiscard]] std::optional<CommandTokens> of_run() const;

 private:
  std::uint16_t port_;
  std::string lasting_;
};

}  // namespace lodesman::console
