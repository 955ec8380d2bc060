// SPDX-License-Identifier: Apache-2.0
// Numbers as they lie in the records of the Delta T, the high byte first unless named otherwise.
// Whoever reads has made sure that the bytes are there. Pure; any thread.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "mid_level/base/heading.h"

namespace lodesman::delta_t {

using Bytes = std::span<const std::uint8_t>;

// So many characters as there is room for, with the zero at the end where there is one.
template <std::size_t kSize>
using Text = std::array<char, kSize>;

inline constexpr double kKnot_m_s = 1852.0 / 3600.0;

[[nodiscard]] constexpr std::uint16_t word_at(Bytes bytes, std::size_t at) noexcept {
  return static_cast<std::uint16_t>((bytes[at] << 8U) | bytes[at + 1]);
}
[[nodiscard]] constexpr std::uint16_t low_first_word_at(Bytes bytes, std::size_t at) noexcept {
  return static_cast<std::uint16_t>((bytes[at + 1] << 8U) | bytes[at]);
}
[[nodiscard]] constexpr std::uint32_t three_bytes_at(Bytes bytes, std::size_t at) noexcept {
  return (std::uint32_t{bytes[at]} << 16U) | word_at(bytes, at + 1);
}
[[nodiscard]] constexpr std::uint32_t long_at(Bytes bytes, std::size_t at) noexcept {
  return (std::uint32_t{word_at(bytes, at)} << 16U) | word_at(bytes, at + 2);
}
[[nodiscard]] constexpr std::uint32_t low_first_long_at(Bytes bytes, std::size_t at) noexcept {
  return (std::uint32_t{low_first_word_at(bytes, at + 2)} << 16U) | low_first_word_at(bytes, at);
}

template <std::size_t kSize>
[[nodiscard]] Text<kSize> text_at(Bytes bytes, std::size_t at) noexcept {
  Text<kSize> text{};
  std::transform(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                 bytes.begin() + static_cast<std::ptrdiff_t>(at + kSize), text.begin(),
                 [](std::uint8_t byte) { return static_cast<char>(byte); });
  return text;
}

// A word whose highest bit says that the rest is a value.
[[nodiscard]] inline std::optional<double> valid_tenths(Bytes bytes, std::size_t at) noexcept {
  const std::uint16_t word = word_at(bytes, at);
  return (word & 0x8000U) != 0 ? std::optional{(word & 0x7FFFU) / 10.0} : std::nullopt;
}
[[nodiscard]] inline std::optional<double> valid_angle_rad(Bytes bytes, std::size_t at,
                                                           double zero_deg) noexcept {
  const std::optional<double> degrees = valid_tenths(bytes, at);
  return degrees ? std::optional{to_rad(*degrees - zero_deg)} : std::nullopt;
}

// Of a number in IEEE format whose byte order is in doubt: the order by which it can be, the high
// byte first where both can. Nothing where neither is 0 or lies between 1e-6 and `most`.
[[nodiscard]] inline std::optional<double> doubtful_float_at(Bytes bytes, std::size_t at,
                                                             double most) noexcept {
  constexpr double kLeast = 1e-6;
  for (const std::uint32_t bits : {long_at(bytes, at), low_first_long_at(bytes, at)}) {
    const auto value = static_cast<double>(std::bit_cast<float>(bits));
    const double size = std::abs(value);
    if ((bits & 0x7FFFFFFFU) == 0 || (size >= kLeast && size <= most)) {
      return value;
    }
  }
  return std::nullopt;
}

}  // namespace lodesman::delta_t
