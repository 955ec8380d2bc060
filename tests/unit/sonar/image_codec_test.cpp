// SPDX-License-Identifier: Apache-2.0
#include "low_level/sonar/image_codec.h"

#include <png.h>

#include <algorithm>
#include <cstdlib>
#include <string>

#include "tests/support/catch.h"

namespace lodesman {
namespace {

using Bytes = std::vector<std::uint8_t>;

// A PNG of one row in any of libpng's formats.
Bytes png_of(std::uint32_t format, std::uint32_t columns, const void* pixels,
             const void* palette = nullptr, std::uint32_t colours = 0) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = columns;
  png.height = 1;
  png.format = format;
  png.colormap_entries = colours;
  png_alloc_size_t size = 4096;
  Bytes bytes(size);
  REQUIRE(png_image_write_to_memory(&png, bytes.data(), &size, 0, pixels, 0, palette) != 0);
  bytes.resize(size);
  return bytes;
}

// 64 x 32: dark to the left and bright to the right, without colour.
Bytes ramp() {
  Bytes pixels;
  for (int row = 0; row < 32; ++row) {
    for (int column = 0; column < 64; ++column) {
      pixels.insert(pixels.end(), 3, static_cast<std::uint8_t>(4 * column));
    }
  }
  return pixels;
}

}  // namespace

TEST_CASE("image codec: a PNG of any colours becomes grey, and what is transparent keeps its own",
          "[low_level][sonar]") {
  const Bytes grey{0, 1, 100, 255};
  const Bytes grey_alpha{7, 0, 100, 255};
  const Bytes rgb{255, 0, 0, 0, 255, 0, 0, 0, 255, 9, 9, 9};
  const Bytes rgba{255, 0, 0, 0, 9, 9, 9, 255};
  const Bytes palette{10, 10, 10, 200, 200, 200};
  const Bytes indices{1, 0, 1};
  CHECK(decode_png(png_of(PNG_FORMAT_GRAY, 4, grey.data())).image.pixels == grey);
  CHECK(decode_png(png_of(PNG_FORMAT_GA, 2, grey_alpha.data())).image.pixels == Bytes{7, 100});
  // The eye's weights of red, green and blue: 0.299, 0.587, 0.114.
  CHECK(decode_png(png_of(PNG_FORMAT_RGB, 4, rgb.data())).image.pixels == Bytes{76, 150, 29, 9});
  CHECK(decode_png(png_of(PNG_FORMAT_RGBA, 2, rgba.data())).image.pixels == Bytes{76, 9});
  CHECK(decode_png(png_of(PNG_FORMAT_RGB_COLORMAP, 3, indices.data(), palette.data(), 2))
            .image.pixels == Bytes{200, 10, 200});
}

TEST_CASE("image codec: 16 bits a pixel and broken data are told apart", "[low_level][sonar]") {
  const std::uint16_t deep[]{1, 65535};
  CHECK(decode_png(png_of(PNG_FORMAT_LINEAR_Y, 2, deep)).fault == ImageFault::kNotEightBits);
  const Bytes pixels = ramp();
  Bytes png = encode_png({64, 32, pixels.data()});
  Bytes jpeg = encode_jpeg({64, 32, pixels.data()});
  CHECK(decode_png(png).fault == ImageFault::kNone);
  CHECK(decode_jpeg(jpeg).fault == ImageFault::kNone);
  png[png.size() / 2] ^= 0x5a;
  CHECK(decode_png(png).fault == ImageFault::kDamaged);
  jpeg.resize(jpeg.size() - 40);  // a decoder goes on with grey, and warns
  CHECK(decode_jpeg(jpeg).fault == ImageFault::kDamaged);
  CHECK(decode_png({}).fault == ImageFault::kDamaged);
  CHECK(decode_jpeg({}).fault == ImageFault::kDamaged);
}

TEST_CASE("image codec: what is drawn comes back, exactly or nearly so", "[low_level][sonar]") {
  const Bytes pixels = ramp();
  const DecodedImage exact = decode_png(encode_png({64, 32, pixels.data()}));
  const DecodedImage near = decode_jpeg(encode_jpeg({64, 32, pixels.data()}));
  REQUIRE(exact.image.columns == 64);
  REQUIRE(exact.image.rows == 32);
  REQUIRE(near.image.pixels.size() == exact.image.pixels.size());
  int worst = 0;
  for (std::size_t i = 0; i < exact.image.pixels.size(); ++i) {
    CHECK(exact.image.pixels[i] == pixels[3 * i]);
    worst = std::max(worst, std::abs(near.image.pixels[i] - pixels[3 * i]));
  }
  CHECK(worst <= 8);
}

TEST_CASE("image codec: a picture of no size is none", "[low_level][sonar]") {
  CHECK(encode_png({0, 0, nullptr}).empty());
  CHECK(encode_jpeg({0, 0, nullptr}).empty());
}

}  // namespace lodesman
