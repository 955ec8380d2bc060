// SPDX-License-Identifier: Apache-2.0
#include "mid_level/config/toml_hazard.h"

#include <algorithm>

namespace lodesman {
namespace {

// Where the text that begins with the quote at `at` ends. One that is not closed ends as the TOML
// library would refuse it: with its line, or with the file.
[[nodiscard]] std::size_t end_of_text(std::string_view text, std::size_t at) noexcept {
  const char quote = text[at];
  const std::string_view three = quote == '"' ? "\"\"\"" : "'''";
  const bool many_lines = text.substr(at, 3) == three;
  const std::string_view end = many_lines ? three : three.substr(0, 1);
  for (at += end.size(); at < text.size(); ++at) {
    if (text[at] == '\\' && quote == '"') {
      ++at;
    } else if (text[at] == '\n' && !many_lines) {
      return at;
    } else if (text.substr(at, end.size()) == end) {
      // Up to two quotes before the closing three belong to the text.
      const std::size_t last = std::min(at + (many_lines ? 5 : 1), text.size());
      return std::min(text.find_first_not_of(quote, at), last);
    }
  }
  return text.size();
}

}  // namespace

std::optional<TomlHazard> hazard_of(std::string_view text) noexcept {
  constexpr std::string_view kEndsKey = "=,\n[]{}";
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  int parts = 1;
  std::size_t line = 1;
  for (std::size_t at = text.starts_with(kByteOrderMark) ? 3 : 0; at < text.size();) {
    std::size_t next = at + 1;
    if (text[at] == '#') {
      next = std::min(text.find('\n', at), text.size());
    } else if (text[at] == '"' || text[at] == '\'') {
      next = end_of_text(text, at);
    } else if (text[at] == '.') {
      ++parts;
    } else if (kEndsKey.find(text[at]) != std::string_view::npos) {
      parts = 1;
    }
    if (parts > kMaxKeyParts) {
      return TomlHazard{line, "a key of too many parts"};
    }
    if (static_cast<unsigned char>(text[at]) >= 0x80) {
      return TomlHazard{line, "only texts and comments may hold other letters than ASCII's"};
    }
    const std::string_view passed = text.substr(at, next - at);
    line += static_cast<std::size_t>(std::count(passed.begin(), passed.end(), '\n'));
    at = next;
  }
  return std::nullopt;
}

}  // namespace lodesman
