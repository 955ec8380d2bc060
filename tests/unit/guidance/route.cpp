// SPDX-License-Identifier: Apache-2.0
#include "high_level/guidance/route.h"

#include <limits>

#include "tests/support/catch.h"
#include "tests/unit/guidance/support.h"

namespace lodesman::testing {
namespace {

constexpr double kAnywhere_m = std::numeric_limits<double>::infinity();

// 10 m north, then 10 m east.
Route corner_route() { return route_of({{0, 0}, {0, 10}, {10, 10}}); }

}  // namespace

TEST_CASE("route: it takes points until it is full, and then none", "[high_level][guidance]") {
  Route route;
  CHECK(route.empty());
  for (std::size_t i = 0; i < Route::kMaxPoints; ++i) {
    REQUIRE(route.add({0.0, static_cast<double>(i)}));
  }
  CHECK_FALSE(route.add({7.0, 7.0}));
  CHECK(route.count == Route::kMaxPoints);
  CHECK(route.end().y() == Approx(Route::kMaxPoints - 1.0));
  route.clear();
  CHECK(route.empty());
}

TEST_CASE("route: it is as long as its legs, and what remains gets less along it",
          "[high_level][guidance]") {
  const Route route = corner_route();
  CHECK(route.length_m() == Approx(20.0));
  CHECK(remaining_m(route, {}) == Approx(20.0));
  CHECK(remaining_m(route, {0, 0.25}) == Approx(17.5));
  CHECK(remaining_m(route, {1, 0.5}) == Approx(5.0));
  CHECK(remaining_m(route, {2, 0.0}) == Approx(0.0).margin(1e-12));
  CHECK(route_of({{3, 4}}).length_m() == Approx(0.0).margin(1e-12));
}

TEST_CASE("route: the nearest place is not before the one it starts from",
          "[high_level][guidance]") {
  const Route route = corner_route();
  const RoutePlace place = nearest_place(route, {1.0, 5.0}, {}, kAnywhere_m);
  CHECK(place.leg == 0);
  CHECK(place.share == Approx(0.5));
  const RoutePlace later = nearest_place(route, {1.0, 5.0}, {0, 0.8}, kAnywhere_m);
  CHECK(later.leg == 0);
  CHECK(later.share == Approx(0.8));
  const RoutePlace next = nearest_place(route, {1.0, 5.0}, {1, 0.0}, kAnywhere_m);
  CHECK(next.leg == 1);
  CHECK(next.share == Approx(0.1));
}

TEST_CASE("route: the nearest place is looked for only so far on", "[high_level][guidance]") {
  const Route route = corner_route();
  const RoutePlace far = nearest_place(route, {9.0, 10.5}, {}, kAnywhere_m);
  CHECK(far.leg == 1);
  CHECK(far.share == Approx(0.9));
  const RoutePlace near = nearest_place(route, {9.0, 10.5}, {}, 3.0);
  CHECK(near.leg == 0);
  CHECK(near.share == Approx(1.0));
}

TEST_CASE("route: a point ahead goes round corners and stops at the end",
          "[high_level][guidance]") {
  const Route route = corner_route();
  CHECK((point_at(route, {0, 0.3}) - Eigen::Vector2d{0, 3}).norm() < 1e-12);
  CHECK((point_at(route, {2, 0.0}) - Eigen::Vector2d{10, 10}).norm() < 1e-12);
  CHECK((point_ahead(route, {0, 0.8}, 1.0) - Eigen::Vector2d{0, 9}).norm() < 1e-12);
  CHECK((point_ahead(route, {0, 0.8}, 4.0) - Eigen::Vector2d{2, 10}).norm() < 1e-12);
  CHECK((point_ahead(route, {0, 0.8}, 40.0) - Eigen::Vector2d{10, 10}).norm() < 1e-12);
}

TEST_CASE("route: a leg of no length is no stop", "[high_level][guidance]") {
  const Route route = route_of({{0, 0}, {0, 0}, {0, 10}});
  CHECK((point_ahead(route, {}, 2.0) - Eigen::Vector2d{0, 2}).norm() < 1e-12);
  const RoutePlace place = nearest_place(route, {1.0, 4.0}, {}, kAnywhere_m);
  CHECK(place.leg == 1);
  CHECK(place.share == Approx(0.4));
}

}  // namespace lodesman::testing
