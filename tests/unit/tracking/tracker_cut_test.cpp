// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "tests/support/catch.h"
#include "tests/unit/tracking/tracker_bench.h"

namespace lodesman::testing {

TEST_CASE("tracker: what the end of the fan cuts off is not taken for motion",
          "[low_level][tracking]") {
  for (const double way : {-1.0, 1.0}) {
    TrackerBench bench;
    const Disc disc{0.0, 8.0, 1.0};
    for (int i = 0; i < 30; ++i) {
      bench.hear({{disc.x_m, disc.y_m + 0.11 * (3.0 - kTrackerPing_s * i), disc.radius_m}});
    }
    // The boat turns away until it is out of sight.
    for (int i = 0; i < 80; ++i) {
      bench.pose.heading = Heading::clockwise_from_y_rad(way * i * to_rad(1.0));
      bench.hear({{disc.x_m, disc.y_m - 0.011 * i, disc.radius_m}});
    }
    const double y_m = disc.y_m - 0.011 * 79;
    const Track* track = bench.track_at(disc.x_m, y_m);
    REQUIRE(track != nullptr);
    CHECK(std::abs(track->velocity_x_m_s) < 0.06);
    CHECK(std::abs(track->velocity_y_m_s + 0.11) < 0.06);
    CHECK(std::abs(track->shape.centre_x_m - disc.x_m) < 0.4);
  }
}

TEST_CASE("tracker: what comes in from the end of the fan was there before",
          "[low_level][tracking]") {
  for (const double way : {-1.0, 1.0}) {
    TrackerBench bench;
    const Disc disc{0.0, 8.0, 1.0};
    for (int i = 0; i < 60; ++i) {
      bench.pose.heading = Heading::clockwise_from_y_rad(way * to_rad(70.0 - 0.5 * i));
      bench.hear({disc});
    }
    const Track* track = bench.track_at(disc.x_m, disc.y_m);
    REQUIRE(track != nullptr);
    CHECK(speed_of(*track) < 0.12);
  }
}

TEST_CASE("tracker: what comes out from behind something nearer is not taken for motion",
          "[low_level][tracking]") {
  TrackerBench bench;
  // A stone at 6 m hides half of one at 12 m, and less of it as the boat goes sideways.
  for (int i = 0; i < 60; ++i) {
    bench.pose.p_WV.xy_m = {0.02 * i, 0.0};
    Obstacle far = bench.near_side_of(bench.pose.to_vehicle({{1.2, 12.0}}).xy_m, 1.0);
    const Eigen::Vector2d near = bench.pose.to_vehicle({{0.0, 6.0}}).xy_m;
    const double hidden_rad = std::atan2(near.x(), near.y()) + std::asin(0.7 / near.norm());
    const double range_m = std::hypot(far.centre_x_m, far.centre_y_m);
    const double end_rad = far.angle_rad + std::asin(far.semi_axis_second_m / range_m);
    const double from_rad =
        std::max(far.angle_rad - std::asin(far.semi_axis_second_m / range_m), hidden_rad);
    far.angle_rad = 0.5 * (from_rad + end_rad);
    far.centre_x_m = range_m * std::sin(far.angle_rad);
    far.centre_y_m = range_m * std::cos(far.angle_rad);
    far.semi_axis_second_m = range_m * std::sin(0.5 * (end_rad - from_rad));
    bench.hear({{0.0, 6.0, 0.7}}, &far);
  }
  const Track* track = bench.track_at(1.2, 12.0);
  REQUIRE(track != nullptr);
  CHECK(speed_of(*track) < 0.1);
}

}  // namespace lodesman::testing
