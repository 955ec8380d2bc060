// SPDX-License-Identifier: Apache-2.0
// Numbers as they lie in the records of the Delta T, the high byte first unless named otherwise.
// Whoever reads has made sure that the bytes are there. Pure; any thread.
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace lodesman::delta_t {

using Bytes = std::span<const std::uint8_t>;

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
