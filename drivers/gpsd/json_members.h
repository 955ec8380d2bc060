// SPDX-License-Identifier: Apache-2.0
// The members of one JSON object on one line, one after another, as gpsd writes them. Total over
// any text: what is no object, or ends before its time, is not sound, and gives no member more.
// Values that are objects or lists are given as their text and not looked into. Nothing allocates,
// which is why no library does it: those of Debian 12 build a tree, or take a copy of each string.
// One thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace lodesman::gpsd {

class JsonMembers {
 public:
  enum class Kind : std::uint8_t { kText, kNumber, kWord, kNested };
  struct Member {
    std::string_view name;
    Kind kind = Kind::kWord;
    std::string_view value;  // of a text without its quotes, escapes as they stand
  };

  explicit JsonMembers(std::string_view line) noexcept;

  // None at the end, and where it is not sound.
  [[nodiscard]] std::optional<Member> next() noexcept;
  // Known once next() has given none: the object was whole, and nothing but blanks behind it.
  [[nodiscard]] bool sound() const noexcept { return state_ == State::kEnded; }

 private:
  enum class State : std::uint8_t { kFirst, kBehindMember, kEnded, kBroken };

  void skip_blanks() noexcept;
  [[nodiscard]] bool take(char letter) noexcept;
  [[nodiscard]] std::optional<std::string_view> take_text() noexcept;
  [[nodiscard]] std::optional<std::string_view> take_nested() noexcept;
  [[nodiscard]] std::optional<std::string_view> take_bare() noexcept;
  [[nodiscard]] std::optional<Member> take_member() noexcept;
  [[nodiscard]] std::nullopt_t end(State state) noexcept;

  std::string_view left_;
  State state_ = State::kFirst;
};

// [-] a finite number, or nothing.
[[nodiscard]] std::optional<double> number_of(const JsonMembers::Member& member) noexcept;

}  // namespace lodesman::gpsd
