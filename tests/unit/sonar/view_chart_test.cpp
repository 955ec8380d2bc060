// SPDX-License-Identifier: Apache-2.0
// Sonar views as charts, but for their tracks: what is drawn where, in which colour.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>

#include "tests/unit/sonar/synthetic.h"
#include "tests/unit/sonar/view_bench.h"

namespace lodesman::testing {
namespace {

TEST_CASE(
    "view picture: on a chart water that nobody has seen is hatched, free water is as it was "
    "heard, and what is there has an orange tint",
    "[low_level][sonar]") {
  const auto ping = empty_ping();
  light(*ping, 40, [](double, double) { return true; });
  ViewPicture picture = chart(ping.get());
  const RgbPicture plain = drawn(picture);
  picture.water = [](const VehiclePoint& p) {
    return p.xy_m.x() < -2.0  ? WaterState::kFree
           : p.xy_m.x() > 2.0 ? WaterState::kOccupied
                              : WaterState::kUnknown;
  };
  const RgbPicture image = drawn(picture);
  const ViewColour heard = colour_at(plain, -5.0, 17.0);
  CHECK(RgbPicture::is_alike(colour_at(image, -5.0, 17.0), heard, 0));
  CHECK(RgbPicture::is_alike(colour_at(image, 5.0, 17.0),
                             tinted(heard, view_colours::kRests, view_colours::kRestsOpacity), 1));
  CHECK(light_at(image, 0.8, 17.0).mean < light_at(plain, 0.8, 17.0).mean);
  CHECK(light_at(image, 0.8, 17.0).most > light_at(image, 0.8, 17.0).mean + 10.0);
}

TEST_CASE("view picture: a brighter echo is brighter, seen or not", "[low_level][sonar]") {
  const auto ping = empty_ping();
  light(*ping, 20, [](double, double y) { return y < 17.0; });
  light(*ping, 120, [](double, double y) { return y >= 17.0; });
  for (const WaterState state : {WaterState::kFree, WaterState::kOccupied, WaterState::kUnknown}) {
    ViewPicture picture = chart(ping.get());
    picture.water = [state](const VehiclePoint&) { return state; };
    const RgbPicture image = drawn(picture);
    CHECK(light_at(image, 1.0, 18.0).mean > light_at(image, 1.0, 16.0).mean + 30.0);
  }
}

TEST_CASE("view picture: a chart's echoes are stretched, so that gain does not matter",
          "[low_level][sonar]") {
  const auto faint = empty_ping();
  const auto loud = empty_ping();
  for (const auto& [ping, gain] : {std::pair{faint.get(), 1}, std::pair{loud.get(), 4}}) {
    light(*ping, static_cast<std::uint8_t>(10 * gain), [](double, double) { return true; });
    light_disc(*ping, 17.0, 0.1, 1.0, static_cast<std::uint8_t>(50 * gain));
  }
  const auto contrast = [](const ViewPicture& picture) {
    const RgbPicture image = drawn(picture);
    return colour_at(image, 17.0 * std::sin(0.1), 17.0 * std::cos(0.1)).green -
           colour_at(image, -3.0, 17.0).green;
  };
  CHECK(contrast(chart(faint.get())) > 150);
  CHECK(std::abs(contrast(chart(faint.get())) - contrast(chart(loud.get()))) < 5);
  ViewPicture paper = chart(faint.get());
  paper.look = ViewLook::kPaper;
  CHECK(contrast(paper) < 75);
}

TEST_CASE("view picture: noise that is nothing else is not made bright", "[low_level][sonar]") {
  const auto ping = empty_ping();
  for (std::size_t i = 0; i < ping->echo_count; ++i) {
    ping->echo[i] = static_cast<std::uint8_t>(10 + i * 2654435761U % 5);
  }
  CHECK(light_at(drawn(chart(ping.get())), 3.0, 17.0).most < 110);
}

TEST_CASE("view picture: on a chart what one ping shows is a white outline, and a zone an edge",
          "[low_level][sonar]") {
  const auto seen = std::make_unique<SonarObstacles>();
  seen->count = 1;
  seen->obstacles[0].centre_x_m = kTrackX_m;
  seen->obstacles[0].centre_y_m = kTrackY_m;
  seen->obstacles[0].semi_axis_first_m = seen->obstacles[0].semi_axis_second_m = 1.0;
  seen->obstacles[0].protection_first_m = seen->obstacles[0].protection_second_m = 2.5;
  ViewPicture picture = chart();
  picture.obstacles = seen.get();
  RgbPicture image = drawn(picture);
  CHECK(light_at(image, kTrackX_m, kTrackY_m + 1.0).most > 150);  // fine and smooth
  CHECK(RgbPicture::is_alike(colour_at(image, kTrackX_m, kTrackY_m), view_colours::kFaintest, 0));
  CHECK(count_at(image, kTrackX_m, kTrackY_m + 2.5, view_colours::kZone) == 0);
  picture.zones = seen.get();
  image = drawn(picture);
  CHECK(count_at(image, kTrackX_m, kTrackY_m + 2.5, view_colours::kZone) > 0);
  CHECK(RgbPicture::is_alike(colour_at(image, kTrackX_m, kTrackY_m + 1.8), view_colours::kFaintest,
                             0));
}

TEST_CASE("view picture: the paper's look has neither tracks nor water", "[low_level][sonar]") {
  const auto ping = empty_ping();
  light_disc(*ping, 17.0, 0.1, 1.0);
  const auto tracks = one_sure_mover();
  ViewPicture picture;
  picture.range_m = kRange_m;
  picture.ping = ping.get();
  const auto plain = encode_view(picture, ViewFormat::kPng);
  picture.tracks = tracks.get();
  picture.pose = boat();
  picture.water = [](const VehiclePoint&) { return WaterState::kUnknown; };
  CHECK(encode_view(picture, ViewFormat::kPng) == plain);
  picture.look = ViewLook::kChart;
  CHECK(encode_view(picture, ViewFormat::kPng) != plain);
}

TEST_CASE("view picture: what is heard, seen and kept clear of stays in the fan",
          "[low_level][sonar]") {
  const auto ping = empty_ping(30.0, 180);
  ping->set_bearings(-std::numbers::pi / 2.0, std::numbers::pi / 180.0);
  std::fill_n(ping->echo.begin(), ping->echo_count, std::uint8_t{255});
  const auto seen = std::make_unique<SonarObstacles>();
  seen->count = 1;
  seen->obstacles[0].centre_y_m = 20.0;
  seen->obstacles[0].semi_axis_first_m = seen->obstacles[0].semi_axis_second_m = 60.0;
  seen->obstacles[0].protection_first_m = seen->obstacles[0].protection_second_m = 80.0;
  for (const ViewLook look : {ViewLook::kPaper, ViewLook::kChart}) {
    ViewPicture picture = chart(ping.get());
    picture.look = look;
    picture.zones = picture.obstacles = seen.get();
    picture.water = [](const VehiclePoint&) { return WaterState::kUnknown; };
    const RgbPicture image = drawn(picture);
    int outside = 0;
    for (int row = 60; row < 350; ++row) {  // between caption and legend
      for (int column = 0; column < kViewColumns; ++column) {
        // Smooth lines and labels are a little wider.
        const bool beside = in_fan(column, std::max(0, row - 3)) || in_fan(column, row + 24) ||
                            in_fan(std::max(0, column - 80), row) || in_fan(column + 3, row);
        if (!in_fan(column, row) && !beside &&
            !RgbPicture::is_alike(image.at(column, row), view_colours::kOutside, 0)) {
          ++outside;
        }
      }
    }
    CHECK(outside == 0);
  }
}

TEST_CASE("view picture: bright bins are those whose mean with their neighbours is so much",
          "[low_level][sonar]") {
  const auto ping = empty_ping();
  light_disc(*ping, 17.0, 0.1, 1.0, 60);
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
  const auto ping = empty_ping();
  light_disc(*ping, 17.0, 0.0, 0.5, 255);
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

TEST_CASE("view picture: any bytes give a picture, and the same ones the same",
          "[low_level][sonar]") {
  std::mt19937 random{11};
  const auto scramble = [&](auto& value, std::size_t bytes) {
    auto* first = reinterpret_cast<unsigned char*>(&value);
    std::generate_n(first, bytes, [&] { return static_cast<unsigned char>(random()); });
  };
  const auto ping = empty_ping();
  const auto seen = std::make_unique<SonarObstacles>();
  const auto tracks = std::make_unique<Tracks>();
  std::array<PathPixel, 50> path{};
  for (int i = 0; i < 40; ++i) {
    scramble(*ping, offsetof(SonarPing, points));
    ping->kind = i % 3 == 0 ? PingKind::kProfile : PingKind::kImage;
    if (i % 2 == 0) {
      ping->range_m = kRange_m;
      ping->make_image(static_cast<std::uint32_t>(1 + random() % kMaxBeams),
                       static_cast<std::uint32_t>(1 + random() % kMaxBins), 2.0);
      scramble(ping->echo, ping->echo_count);
    } else {
      scramble(ping->points, sizeof(ping->points));
    }
    scramble(*seen, sizeof(*seen));
    scramble(*tracks, sizeof(*tracks));
    scramble(path, sizeof(path));
    ViewPicture picture = picture_of(*tracks);
    picture.look = i % 4 == 0 ? ViewLook::kPaper : ViewLook::kChart;
    picture.ping = ping.get();
    picture.zones = picture.obstacles = seen.get();
    picture.path = path;
    scramble(picture.mounting, sizeof(picture.mounting));
    double x_m = 0.0;
    scramble(x_m, sizeof(x_m));
    picture.goal = VehiclePoint{{x_m, -x_m}};
    picture.caption = "\xff\n\n\x01 any";
    picture.water = [&](const VehiclePoint& p) {
      return static_cast<WaterState>(static_cast<int>(p.xy_m.x()) & 3);
    };
    const auto bytes = encode_view(picture, ViewFormat::kPng);
    CHECK_FALSE(bytes.empty());
    CHECK(encode_view(picture, ViewFormat::kPng) == bytes);
  }
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
  picture.water = [](const VehiclePoint&) { return WaterState::kFree; };
  const int of_both = right_corner();
  CHECK(of_both > of_tracks + 100);
  picture.tracks = nullptr;
  CHECK(right_corner() < of_both - 200);
}

}  // namespace
}  // namespace lodesman::testing
