// SPDX-License-Identifier: Apache-2.0
#include "high_level/guidance/sight_speed.h"

#include <cmath>
#include <limits>
#include <memory>

#include "tests/support/catch.h"
#include "tests/unit/guidance/bridge.h"

namespace lodesman::testing {
namespace {

// The origin in its middle; free up to so far north, unknown beyond.
[[nodiscard]] std::unique_ptr<Coverage> free_up_to(double north_m) {
  auto water = std::make_unique<Coverage>();
  water->west_x_m = water->south_y_m = -0.5 * Coverage::kSide * Coverage::kCell_m;
  for (std::size_t row = 0; row < Coverage::kSide; ++row) {
    const double north_edge_m = water->south_y_m + Coverage::kCell_m * static_cast<double>(row + 1);
    for (std::size_t column = 0; column < Coverage::kSide && north_edge_m <= north_m; ++column) {
      water->set(column, row, WaterState::kFree);
    }
  }
  return water;
}

[[nodiscard]] SightSpeedOptions sight() {
  return {.unseen_speed_m_s = 0.2, .bow_m = 1.4, .latency_s = 0.1};
}

}  // namespace

TEST_CASE("coverage: a cell is what was set, and beyond the square all is unknown",
          "[high_level][guidance]") {
  const auto water = free_up_to(3.0);
  CHECK(water->at(0.0, 2.9) == WaterState::kFree);
  CHECK(water->at(0.0, 3.1) == WaterState::kUnknown);
  CHECK(water->at(-23.9, -23.9) == WaterState::kFree);
  CHECK(water->at(-24.1, 0.0) == WaterState::kUnknown);
  CHECK(water->at(0.0, 1e300) == WaterState::kUnknown);
  CHECK(water->at(std::numeric_limits<double>::quiet_NaN(), 0.0) == WaterState::kUnknown);
}

TEST_CASE("coverage: bits that stand for nothing are unknown", "[high_level][guidance]") {
  Coverage water;
  water.cells.fill(0xff);
  CHECK(water.at(1.0, 1.0) == WaterState::kUnknown);
}

TEST_CASE("sight: the way is seen up to the first water that nobody looked at",
          "[high_level][guidance]") {
  const auto water = free_up_to(6.0);
  const Route north = route_of({{0, 0}, {0, 20}});
  CHECK(seen_ahead_m(*water, north, {}, 0.6, 10.0) == Approx(6.0).margin(0.26));
  CHECK(seen_ahead_m(*water, north, {0, 0.2}, 0.6, 10.0) == Approx(2.0).margin(0.26));
  CHECK(seen_ahead_m(*water, north, {}, 0.6, 4.0) == Approx(4.0));
  const Route ends = route_of({{0, 0}, {0, 3}});
  CHECK(seen_ahead_m(*water, ends, {}, 0.6, 10.0) == Approx(10.0));
  // Along the edge of what was seen half of the hull is in the unseen.
  const Route beside = route_of({{-10, 5.8}, {10, 5.8}});
  CHECK(seen_ahead_m(*water, beside, {}, 0.6, 10.0) < 0.3);
  CHECK(seen_ahead_m(*water, beside, {}, 0.1, 10.0) == Approx(10.0));
}

TEST_CASE("sight: what is seen to be occupied is the tracks' to avoid, not unseen",
          "[high_level][guidance]") {
  const auto water = free_up_to(6.0);
  water->set(48, 60, WaterState::kOccupied);  // 6 m ahead
  CHECK(water->at(0.2, 6.2) == WaterState::kOccupied);
  const Route north = route_of({{0.2, 0}, {0.2, 20}});
  CHECK(seen_ahead_m(*water, north, {}, 0.0, 10.0) == Approx(6.5).margin(0.26));
}

TEST_CASE("sight: at the speed that is allowed the boat stops within what it has seen",
          "[high_level][guidance]") {
  const VehicleModel& vehicle = default_response().model;
  double last_m_s = 0.0;
  for (const double seen_m : {1.6, 2.0, 2.5, 3.0, 4.0, 6.0}) {
    const double allowed_m_s = speed_by_sight_m_s(sight(), vehicle, seen_m, 1.12);
    CHECK(allowed_m_s >= last_m_s);
    if (allowed_m_s > sight().unseen_speed_m_s) {
      CHECK(sight_needed_m(sight(), vehicle, allowed_m_s) <= seen_m);
      CHECK((allowed_m_s >= 1.12 || sight_needed_m(sight(), vehicle, allowed_m_s + 0.01) > seen_m));
    }
    last_m_s = allowed_m_s;
  }
  CHECK(last_m_s == Approx(1.12));
  CHECK(speed_by_sight_m_s(sight(), vehicle, 0.0, 1.12) == Approx(0.2));
  CHECK(speed_by_sight_m_s(sight(), vehicle, 0.0, 0.11) ==
        Approx(0.11));  // slower than that anyway
}

TEST_CASE("pilot: into water that nobody looked at it goes slowly, and says how far it sees",
          "[high_level][guidance]") {
  Bridge bridge;
  const Tracks none = tracks_of({});
  bridge.pilot->sail_at({100, 1.0});
  bridge.ask(none, state_at(0, 0), {0, 20});
  bridge.decide(none, state_at(0, 0), PathReason::kFound, {{0, 0}, {0, 20}});
  CHECK(bridge.plan->speed_share == Approx(1.0));
  CHECK(std::isinf(bridge.plan->seen_ahead_m));

  bridge.water = free_up_to(3.0);
  bridge.decide(none, state_at(0, 0), PathReason::kFound, {{0, 0}, {0, 20}});
  CHECK(bridge.plan->seen_ahead_m == Approx(3.0).margin(0.26));
  CHECK(bridge.plan->speed_share > 0.25);
  CHECK(bridge.plan->speed_share < 0.95);
  CHECK(bridge.plan->rung == PlanRung::kSlow);

  bridge.water = free_up_to(0.5);
  bridge.decide(none, state_at(0, 0), PathReason::kFound, {{0, 0}, {0, 20}});
  CHECK(bridge.plan->speed_share == Approx(0.2));

  bridge.water = free_up_to(20.0);
  bridge.decide(none, state_at(0, 0), PathReason::kFound, {{0, 0}, {0, 20}});
  CHECK(bridge.plan->speed_share == Approx(1.0));
  CHECK(bridge.plan->rung == PlanRung::kOnRoute);
}

}  // namespace lodesman::testing
