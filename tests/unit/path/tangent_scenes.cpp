// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>
#include <string>

#include "low_level/path/tangent_path.h"
#include "tests/support/catch.h"
#include "tests/support/data_dir.h"
#include "tests/unit/path/inscribed_bound.h"
#include "tests/unit/path/tangent_check.h"

namespace lodesman::testing {
namespace {

constexpr double kLongest = 1.003;  // times the bound

// Scenes from a seed: what a fan may hold, thin and overlapping and half outside.
class SceneMaker {
 public:
  explicit SceneMaker(std::uint32_t seed) : random_{seed} {}

  double between(double low, double high) {
    return std::uniform_real_distribution<double>{low, high}(random_);
  }
  int whole(int low, int high) { return std::uniform_int_distribution<int>{low, high}(random_); }
  PointPx point() { return {between(33.0, 833.0), between(0.0, 499.0)}; }

  EllipsePx ellipse(double thinnest) {
    return EllipsePx::with_angle(point(), between(5.0, 70.0), between(thinnest, 40.0),
                                 between(-4.0, 4.0));
  }
  EllipsePx needle() {
    return EllipsePx::with_angle(point(), between(20.0, 120.0), std::pow(10.0, between(-4.0, 0.3)),
                                 between(-4.0, 4.0));
  }
  WallPx wall(bool closed) {
    WallPx wall;
    wall.vertex_count = static_cast<std::uint32_t>(whole(1, 6));
    wall.radius = between(0.5, 12.0);
    wall.closed = closed;
    const PointPx middle = point();
    for (std::uint32_t i = 0; i < wall.vertex_count; ++i) {
      wall.vertices[i] = {middle.column + between(-70.0, 70.0), middle.row + between(-70.0, 70.0)};
    }
    return wall;
  }
  Zones zones(int count, int kind) {
    Zones zones;
    for (int i = 0; i < count; ++i) {
      switch (kind < 0 ? whole(0, 3) : kind) {
        case 0: zones.emplace_back(ellipse(2.0)); break;
        case 1: zones.emplace_back(needle()); break;
        case 2: zones.emplace_back(wall(false)); break;
        default: zones.emplace_back(wall(true)); break;
      }
    }
    return zones;
  }

 private:
  std::mt19937 random_;
};

struct Tally {
  int found = 0;
  int not_found = 0;
  int narrow = 0;  // longer than the bound allows, because of a passage that is all but closed
};

// The path is no shorter than the shortest among smaller shapes, and no longer than the one among
// larger shapes.
void require_shortest(const TangentResult& result, const Zones& zones, const RegionPx& region,
                      PointPx start, PointPx goal, Tally& tally) {
  const auto bound = inscribed_bound(zones, region, start, goal);
  if (result.reason == PathReason::kFound) {
    ++tally.found;
    require_sound(result, zones, region, start, goal);
    REQUIRE(bound);
    REQUIRE(result.length_px >= *bound * (1.0 - 1e-9));
    if (result.length_px <= *bound * kLongest) {
      return;
    }
  } else {
    REQUIRE(result.reason == PathReason::kNoPath);
    ++tally.not_found;
    if (!bound) {
      return;
    }
  }
  ++tally.narrow;
  const auto among_larger = inscribed_bound(grown_by_polygons(zones), region, start, goal);
  if (among_larger) {
    REQUIRE(result.reason == PathReason::kFound);
    REQUIRE(result.length_px <= *among_larger * kLongest);
  }
}

Tally try_scenes(std::uint32_t seed, int scenes, int most, int kind) {
  SceneMaker maker{seed};
  TangentPath planner;
  const RegionPx fan = RegionPx::fan();
  Tally tally;
  for (int scene = 0; scene < scenes; ++scene) {
    const Zones zones = maker.zones(maker.whole(1, most), kind);
    const PointPx start = scene % 2 == 0 ? PointPx{433.0, 499.0} : maker.point();
    const PointPx goal = maker.point();
    CAPTURE(seed, scene, zones.size(), start.column, start.row, goal.column, goal.row);
    const TangentResult result = planner.find(zones, fan, start, goal);
    REQUIRE(result.reason != PathReason::kLimit);
    if (result.reason == PathReason::kFound || result.reason == PathReason::kNoPath) {
      require_shortest(result, zones, fan, start, goal, tally);
    }
  }
  return tally;
}

TEST_CASE("tangent_path: among ellipses of every shape it is the shortest", "[low_level][path]") {
  const Tally tally = try_scenes(1, 120, 14, 0);
  REQUIRE(tally.found > 40);
  REQUIRE(tally.narrow <= 1);
}

TEST_CASE("tangent_path: among needles it is the shortest", "[low_level][path]") {
  const Tally tally = try_scenes(102, 300, 14, 1);
  REQUIRE(tally.found > 40);
  REQUIRE(tally.narrow <= 1);
}

TEST_CASE("tangent_path: among walls it is the shortest", "[low_level][path]") {
  const Tally open = try_scenes(3, 50, 6, 2);
  REQUIRE(open.found > 15);
  const Tally closed = try_scenes(4, 50, 6, 3);
  REQUIRE(closed.found > 10);
  REQUIRE(open.narrow + closed.narrow <= 1);
}

TEST_CASE("tangent_path: among everything at once it is the shortest", "[low_level][path]") {
  const Tally tally = try_scenes(105, 150, 12, -1);
  REQUIRE(tally.found > 10);
  REQUIRE(tally.narrow <= 1);
}

TEST_CASE("tangent_path: through a ring of shapes only where it has a gap", "[low_level][path]") {
  SceneMaker maker{8};
  TangentPath planner;
  const RegionPx fan = RegionPx::fan();
  Tally tally;
  for (int scene = 0; scene < 60; ++scene) {
    const PointPx goal{maker.between(383.0, 483.0), maker.between(150.0, 250.0)};
    Zones zones;
    for (int k = 0; k < 12; ++k) {
      const double t = k * std::numbers::pi / 6.0 + maker.between(-0.02, 0.02);
      zones.emplace_back(EllipsePx::with_angle(
          {goal.column + 70.0 * std::cos(t), goal.row + 70.0 * std::sin(t)},
          maker.between(17.0, 30.0), maker.between(2.0, 10.0), t + std::numbers::pi / 2));
    }
    CAPTURE(scene);
    const TangentResult result = planner.find(zones, fan, {433.0, 499.0}, goal);
    require_shortest(result, zones, fan, {433.0, 499.0}, goal, tally);
  }
  REQUIRE(tally.found > 20);
  REQUIRE(tally.not_found > 10);
  REQUIRE(tally.narrow <= 2);
}

TEST_CASE("tangent_path: as many zones as a message holds", "[low_level][path]") {
  SceneMaker maker{6};
  TangentPath planner;
  const RegionPx fan = RegionPx::fan();
  Tally tally;
  for (int scene = 0; scene < 6; ++scene) {
    Zones zones;
    while (zones.size() < kMaxObstacles) {
      const EllipsePx small = EllipsePx::with_angle(maker.point(), maker.between(3.0, 14.0),
                                                    maker.between(3.0, 14.0), 0.7);
      if (!touches(small, {433.0, 499.0}, {433.0, 479.0}) &&
          !touches(small, {433.0, 40.0}, {433.0, 20.0})) {
        zones.emplace_back(small);
      }
    }
    CAPTURE(scene);
    const TangentResult result = planner.find(zones, fan, {433.0, 499.0}, {433.0, 30.0});
    require_shortest(result, zones, fan, {433.0, 499.0}, {433.0, 30.0}, tally);
  }
  REQUIRE(tally.found > 3);
}

TEST_CASE("tangent_path: the same question has the same answer, whatever was asked before",
          "[low_level][path]") {
  SceneMaker maker{7};
  TangentPath used;
  const RegionPx fan = RegionPx::fan();
  for (int scene = 0; scene < 30; ++scene) {
    const Zones zones = maker.zones(10, -1);
    const PointPx goal = maker.point();
    TangentPath fresh;
    const TangentResult first = fresh.find(zones, fan, {433.0, 499.0}, goal);
    const TangentResult second = used.find(zones, fan, {433.0, 499.0}, goal);
    REQUIRE(first.reason == second.reason);
    REQUIRE(first.tried == second.tried);
    REQUIRE(std::equal(first.path.begin(), first.path.end(), second.path.begin(), second.path.end(),
                       [](PointPx a, PointPx b) {
                         return std::equal_to<>{}(a.column, b.column) &&
                                std::equal_to<>{}(a.row, b.row);
                       }));
  }
}

TEST_CASE("tangent_path: every planner frame has its shortest path", "[low_level][path]") {
  const auto file = data_path("planner_frames/frames.jsonl");
  if (!file) {
    return;
  }
  TangentPath planner;
  const RegionPx fan = RegionPx::fan();
  std::ifstream lines{*file};
  std::string line;
  int found = 0;
  double excess = 0.0;
  while (std::getline(lines, line)) {
    const auto frame = nlohmann::json::parse(line);
    CAPTURE(frame.at("id").get<int>(), frame.at("category").get<std::string>());
    Zones zones;
    for (const auto& o : frame.at("obstacles")) {
      zones.emplace_back(
          EllipsePx::with_angle({o.at("cx"), o.at("cy")}, o.at("a"), o.at("b"), o.at("theta_rad")));
    }
    const PointPx start{frame.at("start_px").at(0), frame.at("start_px").at(1)};
    const PointPx goal{frame.at("goal_px").at(0), frame.at("goal_px").at(1)};
    const TangentResult result = planner.find(zones, fan, start, goal);
    // None of these frames has a passage that only one of grid and shapes takes for open.
    REQUIRE((result.reason == PathReason::kFound) == !frame.at("cost_10_14").is_null());
    if (result.reason != PathReason::kFound) {
      REQUIRE(result.reason == PathReason::kNoPath);
      continue;
    }
    require_sound(result, zones, fan, start, goal);
    const auto bound = inscribed_bound(zones, fan, start, goal);
    REQUIRE(bound);
    const double ratio = result.length_px / *bound;
    REQUIRE(ratio >= 1.0 - 1e-9);
    REQUIRE(ratio <= 1.0005);
    excess += ratio - 1.0;
    ++found;
  }
  REQUIRE(found == 180);
  REQUIRE(excess / found <= 0.0001);
}

}  // namespace
}  // namespace lodesman::testing
