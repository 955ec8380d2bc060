// SPDX-License-Identifier: Apache-2.0
// What is drawn of tracks on a chart.
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/unit/sonar/view_bench.h"

namespace lodesman::testing {
namespace {

TEST_CASE("view picture: the doubt about where one is that moves is an ellipse at two sigma",
          "[low_level][sonar]") {
  const auto tracks = one_sure_mover();
  const RgbPicture image = drawn(picture_of(*tracks));
  // The east of the world is ahead of the boat.
  CHECK(count_at(image, kTrackX_m, kTrackY_m + 2.0, view_colours::kTrack) > 0);
  CHECK(count_at(image, kTrackX_m, kTrackY_m - 2.0, view_colours::kTrack) > 0);
  CHECK(count_at(image, kTrackX_m, kTrackY_m + 2.5, view_colours::kTrack) == 0);
  CHECK(count_at(image, kTrackX_m - 2.0, kTrackY_m, view_colours::kTrack) == 0);
  const auto doubt =
      tinted(view_colours::kFaintest, view_colours::kTrack, view_colours::kDoubtOpacity);
  CHECK(RgbPicture::is_alike(colour_at(image, kTrackX_m, kTrackY_m + 1.2), doubt, 1));
  CHECK(RgbPicture::is_alike(colour_at(image, kTrackX_m + 0.6, kTrackY_m + 1.2),
                             view_colours::kFaintest, 1));
}

TEST_CASE("view picture: what may move and may not is dashed", "[low_level][sonar]") {
  const auto tracks = one_mover();
  Track& track = tracks->tracks[0];
  track.shape.semi_axis_first_m = track.shape.semi_axis_second_m = 3.0;
  const auto drawn_share = [&] {
    const RgbPicture image = drawn(picture_of(*tracks));
    int drawn_places = 0;
    constexpr int kPlaces = 360;
    for (int i = 0; i < kPlaces; ++i) {
      const double turn = 2.0 * std::numbers::pi * i / kPlaces;
      drawn_places +=
          image.count_near(column_of(kTrackX_m + 3.0 * std::sin(turn)),
                           row_of(kTrackY_m + 3.0 * std::cos(turn)), 0, view_colours::kTrack) > 0
              ? 1
              : 0;
    }
    return static_cast<double>(drawn_places) / kPlaces;
  };
  const double dashed = drawn_share();
  CHECK(dashed > 0.3);
  CHECK(dashed < 0.8);
  track.velocity_y_m_s = 0.3;
  CHECK(drawn_share() > 0.9);
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
  CHECK(count_at(image, kTrackX_m + 5.9, kTrackY_m, view_colours::kTrack) == 0);

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
      tinted(view_colours::kFaintest, view_colours::kRests, view_colours::kRestsOpacity), 1));
  CHECK(count_at(image, kTrackX_m, kTrackY_m + 1.0, view_colours::kRests) > 0);
}

TEST_CASE("view picture: numbers of tracks side by side cover none of each other",
          "[low_level][sonar]") {
  const auto tracks = one_mover();
  tracks->tracks[0].id = 11;
  const auto lines = [](const RgbPicture& image) {
    return image.count_near(column_of(kTrackX_m), row_of(kTrackY_m), 60, view_colours::kTrack);
  };
  const int alone = lines(drawn(picture_of(*tracks)));
  tracks->count = 2;
  tracks->tracks[1] = tracks->tracks[0];
  const int twice = lines(drawn(picture_of(*tracks)));
  tracks->tracks[1].velocity_xx_m2_s2 = 0.0;  // rests, and has no number
  tracks->tracks[1].shape.semi_axis_first_m = tracks->tracks[1].shape.semi_axis_second_m = 0.01;
  CHECK(lines(drawn(picture_of(*tracks))) <= alone);
  CHECK(twice > alone + 10);  // the second number, on the other side
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

}  // namespace
}  // namespace lodesman::testing
