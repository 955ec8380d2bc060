// SPDX-License-Identifier: Apache-2.0
// Sonar views of what is known beyond one ping: what is drawn where, in which colour.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "low_level/sonar/view_colours.h"
#include "low_level/sonar/view_image.h"
#include "tests/support/catch.h"
#include "tests/support/rgb_picture.h"
#include "tests/unit/sonar/synthetic.h"

namespace lodesman {
namespace {

using testing::RgbPicture;

constexpr double kRange_m = 30.0;

[[nodiscard]] RgbPicture drawn(const ViewPicture& picture) {
  const auto bytes = encode_view(picture, ViewFormat::kPng);
  return RgbPicture{{reinterpret_cast<const char*>(bytes.data()), bytes.size()}};
}

// Of a place in the vehicle frame.
[[nodiscard]] int column_of(double x_m) {
  return static_cast<int>(std::lround(SonarView{kRange_m}.column_of(x_m)));
}
[[nodiscard]] int row_of(double y_m) {
  return static_cast<int>(std::lround(SonarView{kRange_m}.row_of(y_m)));
}
[[nodiscard]] ViewColour colour_at(const RgbPicture& picture, double x_m, double y_m) {
  return picture.at(column_of(x_m), row_of(y_m));
}
[[nodiscard]] int count_at(const RgbPicture& picture, double x_m, double y_m,
                           const ViewColour& colour) {
  return picture.count_near(column_of(x_m), row_of(y_m), 2, colour);
}

[[nodiscard]] ViewColour tinted(std::uint8_t grey, const ViewColour& tint, double opacity) {
  const auto mixed = [&](std::uint8_t channel) {
    return static_cast<std::uint8_t>(std::lround(grey * (1.0 - opacity) + channel * opacity));
  };
  return {mixed(tint.red), mixed(tint.green), mixed(tint.blue)};
}

[[nodiscard]] bool is_grey(const ViewColour& colour) {
  return colour.red == colour.green && colour.green == colour.blue;
}

// A mover of 0.3 m, 15 m ahead and 5 m to starboard of a boat at (10, 20) that heads east; its
// place is doubtful by 1 m along that heading and by 0.2 m across.
constexpr double kTrackX_m = 5.0;
constexpr double kTrackY_m = 15.0;
[[nodiscard]] VehiclePose boat() {
  return {{{10.0, 20.0}}, Heading::clockwise_from_y_rad(std::numbers::pi / 2.0)};
}
[[nodiscard]] std::unique_ptr<Tracks> one_mover() {
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
[[nodiscard]] ViewPicture picture_of(const Tracks& tracks) {
  ViewPicture picture;
  picture.range_m = kRange_m;
  picture.tracks = &tracks;
  picture.pose = boat();
  return picture;
}

}  // namespace

TEST_CASE(
    "view picture: free water has a blue tint and occupied an orange one over grey echoes, which "
    "unknown water keeps",
    "[low_level][sonar]") {
  const auto ping = testing::empty_ping();
  testing::light(*ping, 40, [](double, double) { return true; });
  ViewPicture picture;
  picture.range_m = kRange_m;
  picture.ping = ping.get();
  picture.water = [](const VehiclePoint& p) {
    return p.xy_m.x() < -2.0  ? ViewWater::kFree
           : p.xy_m.x() > 2.0 ? ViewWater::kOccupied
                              : ViewWater::kUnknown;
  };
  const RgbPicture image = drawn(picture);
  const ViewColour unknown = colour_at(image, 1.0, 17.0);
  CHECK(is_grey(unknown));
  CHECK(RgbPicture::is_alike(colour_at(image, -5.0, 17.0),
                             tinted(unknown.red, view_colours::kFree, view_colours::kFreeOpacity),
                             1));
  CHECK(RgbPicture::is_alike(
      colour_at(image, 5.0, 17.0),
      tinted(unknown.red, view_colours::kOccupied, view_colours::kOccupiedOpacity), 1));

  picture.water = {};
  const ViewColour plain = colour_at(drawn(picture), -5.0, 17.0);
  CHECK_FALSE(is_grey(plain));  // one ping alone has the paper's shades
}

TEST_CASE("view picture: a brighter echo is a brighter grey under any tint", "[low_level][sonar]") {
  const auto ping = testing::empty_ping();
  testing::light(*ping, 20, [](double, double y) { return y < 17.0; });
  testing::light(*ping, 120, [](double, double y) { return y >= 17.0; });
  for (const ViewWater water : {ViewWater::kFree, ViewWater::kOccupied, ViewWater::kUnknown}) {
    ViewPicture picture;
    picture.range_m = kRange_m;
    picture.ping = ping.get();
    picture.water = [water](const VehiclePoint&) { return water; };
    const RgbPicture image = drawn(picture);
    const ViewColour dark = colour_at(image, 1.0, 16.5);
    const ViewColour bright = colour_at(image, 1.0, 17.5);
    CHECK(bright.green > dark.green + 30);
  }
}

TEST_CASE("view picture: the doubt about a track's place is an ellipse at two sigma",
          "[low_level][sonar]") {
  const auto tracks = one_mover();
  const RgbPicture image = drawn(picture_of(*tracks));
  // The east of the world is ahead of the boat.
  CHECK(count_at(image, kTrackX_m, kTrackY_m + 2.0, view_colours::kTrack) > 0);
  CHECK(count_at(image, kTrackX_m, kTrackY_m - 2.0, view_colours::kTrack) > 0);
  for (const double off_m : {-2.0, -1.0, 1.0, 2.0}) {
    CHECK(count_at(image, kTrackX_m + off_m, kTrackY_m, view_colours::kTrack) == 0);
  }
  CHECK(count_at(image, kTrackX_m, kTrackY_m + 2.5, view_colours::kTrack) == 0);
}

TEST_CASE("view picture: what surely moves has an arrow as long as its way in five seconds",
          "[low_level][sonar]") {
  const auto tracks = one_mover();
  tracks->tracks[0].velocity_y_m_s = 1.2;  // to the north: to port
  REQUIRE(tracks->tracks[0].surely_moves());
  const RgbPicture image = drawn(picture_of(*tracks));
  CHECK(count_at(image, kTrackX_m - 3.0, kTrackY_m, view_colours::kTrack) > 0);
  CHECK(count_at(image, kTrackX_m - 5.9, kTrackY_m, view_colours::kTrack) > 0);
  CHECK(count_at(image, kTrackX_m - 6.3, kTrackY_m, view_colours::kTrack) == 0);
  CHECK(count_at(image, kTrackX_m + 3.0, kTrackY_m, view_colours::kTrack) == 0);

  tracks->tracks[0].velocity_xx_m2_s2 = tracks->tracks[0].velocity_yy_m2_s2 = 1.0;
  REQUIRE_FALSE(tracks->tracks[0].surely_moves());
  CHECK(count_at(drawn(picture_of(*tracks)), kTrackX_m - 3.0, kTrackY_m, view_colours::kTrack) ==
        0);
}

TEST_CASE("view picture: a track is drawn where it is by the time of the picture",
          "[low_level][sonar]") {
  const auto tracks = one_mover();
  tracks->tracks[0].velocity_y_m_s = 1.0;
  tracks->captured = Time{from_seconds(4.0)};  // last seen 4 s before
  const RgbPicture image = drawn(picture_of(*tracks));
  CHECK(count_at(image, kTrackX_m - 4.0, kTrackY_m + 0.3, view_colours::kTrack) > 0);
  CHECK(count_at(image, kTrackX_m, kTrackY_m + 0.3, view_colours::kTrack) == 0);
}

TEST_CASE("view picture: what moves has its number beside it, and what rests is an orange area",
          "[low_level][sonar]") {
  const auto tracks = one_mover();
  const auto number = [&] {
    int pixels = 0;
    const RgbPicture image = drawn(picture_of(*tracks));
    for (int row = row_of(kTrackY_m) - 6; row <= row_of(kTrackY_m) + 6; ++row) {
      for (int column = column_of(kTrackX_m) + 8; column < column_of(kTrackX_m) + 40; ++column) {
        pixels += RgbPicture::is_alike(image.at(column, row), view_colours::kTrack, 60) ? 1 : 0;
      }
    }
    return pixels;
  };
  const int narrow = number();
  CHECK(narrow > 5);
  tracks->tracks[0].id = 777;
  CHECK(number() > 2 * narrow);

  Track& track = tracks->tracks[0];
  track.velocity_xx_m2_s2 = track.velocity_yy_m2_s2 = 0.0;
  track.shape.semi_axis_first_m = track.shape.semi_axis_second_m = 1.0;
  CHECK(number() == 0);
  const RgbPicture image = drawn(picture_of(*tracks));
  CHECK(RgbPicture::is_alike(
      colour_at(image, kTrackX_m, kTrackY_m),
      tinted(view_colours::kUnheard.red, view_colours::kOccupied, view_colours::kOccupiedOpacity),
      1));
  CHECK(count_at(image, kTrackX_m, kTrackY_m + 1.0, view_colours::kOccupied) > 0);
}

TEST_CASE("view picture: numbers of tracks side by side cover none of each other",
          "[low_level][sonar]") {
  const auto tracks = one_mover();
  tracks->tracks[0].id = 11;
  const auto pink = [](const RgbPicture& image) {
    return image.count_near(column_of(kTrackX_m), row_of(kTrackY_m), 60, view_colours::kTrack);
  };
  const int alone = pink(drawn(picture_of(*tracks)));
  tracks->count = 2;
  tracks->tracks[1] = tracks->tracks[0];
  const int twice = pink(drawn(picture_of(*tracks)));
  tracks->tracks[1].velocity_xx_m2_s2 = 0.0;  // rests, and has no number
  tracks->tracks[1].shape.semi_axis_first_m = tracks->tracks[1].shape.semi_axis_second_m = 0.01;
  CHECK(pink(drawn(picture_of(*tracks))) <= alone);
  CHECK(twice > alone + 10);  // the second number, on the other side
}

TEST_CASE("view picture: what one ping shows is a white outline over what is known",
          "[low_level][sonar]") {
  const auto tracks = std::make_unique<Tracks>();
  const auto seen = std::make_unique<SonarObstacles>();
  seen->count = 1;
  seen->obstacles[0].centre_x_m = kTrackX_m;
  seen->obstacles[0].centre_y_m = kTrackY_m;
  seen->obstacles[0].semi_axis_first_m = seen->obstacles[0].semi_axis_second_m = 1.0;
  seen->obstacles[0].protection_first_m = seen->obstacles[0].protection_second_m = 2.5;
  ViewPicture picture = picture_of(*tracks);
  picture.obstacles = seen.get();
  RgbPicture image = drawn(picture);
  CHECK(count_at(image, kTrackX_m, kTrackY_m + 1.0, view_colours::kWhite) > 0);
  CHECK(is_grey(colour_at(image, kTrackX_m, kTrackY_m)));
  CHECK(count_at(image, kTrackX_m, kTrackY_m + 2.5, view_colours::kZoneEdge) == 0);
  picture.zones = seen.get();
  image = drawn(picture);
  CHECK(count_at(image, kTrackX_m, kTrackY_m + 2.5, view_colours::kZoneEdge) > 0);
  CHECK(is_grey(colour_at(image, kTrackX_m, kTrackY_m + 1.8)));  // an edge, no area
}

TEST_CASE("view picture: bright bins are those whose mean with their neighbours is so much",
          "[low_level][sonar]") {
  const auto ping = testing::empty_ping();
  testing::light_disc(*ping, 17.0, 0.1, 1.0, 60);
  ping->echo[40 * 500 + 350] = 255;  // a speck: a ninth of it is 28
  ViewPicture picture;
  picture.range_m = kRange_m;
  picture.ping = ping.get();
  picture.bright_from = 50.0;
  const RgbPicture image = drawn(picture);
  const auto colour = [&](double range_m, double bearing_rad) {
    return colour_at(image, range_m * std::sin(bearing_rad), range_m * std::cos(bearing_rad));
  };
  CHECK(RgbPicture::is_alike(colour(17.0, 0.1), view_colours::kEcho, 2));
  CHECK(RgbPicture::is_alike(colour(ping->bin_range_m(350), ping->bearing_rad(40)),
                             view_colours::kWater, 2));
}

TEST_CASE("view picture: echoes lie where the head sits and looks", "[low_level][sonar]") {
  const auto ping = testing::empty_ping();
  testing::light_disc(*ping, 17.0, 0.0, 0.5, 255);
  ViewPicture picture;
  picture.range_m = kRange_m;
  picture.ping = ping.get();
  picture.mounting = {1.0, 2.0, 0.3};
  const RgbPicture image = drawn(picture);
  CHECK(
      RgbPicture::is_alike(colour_at(image, 1.0 + 17.0 * std::sin(0.3), 2.0 + 17.0 * std::cos(0.3)),
                           view_colours::kEcho, 2));
  CHECK(RgbPicture::is_alike(colour_at(image, 0.2, 17.0), view_colours::kWater, 2));
}

TEST_CASE("view picture: tracks that no view can hold are drawn cut off, or not at all",
          "[low_level][sonar]") {
  const auto tracks = one_mover();
  tracks->count = 5;
  tracks->tracks[1] = tracks->tracks[2] = tracks->tracks[3] = tracks->tracks[0];
  tracks->tracks[0].shape.centre_x_m = std::nan("");
  tracks->tracks[1].place_xx_m2 = -1.0;
  tracks->tracks[2].velocity_x_m_s = 1e300;
  tracks->tracks[3].place_yy_m2 = std::numeric_limits<double>::infinity();
  tracks->tracks[4].shape.shape = ObstacleShape::kPolygon;
  tracks->tracks[4].shape.vertex_count = 1000;
  CHECK_FALSE(encode_view(picture_of(*tracks), ViewFormat::kPng).empty());
  tracks->count = 1000;
  CHECK_FALSE(encode_view(picture_of(*tracks), ViewFormat::kPng).empty());
}

TEST_CASE("view picture: the legend names what is drawn", "[low_level][sonar]") {
  const auto tracks = std::make_unique<Tracks>();
  ViewPicture picture = picture_of(*tracks);
  const auto right_corner = [&] {
    const RgbPicture image = drawn(picture);
    int drawn_pixels = 0;
    for (int row = 360; row < image.rows(); ++row) {
      for (int column = 716; column < 860; ++column) {
        drawn_pixels +=
            RgbPicture::is_alike(image.at(column, row), view_colours::kOutside, 10) ? 0 : 1;
      }
    }
    return drawn_pixels;
  };
  const int of_tracks = right_corner();
  CHECK(of_tracks > 200);
  picture.water = [](const VehiclePoint&) { return ViewWater::kFree; };
  const int of_both = right_corner();
  CHECK(of_both > of_tracks + 200);
  picture.tracks = nullptr;
  CHECK(right_corner() < of_both - 200);
}

}  // namespace lodesman
