// SPDX-License-Identifier: Apache-2.0
// PNG and JPEG files to grey pixels, and drawn pictures to PNG and JPEG files: libpng and
// libjpeg-turbo alone, as OpenCV's own reader would load a hundred libraries of other formats into
// every program. Pure functions that allocate; any thread.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace lodesman {

struct GreyImage {
  std::uint32_t columns = 0;         // [px]
  std::uint32_t rows = 0;            // [px]
  std::vector<std::uint8_t> pixels;  // row by row, from the top
};

enum class ImageFault : std::uint8_t { kNone, kDamaged, kNotEightBits };

struct DecodedImage {
  ImageFault fault = ImageFault::kDamaged;
  GreyImage image;  // empty where there is a fault
};

// Of a file as long as its pixels are few: both make room for what the file declares. Colours
// become grey, and what is transparent shows its colour. A PNG's gamma is applied where it names
// another than screens have. What a decoder only warns of is damage: it fills in what nobody
// measured.
[[nodiscard]] DecodedImage decode_png(std::span<const std::uint8_t> file);
[[nodiscard]] DecodedImage decode_jpeg(std::span<const std::uint8_t> file);

// Blue, green, red, 8 bits each; row by row, from the top, without gaps.
struct BgrPixels {
  int columns = 0;
  int rows = 0;
  const std::uint8_t* pixels = nullptr;
};

// Empty where it cannot be done.
[[nodiscard]] std::vector<std::uint8_t> encode_png(const BgrPixels& picture);
[[nodiscard]] std::vector<std::uint8_t> encode_jpeg(const BgrPixels& picture);

}  // namespace lodesman
