// SPDX-License-Identifier: Apache-2.0
#include "low_level/sonar/track_oracle.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "tests/support/allocations.h"
#include "tests/support/catch.h"

namespace lodesman {
namespace {

using Scene = std::vector<MovingObstacle>;

MovingObstacle buoy(double x_m, double y_m, double radius_m = 0.5) {
  MovingObstacle moving;
  moving.at_start.id = 31;
  moving.at_start.centre_x_m = x_m;
  moving.at_start.centre_y_m = y_m;
  moving.at_start.semi_axis_first_m = moving.at_start.semi_axis_second_m = radius_m;
  return moving;
}

MovingObstacle quay(double y_m) {
  MovingObstacle moving;
  moving.at_start.shape = ObstacleShape::kPolyline;
  moving.at_start.vertex_count = 2;
  moving.at_start.vertices[0] = {-100.0, y_m};
  moving.at_start.vertices[1] = {100.0, y_m};
  return moving;
}

TrackOracleOptions good_sight() {
  TrackOracleOptions options;
  options.sector_rad = to_rad(120.0);
  options.memory = from_seconds(10.0);
  return options;
}

KnownView ping_at(double time_s, double heading_deg = 0.0) {
  KnownView view;
  view.frame = static_cast<std::uint64_t>(time_s * 10.0);
  view.captured = Time{from_seconds(time_s)};
  view.scenario_time_s = time_s;
  view.pose = {{{0.0, 0.0}}, Heading::clockwise_from_y_rad(to_rad(heading_deg))};
  view.range_m = 30.0;
  return view;
}

// An oracle with what it said last.
struct Watch {
  explicit Watch(Scene world, const TrackOracleOptions& options = good_sight())
      : scene{std::move(world)}, oracle{scene, options} {}
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;
  ~Watch() = default;

  const Tracks& see(double time_s, double heading_deg = 0.0) {
    oracle.see(ping_at(time_s, heading_deg), *tracks);
    return *tracks;
  }

  Scene scene;
  TrackOracle oracle;
  std::unique_ptr<Tracks> tracks = std::make_unique<Tracks>();
};

std::uint32_t seen_at_once(const Scene& scene) { return Watch{scene}.see(0.0).count; }

}  // namespace

TEST_CASE("track_oracle: one that comes after goes on with what was known, for as long",
          "[low_level][sonar]") {
  const Scene scene{buoy(0, 10), quay(20), buoy(0, -10)};
  Watch before{scene};
  REQUIRE(before.see(0.0).count == 2);
  Watch after{scene};
  after.oracle.resume(*before.tracks);
  // It looks the other way.
  const Tracks& known = after.see(5.0, 180.0);
  REQUIRE(known.count == 3);
  CHECK(known.tracks[0].last_seen == before.tracks->tracks[0].last_seen);
  CHECK(after.see(10.1, 180.0).count == 1);  // longer ago than its memory
}

TEST_CASE("track_oracle: it sees in the fan and within range, and nowhere else",
          "[low_level][sonar]") {
  const auto at_bearing = [](double bearing_deg) {
    return buoy(15.0 * std::sin(to_rad(bearing_deg)), 15.0 * std::cos(to_rad(bearing_deg)));
  };
  CHECK(seen_at_once({buoy(0, 10)}) == 1);
  CHECK(seen_at_once({at_bearing(61.0)}) == 1);  // its edge is in the fan
  CHECK(seen_at_once({at_bearing(63.0)}) == 0);
  CHECK(seen_at_once({at_bearing(-63.0)}) == 0);
  CHECK(seen_at_once({buoy(0, -10)}) == 0);
  CHECK(seen_at_once({buoy(0, 30.4)}) == 1);
  CHECK(seen_at_once({buoy(0, 30.6)}) == 0);
  TrackOracleOptions all_round = good_sight();
  all_round.sector_rad = to_rad(360.0);
  CHECK(Watch{{buoy(0, -10)}, all_round}.see(0.0).count == 1);
}

TEST_CASE("track_oracle: what stands behind another is not seen", "[low_level][sonar]") {
  MovingObstacle screen = buoy(0, 5, 1.0);
  const MovingObstacle behind = buoy(0, 12);
  Watch hidden{{screen, behind}};
  REQUIRE(hidden.see(0.0).count == 1);
  CHECK(hidden.tracks->tracks[0].id == 1);
  CHECK(seen_at_once({screen, buoy(3.5, 12)}) == 2);
  CHECK(seen_at_once({quay(8.0), behind}) == 1);
  screen.appears_at_s = 3.0;
  CHECK(seen_at_once({screen, behind}) == 1);  // it is the far one, there is no screen yet
}

TEST_CASE("track_oracle: what has left the view is remembered for so long, and where it was",
          "[low_level][sonar]") {
  Watch watch{{buoy(0, 10)}};
  REQUIRE(watch.see(1.0).count == 1);
  const Tracks& turned = watch.see(10.9, 180.0);
  REQUIRE(turned.count == 1);
  CHECK(turned.tracks[0].id == 1);
  CHECK(turned.tracks[0].last_seen == Time{from_seconds(1.0)});
  CHECK(turned.tracks[0].shape.centre_y_m == Approx(10.0));
  CHECK(turned.captured == Time{from_seconds(10.9)});
  CHECK(watch.see(11.1, 180.0).count == 0);
  CHECK(watch.see(11.2, 0.0).count == 1);
}

TEST_CASE("track_oracle: what is gone from where it should be seen is soon forgotten",
          "[low_level][sonar]") {
  MovingObstacle passing = buoy(0, 10);
  passing.vanishes_at_s = 3.05;
  Watch watch{{passing}};
  REQUIRE(watch.see(3.0).count == 1);
  CHECK(watch.see(4.9).count == 1);
  CHECK(watch.see(5.1).count == 0);
}

TEST_CASE("track_oracle: with a delay it knows what was known then", "[low_level][sonar]") {
  MovingObstacle mover = buoy(0, 10);
  mover.velocity_x_m_s = 1.0;
  TrackOracleOptions late = good_sight();
  late.delay = from_seconds(0.5);
  Watch watch{{mover}, late};
  for (int i = 0; i < 5; ++i) {
    CHECK(watch.see(1.0 + 0.1 * i).count == 0);
  }
  REQUIRE(watch.see(1.5).count == 1);
  CHECK(watch.tracks->captured == Time{from_seconds(1.0)});
  CHECK(watch.tracks->tracks[0].shape.centre_x_m == Approx(1.0));
  REQUIRE(watch.see(1.6).count == 1);
  CHECK(watch.tracks->tracks[0].shape.centre_x_m == Approx(1.1));
}

TEST_CASE("track_oracle: a velocity is known from the second sight, and when it ends",
          "[low_level][sonar]") {
  MovingObstacle mover = buoy(-2, 10);
  mover.velocity_x_m_s = 0.4;
  mover.stops_at_s = 3.0;
  Watch watch{{mover}};
  CHECK(watch.see(1.0).tracks[0].velocity_x_m_s == Approx(0.0).margin(1e-12));
  CHECK(watch.tracks->tracks[0].velocity_xx_m2_s2 > 0.2);
  CHECK(watch.see(1.1).tracks[0].velocity_x_m_s == Approx(0.4));
  CHECK(watch.tracks->tracks[0].velocity_xx_m2_s2 == Approx(0.0).margin(1e-12));
  CHECK(watch.see(3.1).tracks[0].velocity_x_m_s == Approx(0.0).margin(1e-12));
}

TEST_CASE(
    "track_oracle: with noise in the places a velocity is known the better the longer it is "
    "watched",
    "[low_level][sonar]") {
  TrackOracleOptions noisy = good_sight();
  noisy.place_sigma_m = 0.1;
  noisy.velocity_sigma_m_s = 0.03;
  Watch watch{{buoy(0, 10)}, noisy};
  const auto sigma_m_s = [&](double time_s) {
    return std::sqrt(watch.see(time_s).tracks[0].velocity_xx_m2_s2);
  };
  CHECK(sigma_m_s(1.0) == Approx(0.5));
  CHECK(sigma_m_s(1.1) == Approx(0.5));  // 1.4 m/s would be less than nothing known
  CHECK(watch.tracks->tracks[0].velocity_y_m_s == Approx(0.0).margin(1e-12));
  CHECK(sigma_m_s(2.0) == Approx(std::hypot(0.03, 0.1414)).epsilon(1e-3));
  CHECK(sigma_m_s(101.0) == Approx(0.03).epsilon(0.01));
}

TEST_CASE("track_oracle: noise is as large as it says, and repeatable by its seed",
          "[low_level][sonar]") {
  TrackOracleOptions noisy = good_sight();
  noisy.place_sigma_m = 0.2;
  noisy.velocity_sigma_m_s = 0.1;
  noisy.seed = 5;
  Watch one{{buoy(0, 10)}, noisy};
  Watch same{{buoy(0, 10), buoy(3, 8)}, noisy};  // a neighbour changes nothing
  noisy.seed = 6;
  Watch other{{buoy(0, 10)}, noisy};
  for (Watch* watch : {&one, &same, &other}) {
    watch->see(0.0);  // long watched
  }
  constexpr int kPings = 2000;
  double sum_m = 0.0;
  double squares_m2 = 0.0;
  double velocity_squares = 0.0;
  int differ = 0;
  for (int i = 0; i < kPings; ++i) {
    const double time_s = 10.0 + 0.1 * i;
    const Track& track = one.see(time_s).tracks[0];
    const Track& again = same.see(time_s).tracks[0];
    REQUIRE(std::abs(track.shape.centre_x_m - again.shape.centre_x_m) <= 0.0);
    REQUIRE(std::abs(track.velocity_y_m_s - again.velocity_y_m_s) <= 0.0);
    const double other_x_m = other.see(time_s).tracks[0].shape.centre_x_m;
    differ += std::abs(other_x_m - track.shape.centre_x_m) > 0.0 ? 1 : 0;
    sum_m += track.shape.centre_x_m;
    squares_m2 += track.shape.centre_x_m * track.shape.centre_x_m;
    velocity_squares += track.velocity_x_m_s * track.velocity_x_m_s;
  }
  CHECK(differ == kPings);
  CHECK(sum_m / kPings == Approx(0.0).margin(0.02));
  CHECK(std::sqrt(squares_m2 / kPings) == Approx(0.2).epsilon(0.08));
  CHECK(std::sqrt(velocity_squares / kPings) == Approx(0.1).epsilon(0.08));
  CHECK(one.tracks->tracks[0].place_xx_m2 == Approx(0.04));
  CHECK(one.tracks->tracks[0].velocity_yy_m2_s2 == Approx(0.01).epsilon(1e-3));
}

TEST_CASE("track_oracle: in a share of the pings an obstacle is missed, and known all the same",
          "[low_level][sonar]") {
  TrackOracleOptions poor = good_sight();
  poor.dropout = 0.3;
  Watch watch{{buoy(0, 10)}, poor};
  while (watch.see(1.0).count == 0) {
  }
  constexpr int kPings = 2000;
  int missed = 0;
  for (int i = 0; i < kPings; ++i) {
    const Tracks& tracks = watch.see(2.0 + 0.1 * i);
    REQUIRE(tracks.count == 1);
    missed += tracks.tracks[0].last_seen != tracks.captured ? 1 : 0;
  }
  CHECK(static_cast<double>(missed) / kPings == Approx(0.3).margin(0.04));
}

TEST_CASE("track_oracle: of a wall it knows what it has seen", "[low_level][sonar]") {
  Watch watch{{quay(10.0)}};
  const Track& ahead = watch.see(0.0).tracks[0];
  REQUIRE(watch.tracks->count == 1);
  REQUIRE(ahead.shape.vertex_count == 2);
  const double reach_m = 10.0 * std::tan(to_rad(60.0));
  CHECK(ahead.shape.vertices[0].x_m == Approx(-reach_m).margin(0.51));
  CHECK(ahead.shape.vertices[1].x_m == Approx(reach_m).margin(0.51));
  CHECK(std::abs(ahead.shape.vertices[0].x_m) <= reach_m + 1e-9);
  CHECK(ahead.shape.vertices[1].y_m == Approx(10.0));
  // To starboard it reaches as far as the range; what lies to port is remembered.
  const Track& turned = watch.see(1.0, 60.0).tracks[0];
  CHECK(turned.shape.vertices[0].x_m == Approx(-reach_m).margin(0.51));
  CHECK(turned.shape.vertices[1].x_m == Approx(std::sqrt(800.0)).margin(0.51));
}

TEST_CASE("track_oracle: what is large is seen as what is small is", "[low_level][sonar]") {
  for (const double radius_m : {2.0, 40.0, 400.0, 50'000.0}) {
    INFO(radius_m);
    for (const double bearing_deg : {-50.0, 0.0, 41.0}) {
      const double from_m = radius_m + 29.0;  // its edge lies 29 m off
      const double bearing_rad = to_rad(bearing_deg);
      CHECK(seen_at_once({buoy(from_m * std::sin(bearing_rad), from_m * std::cos(bearing_rad),
                               radius_m)}) == 1);
    }
    CHECK(seen_at_once({buoy(0.0, radius_m + 31.0, radius_m)}) == 0);
    CHECK(seen_at_once({buoy(0.0, -radius_m - 5.0, radius_m)}) == 0);
  }
  MovingObstacle bar = buoy(300.0, 20.0, 0.0);  // its end lies before the bow
  bar.at_start.semi_axis_first_m = 0.4;
  bar.at_start.semi_axis_second_m = 300.0;
  CHECK(seen_at_once({bar}) == 1);
}

TEST_CASE("track_oracle: a wall without length is seen, as a post", "[low_level][sonar]") {
  MovingObstacle post = quay(0.0);
  post.at_start.vertices[0] = post.at_start.vertices[1] = {1.0, 9.0};
  Watch watch{{post}};
  const Tracks& tracks = watch.see(0.0);
  REQUIRE(tracks.count == 1);
  const Obstacle& shape = tracks.tracks[0].shape;
  REQUIRE(shape.vertex_count == 2);
  CHECK(shape.vertices[1].y_m == Approx(9.0));
  CHECK(seen_at_once({post, buoy(1.0, 20.0)}) == 2);  // and hides next to nothing
}

TEST_CASE("track_oracle: of a wall of any length it knows what it has seen", "[low_level][sonar]") {
  MovingObstacle coast = quay(20.0);
  coast.at_start.vertices[0] = {-1e6, 20.0};
  coast.at_start.vertices[1] = {2e6, 20.0};
  Watch watch{{coast}};
  const Tracks& tracks = watch.see(0.0);
  REQUIRE(tracks.count == 1);
  const Obstacle& shape = tracks.tracks[0].shape;
  REQUIRE(shape.vertex_count == 2);
  // What is within 30 m, 20 m off, but for a sample.
  CHECK(shape.vertices[0].x_m == Approx(-22.36).margin(0.5));
  CHECK(shape.vertices[1].x_m == Approx(22.36).margin(0.5));
}

TEST_CASE("track_oracle: of too many the farthest are left out and counted", "[low_level][sonar]") {
  Scene many{buoy(-14.5, 20.0, 0.1), buoy(14.5, 20.0, 0.1)};
  for (std::size_t i = 0; i < kMaxObstacles; ++i) {
    many.push_back(buoy(-12.8 + 0.4 * static_cast<double>(i), 20.0, 0.1));
  }
  Watch watch{many};
  REQUIRE(watch.see(0.0).count == kMaxObstacles);
  CHECK(watch.tracks->dropped == 2);
  CHECK(watch.tracks->tracks[0].id == 3);
}

TEST_CASE("track_oracle: allocates nothing once it is made", "[low_level][sonar]") {
  TrackOracleOptions options = good_sight();
  options.place_sigma_m = 0.1;
  options.dropout = 0.2;
  options.delay = from_seconds(0.3);
  Watch watch{{buoy(0, 10), buoy(3, 8), quay(15.0)}, options};
  const testing::AllocationScope scope;
  std::uint32_t most = 0;
  for (int i = 0; i < 100; ++i) {
    most = std::max(most, watch.see(0.1 * i, 2.0 * i).count);
  }
  const auto allocations = scope.count();
  CHECK(most == 3);
  CHECK(allocations == 0);
}

}  // namespace lodesman
