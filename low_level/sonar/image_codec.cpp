// SPDX-License-Identifier: Apache-2.0
#include "low_level/sonar/image_codec.h"

#include <png.h>
#include <turbojpeg.h>

#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace lodesman {
namespace {

constexpr int kJpegQuality = 92;
constexpr int kNoPadding = 0;  // of rows

using Bytes = std::vector<std::uint8_t>;

struct TurboEnd {
  void operator()(void* handle) const noexcept { tjDestroy(handle); }
};
using Turbo = std::unique_ptr<void, TurboEnd>;

// libpng's own description of a picture, and what it holds for it meanwhile.
struct PngImage : png_image {
  PngImage() : png_image{} { version = PNG_IMAGE_VERSION; }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;
  ~PngImage() { png_image_free(this); }
};

[[nodiscard]] DecodedImage room_for(std::uint32_t columns, std::uint32_t rows) {
  DecodedImage decoded{ImageFault::kNone, {columns, rows, {}}};
  decoded.image.pixels.resize(std::size_t{columns} * rows);
  return decoded;
}

}  // namespace

DecodedImage decode_png(std::span<const std::uint8_t> file) {
  PngImage png;
  if (png_image_begin_read_from_memory(&png, file.data(), file.size()) == 0) {
    return {};
  }
  if ((png.format & PNG_FORMAT_FLAG_LINEAR) != 0) {
    return {ImageFault::kNotEightBits, {}};
  }
  const bool coloured = (png.format & PNG_FORMAT_FLAG_COLOR) != 0;
  // With what is transparent beside the colour: libpng would mix it with a background.
  png.format = coloured ? PNG_FORMAT_RGBA : PNG_FORMAT_GA;
  // Round brackets: in curly ones these are the matrix's values.
  cv::Mat pixels(static_cast<int>(png.height), static_cast<int>(png.width),
                 coloured ? CV_8UC4 : CV_8UC2);
  if (png_image_finish_read(&png, nullptr, pixels.data, 0, nullptr) == 0) {
    return {};
  }
  DecodedImage decoded = room_for(png.width, png.height);
  cv::Mat grey{pixels.rows, pixels.cols, CV_8U, decoded.image.pixels.data()};
  if (coloured) {
    cv::cvtColor(pixels, grey, cv::COLOR_RGBA2GRAY);
  } else {
    cv::extractChannel(pixels, grey, 0);
  }
  return decoded;
}

DecodedImage decode_jpeg(std::span<const std::uint8_t> file) {
  const Turbo turbo{tjInitDecompress()};
  int columns = 0;
  int rows = 0;
  int subsampling = 0;
  int colours = 0;
  if (turbo == nullptr || tjDecompressHeader3(turbo.get(), file.data(), file.size(), &columns,
                                              &rows, &subsampling, &colours) != 0) {
    return {};
  }
  DecodedImage decoded =
      room_for(static_cast<std::uint32_t>(columns), static_cast<std::uint32_t>(rows));
  // A small file may ask for thousands of passes over a large picture.
  if (tjDecompress2(turbo.get(), file.data(), file.size(), decoded.image.pixels.data(), columns,
                    kNoPadding, rows, TJPF_GRAY, TJFLAG_LIMITSCANS) != 0) {
    return {};
  }
  return decoded;
}

std::vector<std::uint8_t> encode_png(const BgrPixels& picture) {
  PngImage png;
  png.width = static_cast<png_uint_32>(picture.columns);
  png.height = static_cast<png_uint_32>(picture.rows);
  png.format = PNG_FORMAT_BGR;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
  Bytes bytes(size);
  const int written =
      png_image_write_to_memory(&png, bytes.data(), &size, 0, picture.pixels, 0, nullptr);
  bytes.resize(written != 0 ? size : 0);
  return bytes;
}

std::vector<std::uint8_t> encode_jpeg(const BgrPixels& picture) {
  const Turbo turbo{tjInitCompress()};
  if (picture.columns < 1 || picture.rows < 1) {
    return {};
  }
  Bytes bytes(tjBufSize(picture.columns, picture.rows, TJSAMP_420));
  unsigned char* place = bytes.data();
  unsigned long size = bytes.size();
  if (turbo == nullptr || tjCompress2(turbo.get(), picture.pixels, picture.columns, kNoPadding,
                                      picture.rows, TJPF_BGR, &place, &size, TJSAMP_420,
                                      kJpegQuality, TJFLAG_NOREALLOC | TJFLAG_ACCURATEDCT) != 0) {
    size = 0;
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace lodesman
