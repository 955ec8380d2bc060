// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/console/token_book.h"

#include <algorithm>

#include "high_level/mission/token_file.h"
#include "mid_level/base/startup_error.h"

namespace lodesman::console {
Scope TokenBook::scope_of(const std::string& token) const {
  Scope scope = Scope::kNone;
  if (const auto run = of_run()) {
    scope = lodesman::scope_of(token, *run);
  }
  if (lasting_.empty()) {
    return scope;
  }
  try {
    return std::max(scope, lodesman::scope_of(token, read_tokens(lasting_)));
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
