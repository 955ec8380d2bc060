// SPDX-License-Identifier: Apache-2.0
// Sonar views that tests look at: what to draw, and what was drawn where. Tests only, on their one
// thread.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>

#include "low_level/sonar/view_colours.h"
#include "low_level/sonar/view_image.h"
#include "tests/support/catch.h"
#include "tests/support/rgb_picture.h"

namespace lodesman::testing {

inline constexpr double kRange_m = 30.0;

[[nodiscard]] inline RgbPicture drawn(const ViewPicture& picture) {
  const auto bytes = encode_view(picture, ViewFormat::kPng);
  return RgbPicture{{reinterpret_cast<const char*>(bytes.data()), bytes.size()}};
}

// Of a place in the vehicle frame.
[[nodiscard]] inline int column_of(double x_m) {
  return static_cast<int>(std::lround(SonarView{kRange_m}.column_of(x_m)));
}
[[nodiscard]] inline int row_of(double y_m) {
  return static_cast<int>(std::lround(SonarView{kRange_m}.row_of(y_m)));
}
[[nodiscard]] inline ViewColour colour_at(const RgbPicture& picture, double x_m, double y_m) {
  return picture.at(column_of(x_m), row_of(y_m));
}
[[nodiscard]] inline int count_at(const RgbPicture& picture, double x_m, double y_m,
                                  const ViewColour& colour) {
  return picture.count_near(column_of(x_m), row_of(y_m), 2, colour);
}

[[nodiscard]] inline ViewColour tinted(const ViewColour& under, const ViewColour& tint,
                                       double opacity) {
  const auto mixed = [opacity](std::uint8_t a, std::uint8_t b) {
    return static_cast<std::uint8_t>(std::lround(a * (1.0 - opacity) + b * opacity));
  };
  return {mixed(under.red, tint.red), mixed(under.green, tint.green), mixed(under.blue, tint.blue)};
}

[[nodiscard]] inline ViewPicture chart(const SonarPing* ping = nullptr) {
  ViewPicture picture;
  picture.range_m = kRange_m;
  picture.look = ViewLook::kChart;
  picture.ping = ping;
  return picture;
}

// [-] The mean brightness, and the brightest, of the pixels round a place.
struct Light {
  double mean = 0.0;
  int most = 0;
};
[[nodiscard]] inline Light light_at(const RgbPicture& picture, double x_m, double y_m) {
  constexpr int kWithin = 9;  // so that a hatching's line is among them
  Light light;
  for (int row = row_of(y_m) - kWithin; row <= row_of(y_m) + kWithin; ++row) {
    for (int column = column_of(x_m) - kWithin; column <= column_of(x_m) + kWithin; ++column) {
      const int green = picture.at(column, row).green;
      light.mean += green;
      light.most = std::max(light.most, green);
    }
  }
  light.mean /= (2 * kWithin + 1) * (2 * kWithin + 1);
  return light;
}

// A mover of 0.3 m, 15 m ahead and 5 m to starboard of a boat at (10, 20) that heads east; its
// place is doubtful by 1 m along that heading and by 0.2 m across.
inline constexpr double kTrackX_m = 5.0;
inline constexpr double kTrackY_m = 15.0;
[[nodiscard]] inline VehiclePose boat() {
  return {{{10.0, 20.0}}, Heading::clockwise_from_y_rad(std::numbers::pi / 2.0)};
}
[[nodiscard]] inline std::unique_ptr<Tracks> one_mover() {
  auto tracks = std::make_unique<Tracks>();
  tracks->count = 1;
  Track& track = tracks->tracks[0];
  track.id = 7;
  track.shape.centre_x_m = 25.0;
  track.shape.centre_y_m = 15.0;
  track.shape.semi_axis_first_m = track.shape.semi_axis_second_m = 0.3;
  track.place_xx_m2 = 1.0;
  track.place_yy_m2 = 0.04;
  track.velocity_xx_m2_s2 = track.velocity_yy_m2_s2 = 0.001;
  return tracks;
}
// The same that surely goes north, to port, with 0.3 m/s.
[[nodiscard]] inline std::unique_ptr<Tracks> one_sure_mover() {
  auto tracks = one_mover();
  tracks->tracks[0].velocity_y_m_s = 0.3;
  REQUIRE(tracks->tracks[0].surely_moves());
  return tracks;
}
[[nodiscard]] inline ViewPicture picture_of(const Tracks& tracks) {
  ViewPicture picture = chart();
  picture.tracks = &tracks;
  picture.pose = boat();
  return picture;
}

}  // namespace lodesman::testing
