// SPDX-License-Identifier: Apache-2.0
// Bytes of the Delta T that its sources print or describe, as they are on the wire.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <vector>

namespace lodesman::testing {

// "38 33 50": so many bytes, the rest up to `size` zero.
[[nodiscard]] inline std::vector<std::uint8_t> hex(std::string_view text, std::size_t size = 0) {
  const auto digit = [](char c) {
    return static_cast<unsigned>(c <= '9' ? c - '0' : c - 'A' + 10);
  };
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i + 1 < text.size(); i += 3) {
    bytes.push_back(static_cast<std::uint8_t>(digit(text[i]) * 16U + digit(text[i + 1])));
  }
  bytes.resize(std::max(size, bytes.size()));
  return bytes;
}

// A profile of 120 beams with intensities; its header alone.
inline constexpr std::string_view kProfileHeader =
    "38 33 50 0A 02 E0 00 00 32 31 2D 4E 4F 56 2D 32 "
    "30 32 36 00 31 32 3A 33 35 3A 30 30 00 2E 32 35 "
    "00 20 33 35 2E 30 31 2E 36 33 32 30 30 20 4E 31 "
    "33 38 2E 35 34 2E 30 30 30 30 30 20 45 0A 02 23 "
    "83 93 83 70 82 32 00 78 01 F4 00 78 2E E0 64 00 "
    "0A 01 04 BA 98 00 14 00 00 00 B4 00 64 00 00 04 "
    "D2 00 00 00 00 00 00 00 00 00 00 00 3E B3 33 33 "
    "2E 32 35 33 00 01 00 32 00 78 00 00 00 00 00 00 ";

// One that was captured in 2015, of 480 beams, as a public program prints it; zeros restored.
inline constexpr std::string_view kRealHeader =
    "38 33 50 0A 04 C0 00 00 31 32 2D 4A 55 4E 2D 32 "
    "30 31 35 00 31 32 3A 35 39 3A 32 34 00 2E 37 33 "
    "00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 "
    "00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 "
    "03 84 83 84 00 00 01 E0 01 F4 00 78 2E ED 19 00 "
    "05 02 A3 B9 D0 00 01 00 1E 00 B4 00 67 00 00 00 "
    "01 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 "
    "2E 37 33 34 00 00 00 05 00 00 01 00 00 05 0F A0 ";

// Even beams at 250 steps and on, odd ones without a return; intensities of the beam's number.
[[nodiscard]] inline std::vector<std::uint8_t> profile_vector() {
  std::vector<std::uint8_t> bytes = hex(kProfileHeader, 256);
  for (unsigned beam = 0; beam < 120; ++beam) {
    const unsigned steps = beam % 2 == 0 ? 250 + beam : 0;
    bytes.push_back(static_cast<std::uint8_t>(steps >> 8U));
    bytes.push_back(static_cast<std::uint8_t>(steps & 0xFFU));
  }
  for (unsigned beam = 0; beam < 120; ++beam) {
    bytes.push_back(0);
    bytes.push_back(static_cast<std::uint8_t>(beam));
  }
  return bytes;
}

[[nodiscard]] inline std::vector<std::uint8_t> real_vector() { return hex(kRealHeader, 1216); }

}  // namespace lodesman::testing
