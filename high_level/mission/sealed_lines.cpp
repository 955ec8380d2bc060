// SPDX-License-Identifier: Apache-2.0
#include "high_level/mission/sealed_lines.h"

#include <algorithm>

#include "mid_level/base/check.h"

namespace lodesman {
namespace {

constexpr std::string_view kObject = "{\"";

[[nodiscard]] Digest code_of(const Digest& key, std::uint64_t number, std::string_view object) {
  return message_code(key, std::to_string(number) + '\n' + std::string{object});
}

// What stands before the code.
[[nodiscard]] std::string prefix_of(std::uint64_t number) {
  return "{\"sequence\":" + std::to_string(number) + ",\"code\":\"";
}

}  // namespace

SealedLines::SealedLines(const SessionKeys& keys, SessionEnd end) noexcept
    : own_key_{end == SessionEnd::kBoat ? keys.to_client : keys.to_boat},
      other_key_{end == SessionEnd::kBoat ? keys.to_boat : keys.to_client} {}

std::string SealedLines::seal(std::string_view object) {
  LODESMAN_CHECK(object.starts_with(kObject));
  ++sealed_;
  return prefix_of(sealed_) + to_hex(code_of(own_key_, sealed_, object)) + "\"," +
         std::string{object.substr(1)};
}

// The number and the length of the code are known, so that nothing is parsed before it is believed.
std::optional<std::string> SealedLines::open(std::string_view line) {
  const std::uint64_t number = opened_ + 1;
  const std::string prefix = prefix_of(number);
  if (!line.starts_with(prefix)) {
    return std::nullopt;
  }
  line.remove_prefix(prefix.size());
  const auto code = digest_of(line.substr(0, kHexDigits));
  line.remove_prefix(std::min(kHexDigits, line.size()));
  if (!code || !line.starts_with("\",\"")) {
    return std::nullopt;
  }
  std::string object = "{" + std::string{line.substr(2)};
  if (!same_digest(*code, code_of(other_key_, number, object))) {
    return std::nullopt;
  }
  opened_ = number;
  return object;
}

}  // namespace lodesman
