// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/oracle.h"

#include <algorithm>
#include <cctype>

namespace lodesman::fuzz {
namespace {

constexpr std::size_t kMaxRefusalLength = 1003;  // 1000 and "..."

[[nodiscard]] bool is_control(char c) noexcept { return (c >= '\0' && c < ' ') || c == '\x7f'; }

}  // namespace

void require(bool good, const std::string& what) {
  if (!good) {
    throw Violation{what};
  }
}

void require_refusal_form(const std::string& refusal) {
  require(refusal.size() <= kMaxRefusalLength, "a refusal is too long");
  require(std::ranges::none_of(refusal, is_control), "a refusal holds a control character");
  const std::size_t line = refusal.find(':') + 1;
  const std::size_t line_end = refusal.find_first_not_of("0123456789", line);
  require(line != 0 && line_end != std::string::npos && line_end > line && refusal[line] != '0' &&
              refusal.compare(line_end, 2, ": ") == 0,
          "a refusal names no file and line: " + refusal);
  // A key may be so long that nothing is left of the reason.
  const std::size_t reason = refusal.find(": ", line_end + 2);
  require((reason != std::string::npos && reason + 2 < refusal.size()) ||
              refusal.size() == kMaxRefusalLength,
          "a refusal names no key and reason: " + refusal);
}

}  // namespace lodesman::fuzz
