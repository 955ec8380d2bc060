// SPDX-License-Identifier: Apache-2.0
#include "low_level/tracking/still_shapes.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "mid_level/geometry/obstacle_distance.h"
#include "mid_level/messages/sane.h"
#include "tests/support/allocations.h"
#include "tests/support/catch.h"
#include "tests/unit/tracking/grid_watch.h"

namespace lodesman {
namespace {

using testing::GridWatch;
using testing::occupied_places;
using testing::Place;
using testing::stone_at;
using testing::strip_along;

bool all_held(const EvidenceGrid& grid, std::span<const Obstacle> shapes) {
  const std::vector<Place> cells = occupied_places(grid);
  return std::all_of(cells.begin(), cells.end(), [&](const Place& p) {
    return std::any_of(shapes.begin(), shapes.end(),
                       [&](const Obstacle& o) { return encloses(o, p); });
  });
}

std::vector<std::uint32_t> ids_of(std::span<const Obstacle> shapes) {
  std::vector<std::uint32_t> out;
  for (const Obstacle& o : shapes) {
    out.push_back(o.id);
  }
  std::sort(out.begin(), out.end());
  return out;
}

bool all_differ(const std::vector<std::uint32_t>& sorted_ids) {
  return std::adjacent_find(sorted_ids.begin(), sorted_ids.end()) == sorted_ids.end();
}

bool sound_still(const Obstacle& o) {
  return sane(o) && o.fits() && o.shape == ObstacleShape::kPolygon && o.vertex_count >= 4 &&
         (o.id & StillShapes::kIdBit) != 0 && encloses(o, {o.centre_x_m, o.centre_y_m});
}

}  // namespace
TEST_CASE("still shapes: a wall is held by polygons whose ids stay", "[low_level][tracking]") {
  for (const double along_deg : {0.0, 20.0, 45.0, 90.0}) {
    GridWatch watch;
    StillShapes still;
    const Place along = first_axis(to_rad(along_deg));
    const Obstacle wall = strip_along({-10.0, 5.0}, Place{-10.0, 5.0} + 20.0 * along, 0.4);
    watch.hit(wall);  // once
    const auto shapes = still.trace(watch.grid(), {0.0, 0.0}, kMaxObstacles);
    CHECK(shapes.size() >= 7);
    CHECK(shapes.size() <= 16);
    CHECK(std::all_of(shapes.begin(), shapes.end(), sound_still));
    CHECK(all_held(watch.grid(), shapes));
    const auto ids = ids_of(shapes);
    CHECK(all_differ(ids));
    watch.go_to(0.3, 1.7);
    watch.see(2.0);
    watch.hit(wall);
    CHECK(ids_of(still.trace(watch.grid(), {0.3, 1.7}, kMaxObstacles)) == ids);
  }
}

TEST_CASE("still shapes: the water between two stones stays free, nearest first",
          "[low_level][tracking]") {
  GridWatch watch;
  StillShapes still;
  watch.hit(stone_at(-1.5, 10.0, 0.6));
  watch.hit(stone_at(1.2, 10.0, 0.6));
  watch.hit(stone_at(-20.0, -20.0, 0.6));
  const auto shapes = still.trace(watch.grid(), {1.0, 0.0}, kMaxObstacles);
  REQUIRE(shapes.size() >= 3);
  for (double y = 8.0; y < 12.0; y += 0.1) {
    for (const Obstacle& o : shapes) {
      CHECK(edge_distance_m(o, {{-0.15, y}}) > 0.4);
    }
  }
  CHECK(edge_distance_m(shapes.front(), {{1.2, 10.0}}) <= 0.0);
  CHECK(shapes.back().centre_y_m < -18.0);
}

TEST_CASE("still shapes: a lone cell counts from its second hit", "[low_level][tracking]") {
  GridWatch watch;
  StillShapes still;
  for (const std::size_t hits : {1U, 2U}) {
    watch.see(0.0);
    watch.hit(stone_at(7.6, 7.6, 0.05));
    CHECK(watch.at(7.6, 7.6) == WaterState::kOccupied);
    CHECK(still.trace(watch.grid(), {0.0, 0.0}, 8).size() == hits - 1);
  }
  // Across a tile's border it is not alone.
  watch.grid().forget();
  watch.see(0.0);
  watch.hit(stone_at(2.9, 1.1, 0.05));
  watch.hit(stone_at(3.1, 1.4, 0.05));
  CHECK(still.trace(watch.grid(), {0.0, 0.0}, 8).size() == 2);
}

TEST_CASE(
    "still shapes: of more than fit the far are taken together and none "
    "is left out",
    "[low_level][tracking]") {
  std::mt19937 random{11};
  std::uniform_real_distribution<double> off{-39.0, 39.0};
  for (int round = 0; round < 12; ++round) {
    GridWatch watch;
    StillShapes still;
    const Place at{20.0 * off(random), 20.0 * off(random)};
    watch.go_to(at.x(), at.y());
    const double spread = std::pow(0.5, round % 3);
    std::vector<Obstacle> stones{stone_at(at.x() + 0.8, at.y() + 1.0, 0.3)};
    while (stones.size() < 400) {
      const Place p = spread * Place{off(random), off(random)};
      if (p.norm() > 3.0) {
        stones.push_back(stone_at(at.x() + p.x(), at.y() + p.y(), round % 2 == 0 ? 0.4 : 0.01));
      }
    }
    for (int hits = 0; hits < 2; ++hits) {
      watch.see(0.0);
      std::for_each(stones.begin(), stones.end(), [&](const Obstacle& o) { watch.hit(o); });
    }
    for (const std::uint32_t most : {256U, 64U, 20U, 4U, 3U, 1U, 0U}) {
      const auto shapes = still.trace(watch.grid(), at, most);
      CAPTURE(most, shapes.size(), round);
      CHECK(shapes.size() <= most);
      CHECK(shapes.empty() == (most == 0));
      CHECK(std::all_of(shapes.begin(), shapes.end(), sound_still));
      CHECK(all_differ(ids_of(shapes)));
      CHECK((most == 0 || all_held(watch.grid(), shapes)));
      if (most >= 64) {  // the nearest keeps its form
        CHECK(edge_distance_m(shapes.front(), {at + Place{0.8, 1.0}}) < 0.0);
        CHECK(edge_distance_m(shapes.front(), {at}) > 0.3);
        CHECK(shapes.size() > most / 3);
      }
    }
  }
}

TEST_CASE("evidence and still shapes: nothing is allocated after they are made",
          "[low_level][tracking]") {
  GridWatch watch;
  StillShapes still;
  std::uint64_t allocations = 0;
  for (int i = 0; i < 200; ++i) {
    watch.go_to(0.7 * i, -0.3 * i, 5.0 * i);
    const Obstacle shape = stone_at(0.7 * i + i % 37 - 18, -0.3 * i + i % 23 - 11, 0.6);
    const testing::AllocationScope scope;
    watch.see(20.0);
    watch.hit(shape);
    watch.grid().clear(stone_at(shape.centre_x_m + 9.0, shape.centre_y_m, 1.0));
    [[maybe_unused]] const auto shares = watch.grid().shares_under(shape);
    [[maybe_unused]] const auto shapes =
        still.trace(watch.grid(), watch.look().pose.p_WV.xy_m, 1 + static_cast<unsigned>(i) % 40);
    allocations += scope.count();
  }
  CHECK(allocations == 0);
}

}  // namespace lodesman
