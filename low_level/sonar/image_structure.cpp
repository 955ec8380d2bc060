// SPDX-License-Identifier: Apache-2.0
#include "low_level/sonar/image_structure.h"

#include <algorithm>

namespace lodesman {
namespace {

using ByteView = std::span<const std::uint8_t>;

constexpr std::uint8_t kStartOfScan = 0xDA;
constexpr std::uint8_t kEndOfImage = 0xD9;
constexpr std::uint64_t kEndChunk = 0x49454E44;  // IEND

// Big-endian; 0 beyond the end.
[[nodiscard]] std::uint64_t number_at(ByteView file, std::size_t at, std::size_t size) noexcept {
  std::uint64_t number = 0;
  for (std::size_t i = at; i < at + size; ++i) {
    number = number << 8U | (i < file.size() ? file[i] : 0U);
  }
  return number;
}

[[nodiscard]] bool is_jpeg(ByteView file) noexcept { return number_at(file, 0, 2) == 0xFFD8; }
[[nodiscard]] bool is_png(ByteView file) noexcept { return number_at(file, 0, 4) == 0x89504E47; }

// Frame headers are the markers C0 to CF but for three that define tables.
[[nodiscard]] bool begins_frame(std::uint8_t marker) noexcept {
  return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

[[nodiscard]] bool has_length(std::uint8_t marker) noexcept {
  return marker > 0x01 && (marker < 0xD0 || marker > kEndOfImage);
}

// From marker to marker, over whatever lies between them, as the decoder goes. Calls
// visit(marker, place) for each, until it says that it has seen enough.
template <class Visit>
void walk_jpeg(ByteView file, Visit visit) noexcept {
  for (std::size_t at = 2; at + 1 < file.size();) {
    const std::uint8_t marker = file[at + 1];
    if (file[at] != 0xFF || marker == 0xFF || marker == 0x00) {
      ++at;
      continue;
    }
    if (visit(marker, at)) {
      return;
    }
    at += 2 + (has_length(marker) ? number_at(file, at + 2, 2) : 0);
  }
}

[[nodiscard]] std::uint64_t jpeg_pixels(ByteView file) noexcept {
  std::uint64_t most = 0;
  walk_jpeg(file, [&](std::uint8_t marker, std::size_t at) {
    if (begins_frame(marker)) {
      most = std::max(most, number_at(file, at + 5, 2) * number_at(file, at + 7, 2));
    }
    return false;
  });
  return most;
}

// The end marker after a scan: before any there is no picture that could end.
[[nodiscard]] bool jpeg_is_whole(ByteView file) noexcept {
  bool scanned = false;
  bool ended = false;
  walk_jpeg(file, [&](std::uint8_t marker, std::size_t /*at*/) {
    scanned = scanned || marker == kStartOfScan;
    ended = marker == kEndOfImage;
    return ended;
  });
  return scanned && ended;
}

// From chunk to chunk: length, name, contents, check.
[[nodiscard]] bool png_is_whole(ByteView file) noexcept {
  for (std::size_t at = 8; at + 12 <= file.size(); at += 12 + number_at(file, at, 4)) {
    if (number_at(file, at + 4, 4) == kEndChunk) {
      return true;
    }
  }
  return false;
}

}  // namespace

std::uint64_t declared_pixels(ByteView file) noexcept {
  if (is_jpeg(file)) {
    return jpeg_pixels(file);
  }
  // The first chunk is the header: its length and name, columns, rows.
  return is_png(file) ? number_at(file, 16, 4) * number_at(file, 20, 4) : 0;
}

bool is_whole(ByteView file) noexcept {
  return is_jpeg(file) ? jpeg_is_whole(file) : is_png(file) && png_is_whole(file);
}

}  // namespace lodesman
