// SPDX-License-Identifier: Apache-2.0
#include "low_level/sonar/ping_image.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "low_level/sonar/image_structure.h"
#include "mid_level/base/heading.h"
#include "mid_level/base/startup_error.h"

namespace lodesman {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::string_view kPng = "\x89PNG\r\n\x1a\n";
constexpr std::string_view kJpeg = "\xFF\xD8\xFF";

constexpr std::uint64_t kMaxImageBytes = 64U << 20U;

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& reason) {
  throw StartupError{file.string(), 1, "image", reason};
}

Bytes read_bytes(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) {
    refuse(file, "no such file");
  }
  if (std::filesystem::file_size(file, error) > kMaxImageBytes) {
    refuse(file, "is larger than 64 MiB");
  }
  std::ifstream stream{file, std::ios::binary};
  Bytes bytes{std::istreambuf_iterator<char>{stream}, std::istreambuf_iterator<char>{}};
  if (stream.bad() || bytes.empty()) {
    refuse(file, bytes.empty() ? "empty or unreadable" : "cannot be read");
  }
  return bytes;
}

bool starts_with(const Bytes& bytes, std::string_view magic) {
  return bytes.size() >= magic.size() &&
         std::equal(magic.begin(), magic.end(), bytes.begin(),
                    [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
}

// A number of a PGM's header, after white space and comments.
std::uint32_t pgm_number(const Bytes& bytes, std::size_t& at, const std::filesystem::path& file) {
  constexpr std::size_t kMaxDigits = 6;
  const auto is_space = [](std::uint8_t c) { return c == ' ' || (c >= '\t' && c <= '\r'); };
  while (at < bytes.size() && (is_space(bytes[at]) || bytes[at] == '#')) {
    if (bytes[at] == '#') {
      at = static_cast<std::size_t>(
          std::find(bytes.begin() + static_cast<std::ptrdiff_t>(at), bytes.end(), '\n') -
          bytes.begin());
    } else {
      ++at;
    }
  }
  std::uint32_t number = 0;
  std::size_t digits = 0;
  while (at < bytes.size() && bytes[at] >= '0' && bytes[at] <= '9' && digits < kMaxDigits) {
    number = 10 * number + (bytes[at++] - std::uint32_t{'0'});
    ++digits;
  }
  if (digits == 0 || number == 0) {
    refuse(file, "the PGM header is damaged");
  }
  return number;
}

GreyImage decode_pgm(const Bytes& bytes, const std::filesystem::path& file) {
  std::size_t at = 2;  // after "P5"
  GreyImage image;
  image.columns = pgm_number(bytes, at, file);
  image.rows = pgm_number(bytes, at, file);
  const std::uint32_t white = pgm_number(bytes, at, file);
  if (white > 255) {
    refuse(file, "must have 8 bits a pixel");
  }
  ++at;  // one white space
  const std::size_t size = std::size_t{image.columns} * image.rows;
  if (at > bytes.size() || bytes.size() - at < size) {
    refuse(file, "the image is truncated");
  }
  image.pixels.reserve(size);
  for (std::size_t i = 0; i < size; ++i) {
    const std::uint32_t value = std::min<std::uint32_t>(bytes[at + i], white);
    image.pixels.push_back(static_cast<std::uint8_t>(value * 255 / white));
  }
  return image;
}

// [px] of arc at full range that one beam stands for, where that is finer than a degree.
constexpr double kArcOfBeam_px = 2.0;

double pixel(const GreyImage& image, double column, double row) noexcept {
  if (!(column >= 0.0 && row >= 0.0 && column <= image.columns - 1.0 && row <= image.rows - 1.0)) {
    return 0.0;
  }
  const auto c0 = static_cast<std::size_t>(column);
  const auto r0 = static_cast<std::size_t>(row);
  const std::size_t c1 = std::min<std::size_t>(c0 + 1, image.columns - 1);
  const std::size_t r1 = std::min<std::size_t>(r0 + 1, image.rows - 1);
  const double u = column - static_cast<double>(c0);
  const double v = row - static_cast<double>(r0);
  const auto at = [&](std::size_t c, std::size_t r) {
    return static_cast<double>(image.pixels[r * image.columns + c]);
  };
  return (1.0 - v) * ((1.0 - u) * at(c0, r0) + u * at(c1, r0)) +
         v * ((1.0 - u) * at(c0, r1) + u * at(c1, r1));
}

}  // namespace

GreyImage read_grey_image(const std::filesystem::path& file) {
  const Bytes bytes = read_bytes(file);
  if (starts_with(bytes, "P5")) {
    return decode_pgm(bytes, file);
  }
  if (!starts_with(bytes, kPng) && !starts_with(bytes, kJpeg)) {
    refuse(file, "not a binary PGM, PNG or JPEG image");
  }
  if (declared_pixels(bytes) > kMaxImagePixels) {
    refuse(file, "must have at most 64 million pixels");
  }
  if (!is_whole(bytes)) {
    refuse(file, "the image is truncated");
  }
  DecodedImage decoded = starts_with(bytes, kPng) ? decode_png(bytes) : decode_jpeg(bytes);
  if (decoded.fault != ImageFault::kNone) {
    refuse(file, decoded.fault == ImageFault::kDamaged ? "the image is damaged"
                                                       : "must have 8 bits a pixel");
  }
  return std::move(decoded.image);
}

void polar_to_ping(const GreyImage& image, const std::filesystem::path& file, SonarPing& out) {
  if (image.columns > kMaxBeams || image.rows > kMaxBins) {
    refuse(file, std::to_string(image.columns) + " x " + std::to_string(image.rows) +
                     " pixels: a polar image has at most " + std::to_string(kMaxBeams) +
                     " beams x " + std::to_string(kMaxBins) + " bins; is it --layout fan?");
  }
  out.make_image(image.columns, image.rows, out.sector_rad);
  for (std::uint32_t beam = 0; beam < out.beams; ++beam) {
    for (std::uint32_t bin = 0; bin < out.bins; ++bin) {
      out.echo[beam * out.bins + bin] = image.pixels[bin * image.columns + beam];
    }
  }
}

FanGeometry whole_image_fan(const GreyImage& image, bool apex_at_bottom) noexcept {
  const std::uint32_t middle = image.columns / 2;  // 433 of 866, as in our own view
  return {static_cast<double>(middle), apex_at_bottom ? image.rows - 1.0 : 0.0,
          static_cast<double>(image.rows), apex_at_bottom};
}

void fan_to_ping(const GreyImage& image, const FanGeometry& fan, SonarPing& out) noexcept {
  const double beams = std::max(std::round(to_deg(out.sector_rad)),
                                std::round(out.sector_rad * fan.radius_px / kArcOfBeam_px));
  out.make_image(static_cast<std::uint32_t>(std::clamp(beams, 1.0, static_cast<double>(kMaxBeams))),
                 static_cast<std::uint32_t>(
                     std::clamp(std::round(fan.radius_px), 1.0, static_cast<double>(kMaxBins))),
                 out.sector_rad);
  const double down = fan.range_upwards ? -1.0 : 1.0;
  for (std::uint32_t beam = 0; beam < out.beams; ++beam) {
    const double s = std::sin(out.bearing_rad(beam));
    const double c = std::cos(out.bearing_rad(beam));
    for (std::uint32_t bin = 0; bin < out.bins; ++bin) {
      const double r = fan.radius_px * (bin + 0.5) / out.bins;
      const double echo = pixel(image, fan.apex_column_px + r * s, fan.apex_row_px + down * r * c);
      out.echo[beam * out.bins + bin] = static_cast<std::uint8_t>(std::lround(echo));
    }
  }
}

}  // namespace lodesman
