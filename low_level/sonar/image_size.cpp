// SPDX-License-Identifier: Apache-2.0
#include "low_level/sonar/image_size.h"

#include <algorithm>

namespace lodesman {
namespace {

using Bytes = std::span<const std::uint8_t>;

// Big-endian; 0 beyond the end.
[[nodiscard]] std::uint64_t number_at(Bytes file, std::size_t at, std::size_t size) noexcept {
  std::uint64_t number = 0;
  for (std::size_t i = at; i < at + size; ++i) {
    number = number << 8U | (i < file.size() ? file[i] : 0U);
  }
  return number;
}

// Frame headers are the markers C0 to CF but for three that define tables.
[[nodiscard]] bool begins_frame(std::uint8_t marker) noexcept {
  return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

[[nodiscard]] bool has_length(std::uint8_t marker) noexcept {
  return marker > 0x01 && (marker < 0xD0 || marker > 0xD8);
}

// From marker to marker, over whatever lies between them, as the decoder goes.
[[nodiscard]] std::uint64_t jpeg_pixels(Bytes file) noexcept {
  std::uint64_t most = 0;
  for (std::size_t at = 2; at + 1 < file.size();) {
    const std::uint8_t marker = file[at + 1];
    if (file[at] != 0xFF || marker == 0xFF || marker == 0x00) {
      ++at;
      continue;
    }
    if (begins_frame(marker)) {
      most = std::max(most, number_at(file, at + 5, 2) * number_at(file, at + 7, 2));
    }
    at += 2 + (has_length(marker) ? number_at(file, at + 2, 2) : 0);
  }
  return most;
}

}  // namespace

std::uint64_t declared_pixels(Bytes file) noexcept {
  if (number_at(file, 0, 2) == 0xFFD8) {
    return jpeg_pixels(file);
  }
  // The first chunk is the header: its length and name, columns, rows.
  return number_at(file, 0, 4) == 0x89504E47 ? number_at(file, 16, 4) * number_at(file, 20, 4) : 0;
}

}  // namespace lodesman
