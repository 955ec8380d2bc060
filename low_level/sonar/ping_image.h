// SPDX-License-Identifier: Apache-2.0
// Sonar frames in image files: reads them and turns them into pings, whether their layout is polar
// or a fan. For commands and tests, on any thread that may block and throw.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "low_level/sonar/image_codec.h"
#include "mid_level/messages/sonar.h"

namespace lodesman {

// Far beyond any sonar frame, and little enough to decode on any machine.
inline constexpr std::uint64_t kMaxImagePixels = 64'000'000;

// An 8-bit PGM, PNG or JPEG. Throws StartupError `file:1: image: reason`.
[[nodiscard]] GreyImage read_grey_image(const std::filesystem::path& file);

// Polar: a column a beam, left to right; a row a range bin, row 0 nearest. `out` has its sector and
// range set.
// Throws StartupError naming `file` where the image has more beams or bins than a ping.
void polar_to_ping(const GreyImage& image, const std::filesystem::path& file, SonarPing& out);

// Where the head is in a fan image as displayed, and how many pixels the range setting takes.
struct FanGeometry {
  double apex_column_px = 0.0;
  double apex_row_px = 0.0;
  double radius_px = 0.0;     // [px] > 0
  bool range_upwards = true;  // apex at the bottom; else at the top, and left stays left
};

// The apex in the middle of the bottom (or top) row, and the whole height the range: what our own
// sonar view is.
[[nodiscard]] FanGeometry whole_image_fan(const GreyImage& image, bool apex_at_bottom) noexcept;

// Samples the fan at the centre of each polar bin, by bilinear interpolation, with a beam a degree
// and a bin a pixel of radius. `out` has its sector and range set; black lies outside the image.
void fan_to_ping(const GreyImage& image, const FanGeometry& fan, SonarPing& out) noexcept;

}  // namespace lodesman
