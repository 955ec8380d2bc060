// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/sonar/detections.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "hal_sim/sonar/echo.h"
#include "mid_level/geometry/obstacle_distance.h"
#include "mid_level/messages/sane.h"
#include "tests/support/catch.h"

namespace lodesman {
namespace {

[[nodiscard]] MovingObstacle stone(double x_m, double y_m, double radius_m) {
  MovingObstacle mover;
  mover.at_start.centre_x_m = x_m;
  mover.at_start.centre_y_m = y_m;
  mover.at_start.semi_axis_first_m = mover.at_start.semi_axis_second_m = radius_m;
  return mover;
}

[[nodiscard]] MovingObstacle quay(double y_m) {
  MovingObstacle wall;
  wall.at_start.shape = ObstacleShape::kPolyline;
  wall.at_start.vertex_count = 2;
  wall.at_start.vertices[0] = {-50.0, y_m};
  wall.at_start.vertices[1] = {50.0, y_m};
  return wall;
}

// A head at rest at the origin, that looks at the same scene again and again.
struct Watch {
  Watch(const std::vector<MovingObstacle>& obstacles, const DetectionErrors& errors,
        std::uint64_t seed = 1)
      : scene{obstacles}, detections{obstacles.size(), errors, seed} {
    ping->range_m = 30.0;
    ping->make_profile(121, to_rad(121.0));  // a beam a degree, the sixtieth straight ahead
  }

  void look() {
    scene.observe({}, 0.0);
    detections.detect(scene, *ping);
  }
  [[nodiscard]] double range_m(std::uint32_t beam) const { return ping->points[beam].range_m; }
  [[nodiscard]] std::vector<std::uint32_t> beams_with_returns() const {
    std::vector<std::uint32_t> beams;
    for (std::uint32_t beam = 0; beam < ping->beams; ++beam) {
      if (range_m(beam) > 0.0) {
        beams.push_back(beam);
      }
    }
    return beams;
  }

  HeardScene scene;
  Detections detections;
  std::unique_ptr<SonarPing> ping = std::make_unique<SonarPing>();
};

struct Spread {
  int count = 0;
  double sum = 0.0;
  double squares = 0.0;

  void add(double value) {
    ++count;
    sum += value;
    squares += value * value;
  }
  [[nodiscard]] double mean() const { return sum / count; }
  [[nodiscard]] double sigma() const { return std::sqrt(squares / count - mean() * mean()); }
};

TEST_CASE("detections: returns lie on the nearest surface, and nowhere else", "[hal_sim][sonar]") {
  const std::vector<MovingObstacle> obstacles{quay(20.0), stone(2.0, 9.0, 1.0),
                                              stone(3.6, 12.0, 1.0), stone(0.0, 35.0, 1.0)};
  Watch watch{obstacles, {}};
  watch.look();
  REQUIRE(sane(*watch.ping));
  CHECK(watch.ping->fits());
  std::vector<int> returns_of(obstacles.size());
  for (std::uint32_t beam = 0; beam < watch.ping->beams; ++beam) {
    const double bearing_rad = watch.ping->bearing_rad(beam);
    const Eigen::Vector2d along{std::sin(bearing_rad), std::cos(bearing_rad)};
    double nearest_m = 30.0;
    std::size_t whose = obstacles.size();
    for (std::size_t i = 0; i < obstacles.size(); ++i) {
      const double range_m = ray_range_m(obstacles[i].at_start, {}, along);
      whose = range_m < nearest_m ? i : whose;
      nearest_m = std::min(nearest_m, range_m);
    }
    INFO("beam " << beam);
    if (whose == obstacles.size()) {
      CHECK(watch.range_m(beam) == Approx(0.0));
      continue;
    }
    ++returns_of[whose];
    CHECK(watch.range_m(beam) == Approx(nearest_m));
    CHECK(watch.ping->points[beam].intensity == kBrightestEcho);
    CHECK(edge_distance_m(obstacles[whose].at_start, {watch.range_m(beam) * along}) ==
          Approx(0.0).margin(1e-9));
  }
  CHECK(returns_of[0] > 50);
  CHECK(returns_of[1] > 10);
  CHECK(returns_of[2] > 0);  // half hidden by the one before
  CHECK(returns_of[2] < returns_of[1] / 2);
  CHECK(returns_of[3] == 0);  // behind the quay, out of range
}

TEST_CASE("detections: which obstacle a ray meets first is told", "[hal_sim][sonar]") {
  std::vector<MovingObstacle> obstacles{quay(20.0), stone(0.0, 9.0, 1.0), stone(0.0, 5.0, 1.0)};
  obstacles[2].appears_at_s = 10.0;
  HeardScene scene{obstacles};
  const std::vector<double> unturned(3);
  scene.observe({}, 0.0);
  CHECK(scene.nearest(0.0, unturned).obstacle == 1);
  CHECK(scene.nearest(0.0, unturned).range_m == Approx(8.0));
  CHECK(scene.nearest(0.5, unturned).obstacle == 0);
  CHECK(std::isinf(scene.nearest(3.0, unturned).range_m));
  scene.observe({}, 10.0);
  CHECK(scene.nearest(0.0, unturned).obstacle == 2);
  // Each turned by its own angle: the stones are out of the way.
  CHECK(scene.nearest(0.0, std::vector{0.0, 0.5, -0.5}).obstacle == 0);
  CHECK(scene.nearest(0.5, std::vector{0.0, 0.5, -0.5}).obstacle == 1);
}

TEST_CASE(
    "detections: an obstacle is missed in the share of the pings that was asked for, a few "
    "at a time",
    "[hal_sim][sonar]") {
  for (const double share : {0.05, 0.2, 0.6}) {
    Watch watch{{stone(0.0, 10.0, 0.6), quay(20.0)}, {.missed = share}};
    constexpr int kPings = 20000;
    int missed = 0;
    int times = 0;
    bool before = false;
    for (int i = 0; i < kPings; ++i) {
      watch.look();
      const bool now = !(watch.range_m(60) > 0.0);
      CHECK((now || watch.range_m(60) == Approx(9.4)));  // the quay behind it stays hidden
      missed += now ? 1 : 0;
      times += now && !before ? 1 : 0;
      before = now;
    }
    INFO("share " << share);
    // Pings of one time are alike, so that as many pings say less than that.
    CHECK(missed / (1.0 * kPings) == Approx(share).margin(4.0 * std::sqrt(2.5 * share / kPings)));
    CHECK(1.0 * missed / times > 1.9);
    CHECK((share > 0.5 || 1.0 * missed / times < 2.6));
  }
}

TEST_CASE("detections: each obstacle is missed by its own luck", "[hal_sim][sonar]") {
  Watch watch{{stone(-4.0, 10.0, 0.6), stone(4.0, 10.0, 0.6)}, {.missed = 0.3}};
  int both = 0;
  int left = 0;
  constexpr int kPings = 20000;
  for (int i = 0; i < kPings; ++i) {
    watch.look();
    const auto beams = watch.beams_with_returns();
    const bool has_left = std::any_of(beams.begin(), beams.end(), [](auto b) { return b < 60; });
    const bool has_right = std::any_of(beams.begin(), beams.end(), [](auto b) { return b > 60; });
    left += has_left ? 0 : 1;
    both += has_left || has_right ? 0 : 1;
  }
  CHECK(left / (1.0 * kPings) == Approx(0.3).margin(0.02));
  CHECK(both / (1.0 * kPings) == Approx(0.09).margin(0.015));
}

TEST_CASE("detections: a split obstacle has a hole of a few beams with returns on either side",
          "[hal_sim][sonar]") {
  Watch whole{{stone(0.0, 10.0, 1.5)}, {}};
  whole.look();
  const auto all = whole.beams_with_returns();
  REQUIRE(all.size() == 17);
  Watch watch{{stone(0.0, 10.0, 1.5)}, {.split = 0.3}};
  constexpr int kPings = 5000;
  int split = 0;
  std::vector<int> held(5);
  for (int i = 0; i < kPings; ++i) {
    watch.look();
    const auto beams = watch.beams_with_returns();
    REQUIRE(beams.front() == all.front());
    REQUIRE(beams.back() == all.back());
    const std::size_t hole = all.size() - beams.size();
    REQUIRE(hole <= 4);
    ++held[hole];
    std::size_t gaps = 0;
    for (std::size_t k = 1; k < beams.size(); ++k) {
      gaps += beams[k] != beams[k - 1] + 1 ? 1U : 0U;
    }
    CHECK(gaps == (hole > 0 ? 1U : 0U));
    split += hole > 0 ? 1 : 0;
  }
  CHECK(split / (1.0 * kPings) == Approx(0.3).margin(0.03));
  CHECK(held[1] == 0);
  CHECK(held[2] > 400);
  CHECK(held[3] > 400);
  CHECK(held[4] > 400);
}

TEST_CASE("detections: what has too few returns to fall in two stays whole", "[hal_sim][sonar]") {
  Watch thin{{stone(0.0, 20.0, 0.2)}, {.split = 1.0}};
  Watch slim{{stone(0.0, 14.0, 0.3)}, {.split = 1.0}};
  for (int i = 0; i < 100; ++i) {
    thin.look();
    CHECK(thin.beams_with_returns() == std::vector<std::uint32_t>{60});
    slim.look();
    CHECK(slim.beams_with_returns() == std::vector<std::uint32_t>{59, 61});
  }
}

TEST_CASE("detections: all returns of an obstacle are off together, and another's otherwise",
          "[hal_sim][sonar]") {
  Watch watch{{quay(20.0), stone(0.0, 9.0, 1.0)}, {.displaced_m = 0.4}};
  Spread quays;
  Spread stones;
  Spread products;
  std::vector<int> edges(4);  // which beams the stone reaches: turned by less than one
  for (int i = 0; i < 10000; ++i) {
    watch.look();
    // From the turned quay 20 m / cos(bearing + turn): the mean of both sides knows no turn.
    const double ahead_m = 0.5 * (watch.range_m(40) + watch.range_m(80));
    const double off_m = ahead_m - 20.0 / std::cos(to_rad(20.0));
    const double between_m = 0.5 * (watch.range_m(35) + watch.range_m(85));
    CHECK(between_m - 20.0 / std::cos(to_rad(25.0)) == Approx(off_m).margin(0.01));
    const double stone_m = watch.range_m(60) - 8.0;
    quays.add(off_m);
    stones.add(stone_m);
    products.add(off_m * stone_m);
    const auto is_stone = [&](std::uint32_t beam) { return watch.range_m(beam) < 14.0; };
    CHECK(is_stone(55));
    CHECK(is_stone(65));
    CHECK_FALSE(is_stone(52));
    CHECK_FALSE(is_stone(68));
    ++edges[(is_stone(53) ? 1U : 0U) + (is_stone(67) ? 2U : 0U)];
  }
  CHECK(quays.mean() == Approx(0.0).margin(0.02));
  CHECK(quays.sigma() == Approx(0.4).epsilon(0.05));
  CHECK(stones.mean() == Approx(0.0).margin(0.02));
  CHECK(stones.sigma() == Approx(0.4).epsilon(0.05));
  CHECK(products.mean() == Approx(0.0).margin(0.01));
  CHECK(edges[1] > 1500);  // to port, to starboard, never both
  CHECK(edges[2] > 1500);
  CHECK(edges[3] == 0);
}

TEST_CASE("detections: noise is each return's own", "[hal_sim][sonar]") {
  Watch watch{{quay(20.0)}, {.noise_m = 0.05}};
  Spread one;
  Spread apart;
  for (int i = 0; i < 10000; ++i) {
    watch.look();
    const double off_m = watch.range_m(60) - 20.0;
    one.add(off_m);
    apart.add(off_m * (watch.range_m(61) - 20.0 / std::cos(to_rad(1.0))));
  }
  CHECK(one.mean() == Approx(0.0).margin(0.003));
  CHECK(one.sigma() == Approx(0.05).epsilon(0.05));
  CHECK(apart.mean() == Approx(0.0).margin(1e-4));
}

}  // namespace
}  // namespace lodesman
