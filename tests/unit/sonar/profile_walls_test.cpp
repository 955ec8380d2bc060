// SPDX-License-Identifier: Apache-2.0
// What is long, in profiles.
#include "mid_level/geometry/obstacle_distance.h"
#include "tests/unit/sonar/profiles.h"

namespace lodesman {
namespace {

using testing::covers;
using testing::disc_at;
using testing::kNowhere;
using testing::profile_of;
using testing::seen_in;
using testing::shipped_options;
using testing::Surface;
using testing::uncovered;
using testing::wall_from;

[[nodiscard]] SegmentationOptions by_threshold() {
  SegmentationOptions options = shipped_options();
  options.method = DetectionMethod::kThreshold;
  return options;
}

TEST_CASE("profile: by contrast a wall is one line along its returns", "[low_level][sonar]") {
  for (const double noise_m : {0.0, shipped_options().profile.range_noise_m}) {
    for (const double slope : {0.0, 0.5, -1.0}) {
      const auto ping = profile_of({wall_from(-8.0, 12.0 - 8.0 * slope, 8.0, 12.0 + 8.0 * slope)},
                                   30.0, 120, noise_m);
      const auto seen = seen_in(*ping);
      INFO("slope " << slope << ", noise " << noise_m << " m");
      REQUIRE(seen->count == 1);
      const Obstacle& line = seen->obstacles[0];
      CHECK(line.shape == ObstacleShape::kPolyline);
      CHECK(line.peak == Approx(100.0));
      CHECK(line.protection_first_m == Approx(shipped_options().protection_margin_m));
      CHECK(line.centre_y_m == Approx(12.0 + slope * line.centre_x_m).margin(0.3));
      for (std::uint32_t beam = 0; beam < ping->beams; ++beam) {
        const double r = ping->points[beam].range_m;
        const double b = ping->bearing_rad(beam);
        if (r > 0.0) {
          const WorldPoint at{{r * std::sin(b), r * std::cos(b)}};
          CHECK(edge_distance_m(line, at) < 0.05 + 5.0 * noise_m);
        }
      }
    }
  }
}

TEST_CASE("profile: of a crooked wall the line keeps to its corners, as far as there is room",
          "[low_level][sonar]") {
  for (const int teeth : {6, 12, 25}) {  // a shape holds 32 corners
    const Surface crooked = [=](double bearing_rad) {
      const double turn = bearing_rad / to_rad(120.0) * teeth;
      return 8.0 + 0.6 * std::abs(turn - std::round(turn));
    };
    SegmentationOptions options = shipped_options();
    options.profile.range_noise_m = 0.02;
    const auto ping = profile_of({crooked}, 30.0, 480);
    const auto seen = seen_in(*ping, options);
    INFO(teeth << " teeth");
    REQUIRE(seen->count == 1);
    const Obstacle& line = seen->obstacles[0];
    const bool has_room = teeth <= 12;
    CHECK(line.vertex_count <= kMaxVertices);
    CHECK((line.vertex_count >= 2U * static_cast<std::uint32_t>(teeth)) == has_room);
    double worst_m = 0.0;
    for (std::uint32_t beam = 0; beam < ping->beams; ++beam) {
      const double r = ping->points[beam].range_m;
      const double b = ping->bearing_rad(beam);
      worst_m = std::max(worst_m, edge_distance_m(line, {{r * std::sin(b), r * std::cos(b)}}));
    }
    CHECK(worst_m < (has_room ? 0.12 : 0.35));
  }
}

TEST_CASE("profile: by threshold a wall is several short obstacles along it, with no gap between",
          "[low_level][sonar]") {
  for (const double slope : {0.0, 0.5, -1.0}) {
    const auto ping = profile_of({wall_from(-8.0, 12.0 - 8.0 * slope, 8.0, 12.0 + 8.0 * slope)});
    const auto seen = seen_in(*ping, by_threshold());
    INFO("slope " << slope);
    CHECK(seen->count >= 4);
    CHECK(uncovered(*ping, *seen, 0.1) == 0);
    for (std::uint32_t i = 0; i < seen->count; ++i) {
      CHECK(seen->obstacles[i].semi_axis_first_m <= 1.5);
      CHECK(seen->obstacles[i].semi_axis_second_m < 0.4);
    }
  }
}

TEST_CASE("profile: what stands before a wall is an obstacle of its own", "[low_level][sonar]") {
  const auto ping = profile_of({wall_from(-15.0, 20.0, 15.0, 20.0), disc_at(1.0, 8.0, 0.5)});
  const auto lines = seen_in(*ping);
  REQUIRE(lines->count == 3);  // the wall to its left and to its right
  CHECK(lines->obstacles[0].shape == ObstacleShape::kEllipse);
  CHECK(lines->obstacles[0].centre_y_m == Approx(7.6).margin(0.3));
  const auto seen = seen_in(*ping, by_threshold());
  REQUIRE(seen->count >= 3);
  const Obstacle& nearest = seen->obstacles[0];
  CHECK(nearest.centre_x_m == Approx(1.0).margin(0.3));
  CHECK(nearest.centre_y_m == Approx(7.6).margin(0.3));
  CHECK(nearest.semi_axis_first_m < 0.8);
  for (std::uint32_t i = 1; i < seen->count; ++i) {
    CHECK(seen->obstacles[i].centre_y_m == Approx(20.0).margin(0.3));
  }
  CHECK(uncovered(*ping, *seen, 0.15) == 0);
}

TEST_CASE("profile: a corner is followed by a line, or by short pieces", "[low_level][sonar]") {
  const auto ping = profile_of({wall_from(-6.0, 8.0, 0.0, 14.0), wall_from(0.0, 14.0, 6.0, 8.0)});
  const auto line = seen_in(*ping);
  REQUIRE(line->count == 1);
  CHECK(edge_distance_m(line->obstacles[0], {{0.0, 9.0}}) > 2.0);
  const auto seen = seen_in(*ping, by_threshold());
  CHECK(uncovered(*ping, *seen, 0.15) == 0);
  CHECK_FALSE(covers(*seen, 0.0, 9.0, 0.5));  // the water within it stays free
}

TEST_CASE("profile: noise of its returns does not part a surface", "[low_level][sonar]") {
  for (const std::uint32_t beams : {120U, 240U, 480U}) {
    const auto ping =
        profile_of({disc_at(0.0, 15.0, 2.0)}, 30.0, beams, shipped_options().profile.range_noise_m);
    SegmentationOptions options = shipped_options();
    options.max_obstacle_length_m = 10.0;
    options.min_fill = 0.0;
    INFO(beams << " beams");
    CHECK(seen_in(*ping, options)->count == 1);
  }
}

}  // namespace
}  // namespace lodesman
