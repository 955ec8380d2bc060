// SPDX-License-Identifier: Apache-2.0
#include "low_level/tracking/tracker.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <set>
#include <vector>

#include "mid_level/geometry/obstacle_distance.h"
#include "mid_level/messages/sane.h"
#include "tests/support/allocations.h"
#include "tests/support/catch.h"
#include "tests/unit/tracking/tracker_bench.h"

namespace lodesman {
namespace {

using Bench = testing::TrackerBench;
using testing::Disc;
using testing::kTrackerPing_s;
using testing::speed_of;

}  // namespace

TEST_CASE("tracker: what is seen is an obstacle at once, and rests when it has been watched",
          "[low_level][tracking]") {
  Bench bench;
  bench.hear({{2.0, 12.0, 1.0}});
  REQUIRE(bench.tracks->count == 1);
  CHECK(bench.track_at(2.0, 12.0) != nullptr);
  for (int i = 0; i < 40; ++i) {
    bench.hear({{2.0, 12.0, 1.0}});
    REQUIRE(bench.tracks->count >= 1);
  }
  const Track* rests = bench.track_at(2.0, 12.0);
  REQUIRE(rests != nullptr);
  CHECK(speed_of(*rests) < 0.01);
  CHECK(rests->velocity_xx_m2_s2 < 1e-9);
}

TEST_CASE("tracker: one that crosses keeps its number, and its velocity is known",
          "[low_level][tracking]") {
  Bench bench;
  std::set<std::uint32_t> ids;
  for (int i = 0; i < 80; ++i) {
    const double x_m = -4.0 + 0.7 * i * kTrackerPing_s;
    bench.hear({{x_m, 10.0, 0.6}});
    const Track* track = bench.track_at(x_m, 10.0);
    REQUIRE(track != nullptr);
    if (i > 20) {
      ids.insert(track->id);
      CHECK(track->velocity_x_m_s == Approx(0.7).margin(0.1));
      CHECK(track->velocity_y_m_s == Approx(0.0).margin(0.1));
      CHECK(bench.tracks->count == 1);  // no ghost behind it
    }
  }
  CHECK(ids.size() == 1);
}

TEST_CASE("tracker: what has left the fan is remembered", "[low_level][tracking]") {
  Bench bench;
  for (int i = 0; i < 40; ++i) {
    bench.hear({{0.0, 8.0, 0.5}});
  }
  bench.pose.heading = Heading::clockwise_from_y_rad(2.0);
  for (int i = 0; i < 1200; ++i) {  // two minutes
    bench.hear({{0.0, 8.0, 0.5}});
  }
  CHECK(bench.track_at(0.0, 8.0) != nullptr);
}

TEST_CASE("tracker: what is gone from where it looks is gone", "[low_level][tracking]") {
  Bench bench;
  for (int i = 0; i < 40; ++i) {
    bench.hear({{0.0, 8.0, 0.5}, {5.0, 12.0, 0.5}});
  }
  for (int i = 0; i < 15; ++i) {
    bench.hear({{5.0, 12.0, 0.5}});
  }
  CHECK(bench.track_at(0.0, 8.0) == nullptr);
  CHECK(bench.track_at(5.0, 12.0) != nullptr);
}

TEST_CASE("tracker: in blind beams what was seen is remembered, and no water is free",
          "[low_level][tracking]") {
  Bench bench;
  for (int i = 0; i < 40; ++i) {
    bench.hear({{0.0, 8.0, 0.5}, {5.0, 12.0, 0.5}});
  }
  bench.blind_beams(0.0, 0.2);
  for (int i = 0; i < 100; ++i) {
    bench.hear({});
  }
  CHECK(bench.track_at(0.0, 8.0) != nullptr);
  CHECK(bench.track_at(5.0, 12.0) == nullptr);  // where it hears, what is gone is gone
  Bench fresh;
  fresh.blind_beams(0.0, 0.2);
  for (int i = 0; i < 20; ++i) {
    fresh.hear({});
  }
  CHECK(fresh.tracker->water().state({0.0, 8.0}) == WaterState::kUnknown);
  CHECK(fresh.tracker->water().state({5.0, 8.0}) == WaterState::kFree);
}

TEST_CASE("tracker: one that sails into blind beams goes on, with more doubt",
          "[low_level][tracking]") {
  Bench bench;
  bench.blind_beams(0.0, 0.15);
  double doubt_before_m2 = 0.0;
  for (int i = 0; i < 70; ++i) {
    const double x_m = -5.0 + 0.07 * i;
    const bool is_heard = std::abs(std::atan2(x_m, 10.0)) > 0.15;
    bench.hear(is_heard ? std::vector<Disc>{{x_m, 10.0, 0.5}} : std::vector<Disc>{});
    if (i == 40) {
      doubt_before_m2 = bench.track_at(x_m, 10.0)->place_xx_m2;
    }
  }
  const Track* track = bench.track_at(-0.17, 10.0);
  REQUIRE(track != nullptr);
  CHECK(track->velocity_x_m_s == Approx(0.7).margin(0.2));
  CHECK(track->place_xx_m2 > 2.0 * doubt_before_m2);
}

TEST_CASE("tracker: what is found in blind beams is there all the same", "[low_level][tracking]") {
  Bench bench;
  bench.blind_beams(0.0, 0.3);
  bench.hear({{0.0, 3.0, 0.5}});
  CHECK(bench.track_at(0.0, 3.0) != nullptr);
}

TEST_CASE("tracker: one that passes behind a stone is the same one after",
          "[low_level][tracking]") {
  Bench bench;
  std::uint32_t before = 0;
  std::uint32_t after = 0;
  for (int i = 0; i < 140; ++i) {
    const double x_m = -5.0 + 0.7 * i * kTrackerPing_s;
    std::vector<Disc> discs{{0.0, 7.0, 1.0}};
    const bool hidden = std::abs(x_m) < 2.4;  // 14 m away: twice as far as the stone
    if (!hidden) {
      discs.push_back({x_m, 14.0, 0.5});
    }
    bench.hear(discs);
    const Track* track = bench.track_at(x_m, 14.0);
    if (track != nullptr && x_m < -2.5) {
      before = track->id;
    } else if (track != nullptr && x_m > 4.0) {
      after = track->id;
    }
  }
  CHECK(before != 0);
  CHECK(before == after);
}

TEST_CASE("tracker: a boat that sails past stones sees none of them move",
          "[low_level][tracking]") {
  Bench bench;
  const std::vector<Disc> stones{{-2.5, 10.0, 0.8}, {2.5, 12.0, 1.2}, {-2.0, 18.0, 0.5}};
  int moving = 0;
  for (int i = 0; i < 200; ++i) {
    bench.pose.p_WV.xy_m.y() = 0.8 * i * kTrackerPing_s;
    bench.hear(stones);
    for (std::uint32_t k = 0; k < bench.tracks->count; ++k) {
      moving += speed_of(bench.tracks->tracks[k]) > 0.15 && i > 20 ? 1 : 0;
    }
  }
  CHECK(moving == 0);
  for (const Disc& stone : stones) {
    CHECK(bench.track_at(stone.x_m, stone.y_m - stone.radius_m) != nullptr);
  }
}

TEST_CASE("tracker: one that comes out from before a stone is followed all the same",
          "[low_level][tracking]") {
  Bench bench;
  for (int i = 0; i < 40; ++i) {  // they are one echo
    bench.hear({{1.4, 8.0, 1.1}});
  }
  double x_m = 0.6;
  double y_m = 7.8;
  const Track* mover = nullptr;
  for (int i = 0; i < 120; ++i) {
    x_m -= 0.115 * kTrackerPing_s;
    y_m -= 0.196 * kTrackerPing_s;
    bench.hear({{1.4, 8.0, 1.1}, {x_m, y_m, 0.5}});
    mover = bench.track_at(x_m, y_m - 0.4);
    REQUIRE(mover != nullptr);
  }
  CHECK(mover->velocity_x_m_s == Approx(-0.115).margin(0.05));
  CHECK(mover->velocity_y_m_s == Approx(-0.196).margin(0.05));
}

TEST_CASE("tracker: a wall is what rests, from its first sight", "[low_level][tracking]") {
  Bench bench;
  Obstacle wall;
  wall.shape = ObstacleShape::kPolygon;
  wall.vertex_count = 4;
  wall.vertices[0] = {-8.0, 12.0};
  wall.vertices[1] = {8.0, 12.0};
  wall.vertices[2] = {8.0, 12.6};
  wall.vertices[3] = {-8.0, 12.6};
  bench.seen->count = 1;
  bench.seen->obstacles[0] = wall;
  for (int i = 0; i < 3; ++i) {
    bench.ping->captured = Time{from_seconds(bench.t_s + 1.0 + 0.1 * i)};
    bench.tracker->see(*bench.ping, *bench.seen, bench.pose, *bench.tracks);
    for (double x_m = -7.5; x_m <= 7.5; x_m += 0.5) {
      CHECK(bench.track_at(x_m, 12.2) != nullptr);
    }
    for (std::uint32_t k = 0; k < bench.tracks->count; ++k) {
      CHECK(speed_of(bench.tracks->tracks[k]) < 1e-9);
    }
  }
}

TEST_CASE("tracker: behind a return of which no obstacle came nothing is known to be free",
          "[low_level][tracking]") {
  Bench bench;
  bench.ping->make_profile(120, bench.ping->sector_rad);
  for (std::uint32_t beam = 52; beam < 68; ++beam) {
    bench.ping->points[beam].range_m = 10.0;
  }
  for (int i = 0; i < 20; ++i) {
    bench.hear({});
  }
  const EvidenceGrid& water = bench.tracker->water();
  CHECK(water.state({0.0, 9.0}) == WaterState::kFree);
  CHECK(water.state({0.0, 11.0}) == WaterState::kUnknown);
  CHECK(water.state({0.0, 25.0}) == WaterState::kUnknown);
  CHECK(water.state({12.0, 20.0}) == WaterState::kFree);  // beams without a return
}

TEST_CASE("tracker: another one that goes on with its tracks knows the same",
          "[low_level][tracking]") {
  Bench bench;
  for (int i = 0; i < 60; ++i) {
    bench.hear({{-4.0 + 0.05 * i, 10.0, 0.5}, {6.0, 14.0, 0.7}});
  }
  const Track* mover = bench.track_at(-1.05, 10.0);
  REQUIRE(mover != nullptr);
  const std::uint32_t id = mover->id;
  bench.tracker = std::make_unique<Tracker>(1.0);
  bench.tracker->resume(*bench.tracks, bench.pose, bench.ping->captured);
  bench.hear({{-1.0, 10.0, 0.5}, {6.0, 14.0, 0.7}});
  mover = bench.track_at(-1.0, 10.0);
  REQUIRE(mover != nullptr);
  CHECK(mover->id == id);
  CHECK(mover->velocity_x_m_s == Approx(0.5).margin(0.1));
  CHECK(bench.track_at(6.0, 14.0) != nullptr);
}

TEST_CASE("tracker: it goes on far from the odometry's origin too", "[low_level][tracking]") {
  Bench bench;
  bench.pose.p_WV.xy_m = {500.0, -300.0};
  for (int i = 0; i < 60; ++i) {
    bench.hear({{503.0, -290.0, 0.7}});
  }
  bench.tracker = std::make_unique<Tracker>(1.0);
  bench.tracker->resume(*bench.tracks, bench.pose, bench.ping->captured);
  bench.pose.heading = Heading::clockwise_from_y_rad(3.0);
  bench.hear({});
  CHECK(bench.track_at(503.0, -290.0) != nullptr);
}

TEST_CASE("tracker: of more things than may move none is left out", "[low_level][tracking]") {
  Bench bench;
  std::vector<Disc> discs;
  for (int i = 0; i < 60; ++i) {
    const double bearing_rad = to_rad(-55.0 + 10.0 * (i % 12));
    const double range_m = 6.0 + 4.0 * (i / 12) + 0.4 * (i % 3);
    discs.push_back({range_m * std::sin(bearing_rad), range_m * std::cos(bearing_rad), 0.3});
  }
  for (int ping = 0; ping < 30; ++ping) {
    bench.hear(discs);
    for (const Disc& disc : discs) {
      CHECK(bench.track_at(disc.x_m, disc.y_m) != nullptr);
    }
  }
}

TEST_CASE("tracker: one that stops is never without a track", "[low_level][tracking]") {
  Bench bench;
  bench.hear({});
  for (int i = 0; i < 160; ++i) {
    const double x_m = -3.0 + 0.05 * std::min(i, 60);
    bench.hear({{x_m, 10.0, 0.5}});
    CHECK(bench.track_at(x_m, 10.0) != nullptr);
  }
  CHECK(speed_of(*bench.track_at(0.0, 10.0)) < 0.05);
}

TEST_CASE("tracker: nonsense of one that was here before is passed over", "[low_level][tracking]") {
  Bench bench;
  Tracks& last = *bench.tracks;
  last.captured = Time{from_seconds(1e8)};
  last.count = 3;
  for (Track& track : std::span{last.tracks}.first(3)) {
    track = {};
    track.id = 7;
    track.shape.semi_axis_first_m = track.shape.semi_axis_second_m = 1.0;
    track.velocity_xx_m2_s2 = track.velocity_yy_m2_s2 = 1.0;
    track.place_xx_m2 = track.place_yy_m2 = 0.001;
    track.place_xy_m2 = 1e9;
  }
  last.tracks[1].place_xy_m2 = 0.0;
  last.tracks[1].shape.centre_x_m = 1e9;
  last.tracks[2].velocity_x_m_s = 1e3;
  const auto copy = std::make_unique<Tracks>(last);
  bench.tracker->resume(*copy, bench.pose, Time{from_seconds(20.0)});
  bench.hear({{0.0, 9.0, 0.5}});
  CHECK(sane(*bench.tracks));
  CHECK(bench.track_at(0.0, 9.0) != nullptr);
  CHECK(bench.tracker->followed().size() == 1);
}

TEST_CASE("tracker: any obstacles give sane tracks, and nothing is allocated",
          "[low_level][tracking]") {
  std::mt19937 random{11};
  std::uniform_real_distribution<double> place{-20.0, 20.0};
  std::uniform_real_distribution<double> size{0.01, 3.0};
  Bench bench;
  for (int round = 0; round < 200; ++round) {
    bench.pose.p_WV.xy_m = {place(random), place(random)};
    bench.pose.heading = Heading::clockwise_from_y_rad(place(random));
    bench.ping->captured = Time{from_seconds(10.0 + 0.1 * round)};
    bench.seen->count = static_cast<std::uint32_t>(random() % (kMaxObstacles + 1));
    for (Obstacle& o : bench.seen->obstacles) {
      o = {};
      o.centre_x_m = place(random);
      o.centre_y_m = std::abs(place(random));
      o.semi_axis_first_m = size(random);
      o.semi_axis_second_m = size(random);
    }
    const testing::AllocationScope scope;
    bench.tracker->see(*bench.ping, *bench.seen, bench.pose, *bench.tracks);
    const std::uint64_t allocations = scope.count();
    CHECK(allocations == 0);
    REQUIRE(sane(*bench.tracks));
    CHECK(bench.tracks->dropped == 0);
  }
}

}  // namespace lodesman
