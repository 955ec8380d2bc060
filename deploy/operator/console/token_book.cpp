// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/console/token_book.h"

#include <algorithm>

#include "high_level/mission/message_code.h"
#include "high_level/mission/token_file.h"
#include "mid_level/base/startup_error.h"

namespace lodesman::console {
namespace {

// By codes of both, under a key that is another each time: how long it takes tells nothing.
[[nodiscard]] bool same_token(const std::string& one, const std::string& other) {
  const Digest key = random_digest();
  return same_digest(message_code(key, one), message_code(key, other)) && !other.empty();
}

}  // namespace

Scope scope_among(const std::string& token, const CommandTokens& tokens) {
  // All three, whichever it is.
  const bool views = same_token(token, tokens.view);
  const bool aborts = same_token(token, tokens.abort);
  const bool commands = same_token(token, tokens.command);
  if (commands) {
    return Scope::kCommand;
  }
  if (aborts) {
    return Scope::kAbort;
  }
  return views ? Scope::kView : Scope::kNone;
}

Scope TokenBook::scope_of(const std::string& token) const {
  Scope scope = Scope::kNone;
  if (const auto run = of_run()) {
    scope = scope_among(token, *run);
  }
  if (lasting_.empty()) {
    return scope;
  }
  try {
    return std::max(scope, scope_among(token, read_tokens(lasting_)));
  } catch (const StartupError&) {
    return scope;
  }
}

std::optional<CommandTokens> TokenBook::of_run() const {
  try {
    const auto file = find_token_file(port_);
    return file ? std::optional{read_tokens(*file)} : std::nullopt;
  } catch (const StartupError&) {
    return std::nullopt;
  }
}

}  // namespace lodesman::console
