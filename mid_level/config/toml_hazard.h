// SPDX-License-Identifier: Apache-2.0
// Finds what must not reach the TOML library (toml++ 3.3). It bounds the depth of values and not
// that of dotted keys, and frees tables by recursion: a key of a hundred thousand parts would
// overflow the stack. And what it does with a letter beyond ASCII outside texts and comments, where
// TOML has none, is undefined. A pure function; any thread.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace lodesman {

inline constexpr int kMaxKeyParts = 16;

struct TomlHazard {
  std::size_t line = 0;  // from 1
  std::string_view reason;
};

// The first hazard; dots in comments and texts are no part of a key.
[[nodiscard]] std::optional<TomlHazard> hazard_of(std::string_view text) noexcept;

}  // namespace lodesman
