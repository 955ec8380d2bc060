// SPDX-License-Identifier: Apache-2.0
#include "high_level/guidance/manoeuvre.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "mid_level/base/heading.h"
#include "mid_level/geometry/moving_obstacle.h"
#include "mid_level/geometry/obstacle_distance.h"
#include "tests/support/catch.h"
#include "tests/unit/guidance/support.h"

namespace lodesman::testing {
namespace {

using Vec = Eigen::Vector2d;
using Choice = ManoeuvreChooser::Choice;

const Manoeuvre kAlongTheRoute{0.0, 0.0, 1.0};

OwnMotion northward_at(double y_m, double surge_m_s = 1.0) { return {{0.0, y_m}, 0.0, surge_m_s}; }

Route route_north() { return route_of({{0, 0}, {0, 20}}); }

std::unique_ptr<ManoeuvreChooser> chooser(const ManoeuvreOptions& options = default_manoeuvres()) {
  return std::make_unique<ManoeuvreChooser>(default_response(), options);
}

Choice choose(ManoeuvreChooser& chooser, const Tracks& tracks,
              const OwnMotion& own = northward_at(0.0)) {
  return chooser.choose(at_s(0), own, route_north(), tracks, 1.0, false);
}

// A boat that does what is chosen, five times a second, among tracks that keep their velocities.
struct Voyage {
  double least_m = std::numeric_limits<double>::infinity();  // centre to an obstacle's edge
  Vec end = Vec::Zero();
  double far_aside_m = 0.0;     // most to starboard, negative to port
  bool ahead_of_first = false;  // crossed the first track's way before it
};

Voyage sail(const Tracks& tracks, double duration_s) {
  constexpr double kStep_s = 0.2;
  const VehicleResponse r = default_response();
  const Route route = route_north();
  const auto chooses = chooser();
  Voyage voyage;
  OwnMotion own = northward_at(0.0);
  for (double t_s = 0.0; t_s < duration_s; t_s += kStep_s) {
    const Choice& choice = chooses->choose(at_s(t_s), own, route, tracks, 1.0, false);
    const Vec before = own.p_W;
    Rollout rollout{r, route, own, choice.manoeuvre, 1.0, false};
    rollout.sail(kStep_s);
    const VehicleMotion& sailed = rollout.motion();
    own.p_W = sailed.position.xy_m;
    own.heading_rad = sailed.heading_rad;
    own.surge_m_s = sailed.velocity[0];
    own.sway_m_s = sailed.velocity[1];
    own.yaw_rate_rad_s = sailed.velocity[2];
    for (std::uint32_t i = 0; i < tracks.count; ++i) {
      const Track& track = tracks.tracks[i];
      const Obstacle now =
          translated(track.shape, t_s * track.velocity_x_m_s, t_s * track.velocity_y_m_s);
      voyage.least_m = std::min(voyage.least_m, edge_distance_m(now, {own.p_W}));
      if (i == 0 && before.y() < now.centre_y_m && own.p_W.y() >= now.centre_y_m) {
        voyage.ahead_of_first = (own.p_W.x() - now.centre_x_m) * track.velocity_x_m_s > 0.0;
      }
    }
    voyage.far_aside_m =
        std::abs(own.p_W.x()) > std::abs(voyage.far_aside_m) ? own.p_W.x() : voyage.far_aside_m;
  }
  voyage.end = own.p_W;
  return voyage;
}

}  // namespace

TEST_CASE("manoeuvre: with nothing in the way the route is followed at full speed",
          "[high_level][guidance]") {
  const auto chooses = chooser();
  const Choice free = choose(*chooses, tracks_of({}));
  CHECK(free.manoeuvre == kAlongTheRoute);
  CHECK(free.foresight.delay_s == Approx(0.0).margin(1e-12));
  CHECK(std::isinf(free.foresight.least_clearance_m));
  CHECK_FALSE(free.changed);
  REQUIRE(free.way.count == 2);
  CHECK((free.way.points[0] - Vec{0, 0}).norm() < 1e-12);
  CHECK((free.way.end() - Vec{0, 20}).norm() < 1e-12);
  const Choice abeam = choose(*chooses, tracks_of({disc_track(5, 9, 10)}));
  CHECK(abeam.manoeuvre == kAlongTheRoute);
  CHECK(abeam.foresight.least_track == 5);
  // Far off it is a lower bound.
  CHECK(abeam.foresight.least_clearance_m <= 9.0 - 0.5 - 0.79);
  CHECK(abeam.foresight.least_clearance_m >= 9.0 - 0.5 - 0.79 - 0.6);
}

TEST_CASE("manoeuvre: what is allowed here is the fastest it goes", "[high_level][guidance]") {
  const auto chooses = chooser();
  const Choice& choice =
      chooses->choose(at_s(0), northward_at(0), route_north(), tracks_of({}), 0.5, false);
  CHECK(choice.manoeuvre == Manoeuvre{0.0, 0.0, 0.5});
}

TEST_CASE("manoeuvre: a head-on mover is given way to starboard, and kept clear of",
          "[high_level][guidance]") {
  const Tracks tracks = tracks_of({disc_track(3, 0, 16, 0.0, -0.5)});
  const auto chooses = chooser();
  const Choice choice = choose(*chooses, tracks);
  CHECK(choice.of_route.touches);
  CHECK(choice.of_route.least_track == 3);
  CHECK(choice.manoeuvre.for_s > 0.0);
  CHECK_FALSE(choice.foresight.touches);
  CHECK(choice.changed);
  // The way leads aside and back to the route's end.
  CHECK(choice.way.count > 3);
  CHECK((choice.way.end() - Vec{0, 20}).norm() < 1e-12);

  const Voyage voyage = sail(tracks, 20.0);
  CHECK(voyage.least_m > 0.8);
  CHECK(voyage.far_aside_m > 0.8);
  CHECK(voyage.end.y() > 14.0);
}

TEST_CASE("manoeuvre: something that crosses is passed astern", "[high_level][guidance]") {
  for (const double side : {1.0, -1.0}) {
    const Tracks tracks = tracks_of({disc_track(3, side * 6.4, 8, -side * 0.8, 0.0)});
    const auto chooses = chooser();
    CHECK(choose(*chooses, tracks).of_route.touches);
    const Voyage voyage = sail(tracks, 24.0);
    CHECK_FALSE(voyage.ahead_of_first);
    CHECK(voyage.least_m > 0.8);
    CHECK(voyage.end.y() > 14.0);
  }
}

TEST_CASE("manoeuvre: it stops before a way that is blocked all round", "[high_level][guidance]") {
  // A dead end, too narrow to turn in.
  const Tracks tracks = tracks_of({wall_track(6, {{-2, -4}, {-2, 7}, {2, 7}, {2, -4}})});
  const auto chooses = chooser();
  const Choice choice = choose(*chooses, tracks, northward_at(2.0));
  CHECK(choice.of_route.touches);
  CHECK_FALSE(choice.foresight.touches);
  CHECK((choice.foresight.stops || choice.manoeuvre.speed_share <= 0.0));
  const Voyage voyage = sail(tracks, 40.0);
  CHECK(voyage.least_m > 1.0);
}

TEST_CASE("manoeuvre: where nothing slower keeps clear it flees, and only there",
          "[high_level][guidance]") {
  // A slow boat, and something faster that comes up on its beam.
  const VehicleResponse slow = response_at({20, 0.2});
  ManoeuvreOptions options = default_manoeuvres();
  const auto choice_with = [&](double flight_speed_m_s, const Tracks& tracks) {
    options.flight_speed_m_s = flight_speed_m_s;
    const auto chooses = std::make_unique<ManoeuvreChooser>(slow, options);
    return std::make_unique<Choice>(
        chooses->choose(at_s(0), northward_at(0.0, 0.2), route_north(), tracks, 1.0, false));
  };
  const Tracks fast = tracks_of({disc_track(1, 5.0, 0.5, -1.0, 0.0)});
  CHECK(choice_with(0.0, fast)->foresight.touches);
  const auto fled = choice_with(1.0, fast);
  CHECK_FALSE(fled->foresight.touches);
  CHECK(std::abs(fled->manoeuvre.speed_share) > 1.0);
  const auto calm = choice_with(1.0, tracks_of({disc_track(1, 12.0, 3.0, -0.5, 0.0)}));
  CHECK_FALSE(calm->foresight.touches);
  CHECK(std::abs(calm->manoeuvre.speed_share) <= 1.0);
}

TEST_CASE("manoeuvre: it is kept to unless another gains more than is stated",
          "[high_level][guidance]") {
  const Tracks to_port = tracks_of({disc_track(3, -0.4, 16, 0.0, -0.5)});
  const Tracks to_starboard = tracks_of({disc_track(3, 0.4, 16, 0.0, -0.5)});
  const auto fresh = chooser();
  REQUIRE(choose(*fresh, to_starboard).manoeuvre.offset_rad < 0.0);

  ManoeuvreOptions options = default_manoeuvres();
  options.switch_gain_s = 10.0;
  const auto loyal = chooser(options);
  const Manoeuvre first = choose(*loyal, to_port).manoeuvre;
  REQUIRE(first.offset_rad > 0.0);
  const Choice second = choose(*loyal, to_starboard);
  CHECK(second.manoeuvre == first);
  CHECK_FALSE(second.changed);

  options.switch_gain_s = 0.0;
  const auto fickle = chooser(options);
  (void)choose(*fickle, to_port);
  const Choice other = choose(*fickle, to_starboard);
  CHECK(other.manoeuvre.offset_rad < 0.0);
  CHECK(other.changed);
}

TEST_CASE("manoeuvre: what was kept to can be forgotten", "[high_level][guidance]") {
  ManoeuvreOptions options = default_manoeuvres();
  options.switch_gain_s = 10.0;
  const auto chooses = chooser(options);
  REQUIRE(choose(*chooses, tracks_of({disc_track(3, -0.4, 16, 0.0, -0.5)})).manoeuvre.for_s > 0.0);
  chooses->forget();
  CHECK_FALSE(choose(*chooses, tracks_of({})).changed);
}

TEST_CASE("manoeuvre: doubt of where a track is widens the berth", "[high_level][guidance]") {
  Track beside = disc_track(3, 2.2, 8);
  const auto sure = chooser();
  CHECK(choose(*sure, tracks_of({beside})).of_route.delay_s == Approx(0.0).margin(1e-12));
  beside.place_xx_m2 = beside.place_yy_m2 = 0.25;
  const auto unsure = chooser();
  CHECK(choose(*unsure, tracks_of({beside})).of_route.delay_s > 0.0);
}

TEST_CASE("manoeuvre: a place to wait at is waited at, a goal is not", "[high_level][guidance]") {
  // A mover that reaches the route's end well after the boat can be there.
  const Tracks tracks = tracks_of({disc_track(3, 20, 10, -0.9, 0.0)});
  const Route route = route_of({{0, 0}, {0, 10}});
  const auto passes = chooser();
  const auto waits = chooser();
  const double to_goal =
      passes->choose(at_s(0), northward_at(0), route, tracks, 1.0, false).of_route.delay_s;
  const Choice& waiting = waits->choose(at_s(0), northward_at(0), route, tracks, 1.0, true);
  CHECK(waiting.of_route.delay_s > to_goal);
  CHECK(waiting.of_route.touches);
}

}  // namespace lodesman::testing
