// SPDX-License-Identifier: Apache-2.0
#include "high_level/guidance/zones.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "mid_level/geometry/obstacle_distance.h"
#include "tests/support/catch.h"
#include "tests/unit/guidance/support.h"

namespace lodesman::testing {
namespace {

using RequestPtr = std::unique_ptr<PathRequest>;

// By hand: the shipped boat at 1 m/s needs 2.136 m to stop and 3.111 m to turn, at 0.5 m/s 1.107 m
// and 1.556 m; 0.1 and 0.06 of these.
constexpr double kFor1_m_s_m = 0.4003;
constexpr double kForHalf_m_s_m = 0.2041;
[[nodiscard]] Approx about(double wanted_m) { return Approx(wanted_m).margin(0.0002); }

RequestPtr zones_of(const Tracks& tracks, double speed_m_s = 1.0, double now_s = 0.0) {
  auto request = std::make_unique<PathRequest>();
  make_zones(default_zones(), default_response().model, tracks, at_s(now_s), {0.0, 0.0}, speed_m_s,
             *request);
  return request;
}

PathZone round_zone(double x_m, double y_m, double radius_m, double zone_m) {
  PathZone zone;
  zone.shape = disc_track(1, x_m, y_m).shape;
  zone.shape.semi_axis_first_m = zone.shape.semi_axis_second_m = radius_m;
  zone.shape.protection_first_m = zone.shape.protection_second_m = zone_m;
  return zone;
}

RequestPtr request_with(std::initializer_list<PathZone> zones) {
  auto request = std::make_unique<PathRequest>();
  for (const PathZone& zone : zones) {
    request->zones[request->zone_count++] = zone;
  }
  return request;
}

}  // namespace

TEST_CASE("zones: a zone is shape, hull and a margin that grows with the speed",
          "[high_level][guidance]") {
  const auto slow = zones_of(tracks_of({disc_track(4, 0, 10)}), 0.5);
  REQUIRE(slow->zone_count == 1);
  CHECK(slow->zones[0].shape.id == 4);
  CHECK(slow->zones[0].shape.protection_first_m == about(0.5 + 0.6 + 0.8 + kForHalf_m_s_m));
  CHECK(slow->zones[0].shape.protection_second_m == about(1.9 + kForHalf_m_s_m));
  CHECK(slow->zones[0].give_m == about(0.8 + kForHalf_m_s_m - 0.45));
  const auto fast = zones_of(tracks_of({disc_track(4, 0, 10)}), 1.0);
  CHECK(fast->zones[0].shape.protection_first_m == about(1.9 + kFor1_m_s_m));
}

TEST_CASE("zones: the margin grows with the ways that the vehicle model needs to stop and to turn",
          "[high_level][guidance]") {
  const ZoneOptions options = default_zones();
  const SpeedTable speeds = SpeedTable::proportional(0.01);
  const VehicleModelParameters hull = shipped_options().estimator.filter.vehicle;
  VehicleModelParameters heavy = hull;
  heavy.added_mass_surge_kg = hull.mass_kg;  // twice as much to stop
  VehicleModelParameters ponderous = hull;
  ponderous.turning_n_m_per_head_ref /= 4.0;
  const VehicleModel as_is{hull, speeds};
  for (const double speed_m_s : {0.25, 0.5, 1.0}) {
    const double zone_m = sure_zone_m(options, as_is, speed_m_s);
    CHECK(sure_zone_m(options, {heavy, speeds}, speed_m_s) - zone_m ==
          Approx(options.margin_per_stopping_way * as_is.stopping_way_m(speed_m_s)));
    const VehicleModel slow_to_turn{ponderous, speeds};
    const double more_m = slow_to_turn.turning_way_m(speed_m_s) - as_is.turning_way_m(speed_m_s);
    CHECK(more_m > as_is.turning_way_m(speed_m_s));
    CHECK(sure_zone_m(options, slow_to_turn, speed_m_s) - zone_m ==
          Approx(options.margin_per_turning_way * more_m));
  }
  CHECK(sure_zone_m(options, {heavy, speeds}, 0.0) == Approx(sure_zone_m(options, as_is, 0.0)));
}

TEST_CASE("zones: a wall's zone is its margin alone", "[high_level][guidance]") {
  const auto request = zones_of(tracks_of({wall_track(2, {{-5, 8}, {5, 8}})}));
  REQUIRE(request->zone_count == 1);
  CHECK(request->zones[0].shape.protection_first_m == about(1.4 + kFor1_m_s_m));
}

TEST_CASE("zones: doubt of place and, with age, of velocity makes them larger, up to a limit",
          "[high_level][guidance]") {
  Track track = disc_track(4, 0, 10);
  track.place_xx_m2 = 0.01;
  track.velocity_yy_m2_s2 = 0.04;
  const auto at_once = zones_of(tracks_of({track}));
  CHECK(at_once->zones[0].shape.protection_first_m == about(1.9 + kFor1_m_s_m + 0.2));
  CHECK(at_once->zones[0].give_m == about(0.35 + kFor1_m_s_m + 0.2));
  const auto later = zones_of(tracks_of({track}), 1.0, 2.0);
  CHECK(later->zones[0].shape.protection_first_m ==
        about(1.9 + kFor1_m_s_m + 2.0 * std::sqrt(0.01 + 0.16)));
  const auto long_after = zones_of(tracks_of({track}), 1.0, 100.0);
  CHECK(long_after->zones[0].shape.protection_first_m == about(1.9 + kFor1_m_s_m + 1.5));
}

TEST_CASE("zones: what moves faster than the stated share of our speed has none",
          "[high_level][guidance]") {
  const auto request =
      zones_of(tracks_of({disc_track(1, 0, 10, 0.31, 0.0), disc_track(2, 0, 12, 0.0, 0.29)}));
  REQUIRE(request->zone_count == 1);
  CHECK(request->zones[0].shape.id == 2);
}

TEST_CASE("zones: a velocity that may be noise is none", "[high_level][guidance]") {
  Track track = disc_track(1, 0, 10, 0.1, 0.0);
  const auto placed_x_m = [&](double velocity_sigma_m_s) {
    track.velocity_xx_m2_s2 = track.velocity_yy_m2_s2 = velocity_sigma_m_s * velocity_sigma_m_s;
    PathRequest request;
    make_zones(default_zones(), default_response().model, tracks_of({track}), at_s(0), {0, 0}, 1.0,
               request);
    return request.zones[0].shape.centre_x_m;
  };
  CHECK(placed_x_m(0.02) > 0.5);
  CHECK(placed_x_m(0.03) == Approx(0.0).margin(1e-12));
}

TEST_CASE("zones: each lies where its obstacle will be when we can be there",
          "[high_level][guidance]") {
  const auto now = zones_of(tracks_of({disc_track(1, 0, 10, 0.2, 0.0)}));
  CHECK(now->zones[0].shape.centre_x_m == Approx(0.2 * 9.5));
  // Seen a second ago it has moved since.
  const auto aged = zones_of(tracks_of({disc_track(1, 0, 10, 0.2, 0.0)}), 1.0, 1.0);
  CHECK(aged->zones[0].shape.centre_x_m == Approx(0.2 * (1.0 + 9.5)).margin(0.01));
  // However slow we are, no zone is placed more than a minute ahead.
  const auto slow = zones_of(tracks_of({disc_track(1, 0, 10, 0.02, 0.0)}), 0.1);
  CHECK(slow->zones[0].shape.centre_x_m == Approx(0.02 * 60.0));
}

TEST_CASE("zones: clearance is that of the nearest zone, infinite without any",
          "[high_level][guidance]") {
  CHECK(std::isinf(zone_clearance_m(*request_with({}), {0, 0})));
  const auto two = request_with({round_zone(0, 10, 0.5, 2.0), round_zone(0, -5, 0.5, 1.0)});
  CHECK(zone_clearance_m(*two, {0, 0}) == Approx(4.0));
  CHECK(zone_clearance_m(*two, {0, 9}) == Approx(-1.0));
  PathZone wall;
  wall.shape = wall_track(3, {{-5, 3}, {5, 3}}).shape;
  wall.shape.protection_first_m = 1.0;
  CHECK(zone_clearance_m(*request_with({wall}), {0, 0}) == Approx(2.0));
}

TEST_CASE("zones: the way out of one leads away from its obstacle", "[high_level][guidance]") {
  const auto request = request_with({round_zone(0, 0, 0.5, 2.0)});
  const auto out = way_out(*request, {0.0, 1.0});
  REQUIRE(out);
  CHECK(out->x() == Approx(0.0).margin(0.2));
  CHECK(out->y() == Approx(2.2).margin(0.11));
  CHECK(zone_clearance_m(*request, *out) > 0.0);
  CHECK_FALSE(way_out(*request_with({round_zone(0, 0, 0.5, 20.0)}), {0.0, 1.0}));
}

TEST_CASE("zones: no way out leads through an obstacle", "[high_level][guidance]") {
  // A wall's wide zone covers all south of y = 0; due north, the shortest way, a body lies across.
  PathZone wall;
  wall.shape = wall_track(3, {{-30, -3}, {30, -3}}).shape;
  wall.shape.protection_first_m = 3.0;
  const PathZone body = round_zone(0, 0, 0.5, 0.6);
  const auto request = request_with({wall, body});
  const Eigen::Vector2d start{0.0, -0.7};
  const auto out = way_out(*request, start);
  REQUIRE(out);
  CHECK(zone_clearance_m(*request, *out) > 0.0);
  for (double share = 0.0; share <= 1.0; share += 0.01) {
    CHECK(edge_distance_m(body.shape, {start + share * (*out - start)}) > 0.15);
  }
}

TEST_CASE("zones: of the free points round a goal the one nearest to us is taken",
          "[high_level][guidance]") {
  const auto request = request_with({round_zone(0, 0, 0.5, 2.0)});
  const auto from_south = nearest_free(*request, {0.0, 0.0}, {0.0, -10.0});
  REQUIRE(from_south);
  CHECK(from_south->x() == Approx(0.0).margin(1e-9));
  CHECK(from_south->y() == Approx(-2.2).margin(0.11));
  // A goal that lies towards one edge is moved to that edge, wherever we are.
  const auto off_centre = nearest_free(*request, {0.0, 1.5}, {0.0, -10.0});
  REQUIRE(off_centre);
  CHECK(off_centre->y() > 1.9);
  CHECK_FALSE(nearest_free(*request_with({round_zone(0, 0, 0.5, 20.0)}), {0, 0}, {0, -30}));
}

TEST_CASE("zones: they make room for a point as far as they may give, all of them or none",
          "[high_level][guidance]") {
  const auto zone = [](double x_m, double give_m) {
    PathZone made = round_zone(x_m, 0, 0.5, 2.0);
    made.give_m = give_m;
    return made;
  };
  const auto gap = request_with({zone(-1.7, 0.4), zone(1.7, 0.4), zone(9.0, 0.4)});
  CHECK(zone_clearance_m(*gap, {0, 0}) < 0.0);
  CHECK(make_room(*gap, {0, 0}));
  CHECK(zone_clearance_m(*gap, {0, 0}) == Approx(0.05));
  CHECK(gap->zones[0].shape.protection_first_m == Approx(1.65));
  CHECK(gap->zones[0].give_m == Approx(0.05));
  CHECK(gap->zones[2].shape.protection_first_m == Approx(2.0));  // not in the way
  CHECK_FALSE(make_room(*gap, {0, 0}));                          // there is room
  const auto closed = request_with({zone(-1.7, 0.4), zone(1.7, 0.3)});
  CHECK_FALSE(make_room(*closed, {0, 0}));
  CHECK(closed->zones[0].shape.protection_first_m == Approx(2.0));
}

TEST_CASE("zones: doubt of the own place widens them as that of a track does",
          "[high_level][guidance]") {
  Track doubtful = disc_track(1, 0.0, 10.0);
  doubtful.place_xx_m2 = doubtful.place_yy_m2 = 0.16;
  const auto zone_of = [](const Track& track, double own_sigma_m) {
    auto request = std::make_unique<PathRequest>();
    make_zones(default_zones(), default_response().model, tracks_of({track}), at_s(0), {0.0, 0.0},
               0.5, *request, own_sigma_m);
    return request->zones[0].shape.protection_first_m;
  };
  const Track sure = disc_track(1, 0.0, 10.0);
  CHECK(zone_of(sure, 0.4) > zone_of(sure, 0.0) + 0.5);
  CHECK(zone_of(sure, 0.4) == Approx(zone_of(doubtful, 0.0)));
  CHECK(zone_of(sure, 50.0) == Approx(zone_of(sure, 0.0) + default_zones().doubt_max_m));
}

}  // namespace lodesman::testing
