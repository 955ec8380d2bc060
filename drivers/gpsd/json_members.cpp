// SPDX-License-Identifier: Apache-2.0
#include "drivers/gpsd/json_members.h"

#include <charconv>
#include <cmath>

namespace lodesman::gpsd {
namespace {

[[nodiscard]] bool is_blank(char letter) noexcept {
  return letter == ' ' || letter == '\t' || letter == '\r' || letter == '\n';
}

}  // namespace

JsonMembers::JsonMembers(std::string_view line) noexcept : left_{line} {
  skip_blanks();
  if (!take('{')) {
    state_ = State::kBroken;
  }
}

void JsonMembers::skip_blanks() noexcept {
  while (!left_.empty() && is_blank(left_.front())) {
    left_.remove_prefix(1);
  }
}

bool JsonMembers::take(char letter) noexcept {
  if (left_.empty() || left_.front() != letter) {
    return false;
  }
  left_.remove_prefix(1);
  return true;
}

std::nullopt_t JsonMembers::end(State state) noexcept {
  state_ = state;
  return std::nullopt;
}

std::optional<std::string_view> JsonMembers::take_text() noexcept {
  if (!take('"')) {
    return std::nullopt;
  }
  for (std::size_t i = 0; i < left_.size(); ++i) {
    if (left_[i] == '\\') {
      ++i;
    } else if (left_[i] == '"') {
      const std::string_view text = left_.substr(0, i);
      left_.remove_prefix(i + 1);
      return text;
    }
  }
  return std::nullopt;
}

// Brackets of either kind count alike: what lies within is not looked at.
std::optional<std::string_view> JsonMembers::take_nested() noexcept {
  const std::string_view whole = left_;
  std::size_t depth = 0;
  while (!left_.empty()) {
    const char letter = left_.front();
    if (letter == '"') {
      if (!take_text()) {
        return std::nullopt;
      }
      continue;
    }
    left_.remove_prefix(1);
    depth += letter == '{' || letter == '[' ? 1U : 0U;
    if (letter == '}' || letter == ']') {
      if (--depth == 0) {
        return whole.substr(0, whole.size() - left_.size());
      }
    }
  }
  return std::nullopt;
}

std::optional<std::string_view> JsonMembers::take_bare() noexcept {
  std::size_t size = 0;
  while (size < left_.size() && left_[size] != ',' && left_[size] != '}' &&
         !is_blank(left_[size])) {
    ++size;
  }
  const std::string_view bare = left_.substr(0, size);
  left_.remove_prefix(size);
  return bare.empty() ? std::nullopt : std::optional{bare};
}

std::optional<JsonMembers::Member> JsonMembers::take_member() noexcept {
  const std::optional<std::string_view> name = take_text();
  skip_blanks();
  if (!name || !take(':')) {
    return std::nullopt;
  }
  skip_blanks();
  const char first = left_.empty() ? '\0' : left_.front();
  const bool is_number = first == '-' || (first >= '0' && first <= '9');
  const Kind kind = first == '"'                   ? Kind::kText
                    : first == '{' || first == '[' ? Kind::kNested
                    : is_number                    ? Kind::kNumber
                                                   : Kind::kWord;
  const std::optional<std::string_view> value = kind == Kind::kText     ? take_text()
                                                : kind == Kind::kNested ? take_nested()
                                                                        : take_bare();
  return value ? std::optional{Member{*name, kind, *value}} : std::nullopt;
}

std::optional<JsonMembers::Member> JsonMembers::next() noexcept {
  if (state_ == State::kEnded || state_ == State::kBroken) {
    return std::nullopt;
  }
  skip_blanks();
  if (take('}')) {
    skip_blanks();
    return end(left_.empty() ? State::kEnded : State::kBroken);
  }
  if (state_ == State::kBehindMember && !take(',')) {
    return end(State::kBroken);
  }
  skip_blanks();
  const std::optional<Member> member = take_member();
  if (!member) {
    return end(State::kBroken);
  }
  state_ = State::kBehindMember;
  return member;
}

std::optional<double> number_of(const JsonMembers::Member& member) noexcept {
  double value = 0.0;
  const char* end = member.value.data() + member.value.size();
  const auto [stopped, error] = std::from_chars(member.value.data(), end, value);
  const bool whole = member.kind == JsonMembers::Kind::kNumber && error == std::errc{} &&
                     stopped == end && std::isfinite(value);
  return whole ? std::optional{value} : std::nullopt;
}

}  // namespace lodesman::gpsd
