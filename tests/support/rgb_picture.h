// SPDX-License-Identifier: Apache-2.0
// A PNG file's pixels in their colours, for tests that look at what was drawn.
#pragma once

#include <png.h>

#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "low_level/sonar/view_colours.h"
#include "tests/support/catch.h"

namespace lodesman::testing {

class RgbPicture {
 public:
  explicit RgbPicture(std::string_view file) {
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    REQUIRE(png_image_begin_read_from_memory(&png, file.data(), file.size()) != 0);
    png.format = PNG_FORMAT_RGB;
    columns_ = static_cast<int>(png.width);
    rows_ = static_cast<int>(png.height);
    pixels_.resize(PNG_IMAGE_SIZE(png));
    REQUIRE(png_image_finish_read(&png, nullptr, pixels_.data(), 0, nullptr) != 0);
  }

  [[nodiscard]] int columns() const { return columns_; }
  [[nodiscard]] int rows() const { return rows_; }
  [[nodiscard]] ViewColour at(int column, int row) const {
    REQUIRE((column >= 0 && column < columns_ && row >= 0 && row < rows_));
    const std::size_t first =
        3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
             static_cast<std::size_t>(column));
    return {pixels_[first], pixels_[first + 1], pixels_[first + 2]};
  }
  // How many pixels within so many of that one have that colour, as nearly as smooth lines have it.
  [[nodiscard]] int count_near(int column, int row, int within, const ViewColour& colour) const {
    int count = 0;
    for (int r = row - within; r <= row + within; ++r) {
      for (int c = column - within; c <= column + within; ++c) {
        count += is_alike(at(c, r), colour, 60) ? 1 : 0;
      }
    }
    return count;
  }
  [[nodiscard]] static bool is_alike(const ViewColour& a, const ViewColour& b, int apart) {
    return std::abs(a.red - b.red) <= apart && std::abs(a.green - b.green) <= apart &&
           std::abs(a.blue - b.blue) <= apart;
  }

 private:
  int columns_ = 0;
  int rows_ = 0;
  std::vector<png_byte> pixels_;
};

}  // namespace lodesman::testing
