// SPDX-License-Identifier: Apache-2.0
#include "low_level/sonar/view_image.h"

#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "tests/support/catch.h"
#include "tests/unit/sonar/synthetic.h"

namespace lodesman {
namespace {

// Width and height as a PNG's header says them.
std::pair<unsigned, unsigned> png_size(const std::vector<std::uint8_t>& png) {
  const auto word = [&](std::size_t at) {
    return (static_cast<unsigned>(png[at]) << 24U) | (static_cast<unsigned>(png[at + 1]) << 16U) |
           (static_cast<unsigned>(png[at + 2]) << 8U) | png[at + 3];
  };
  return {word(16), word(20)};
}

}  // namespace

TEST_CASE("view picture: 866 x 500, with and without everything", "[low_level][sonar]") {
  ViewPicture picture;
  picture.range_m = 30.0;
  const auto bare = encode_view(picture, ViewFormat::kPng);
  REQUIRE(bare.size() > 24);
  CHECK(png_size(bare) == std::pair{866U, 500U});

  const auto ping = testing::empty_ping();
  testing::light_disc(*ping, 10.0, 0.3, 1.0);
  const auto seen = std::make_unique<SonarObstacles>();
  Segmenter{testing::shipped_options()}.segment(*ping, *seen);
  const std::vector<PathPixel> path{{433, 499}, {433, 400}, {500, 333}};
  picture.ping = ping.get();
  picture.zones = picture.obstacles = seen.get();
  picture.path = path;
  picture.goal = VehiclePoint{{4.0, 10.0}};
  picture.caption = "26.0 s  frame 260\nfound";
  const auto full = encode_view(picture, ViewFormat::kPng);
  CHECK(png_size(full) == std::pair{866U, 500U});
  CHECK(full != bare);
  const auto jpeg = encode_view(picture, ViewFormat::kJpeg);
  REQUIRE(jpeg.size() > 2);
  CHECK(jpeg[0] == 0xFF);
  CHECK(jpeg[1] == 0xD8);
}

TEST_CASE("view picture: shapes that no view can hold are drawn cut off, or not at all",
          "[low_level][sonar]") {
  const auto seen = std::make_unique<SonarObstacles>();
  seen->count = 3;
  seen->obstacles[0].centre_x_m = std::nan("");
  seen->obstacles[1].shape = ObstacleShape::kPolygon;
  seen->obstacles[1].vertex_count = 3;
  seen->obstacles[1].vertices = {{{-1e300, 1.0}, {1e300, 1.0}, {0.0, 1e9}}};
  seen->obstacles[1].protection_first_m = 1e12;
  seen->obstacles[2].semi_axis_first_m = std::numeric_limits<double>::max();
  ViewPicture picture;
  picture.range_m = 30.0;
  picture.zones = picture.obstacles = seen.get();
  picture.goal = VehiclePoint{{1e200, -1e200}};
  CHECK_FALSE(encode_view(picture, ViewFormat::kPng).empty());
}

TEST_CASE("view picture: the returns of a profile are drawn, those outside the view are not",
          "[low_level][sonar]") {
  const auto empty = std::make_unique<SonarPing>();
  empty->range_m = 30.0;
  empty->make_image(120, 0, 2.0 * std::numbers::pi / 3.0);
  empty->kind = PingKind::kProfile;
  empty->point_count = 120;
  const auto ping = std::make_unique<SonarPing>(*empty);
  ping->points[90].range_m = 15.0;
  const ViewPicture nothing{.range_m = 30.0, .ping = empty.get()};
  const ViewPicture something{.range_m = 30.0, .ping = ping.get()};
  const auto bytes = encode_view(something, ViewFormat::kPng);
  CHECK_FALSE(bytes.empty());
  CHECK(bytes != encode_view(nothing, ViewFormat::kPng));
  ping->points[90].range_m = 31.0;  // not in the view
  CHECK(encode_view(something, ViewFormat::kPng) == encode_view(nothing, ViewFormat::kPng));
}

TEST_CASE("view picture: no range and no folder are said, not thrown", "[low_level][sonar]") {
  ViewPicture picture;
  CHECK(encode_view(picture, ViewFormat::kPng).empty());
  picture.range_m = 30.0;
  CHECK_FALSE(save_jpeg("no/such/folder/view.jpg", picture));
  CHECK_FALSE(save_png("no/such/folder/view.png", picture));
}

}  // namespace lodesman
