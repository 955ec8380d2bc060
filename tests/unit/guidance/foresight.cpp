// SPDX-License-Identifier: Apache-2.0
#include "high_level/guidance/foresight.h"

#include <memory>

#include "tests/support/catch.h"
#include "tests/unit/guidance/support.h"

namespace lodesman::testing {
namespace {

using Vec = Eigen::Vector2d;

// A boat that goes north at (0, 0), and a route before it.
struct View {
  explicit View(const Tracks& seen, double surge_m_s = 1.0) : tracks{seen} {
    response.most_share = 1.2;
    outlook.response = &response;
    outlook.options = &options;
    outlook.route = &route;
    outlook.own.surge_m_s = surge_m_s;
    foresee_hazards(at_s(0.0), tracks, 0.0, outlook.hazards);
    look_as_far_as_needed(outlook);
  }
  View(const View&) = delete;
  View& operator=(const View&) = delete;
  ~View() = default;

  Tracks tracks;
  VehicleResponse response = default_response();
  ManoeuvreOptions options = default_manoeuvres();
  Route route = route_of({{0, 0}, {0, 20}});
  Outlook outlook;
};

const Manoeuvre kRoute{0.0, 0.0, 1.0};

Track quay() { return wall_track(1, {{-30.0, 10.0}, {30.0, 10.0}}); }

}  // namespace

TEST_CASE("foresight: a voyage ends where it touches, and nothing beyond counts",
          "[high_level][guidance]") {
  const auto wall = std::make_unique<View>(tracks_of({quay()}));
  const Foresight through = foresee(wall->outlook, kRoute);
  CHECK(through.touches);
  CHECK(through.harm > 0.0);
  CHECK(through.least_after_s < 12.0);
  CHECK(through.least_clearance_m > -0.5);
}

TEST_CASE("foresight: no time that is saved makes up for a touch", "[high_level][guidance]") {
  Foresight touches;
  touches.touches = true;
  touches.harm = 1e-9;
  Foresight dear;
  dear.cost_s = 1e9;
  CHECK(is_better(dear, touches));
  CHECK_FALSE(is_better(touches, dear));
  Foresight worse = touches;
  worse.harm = 1.0;
  CHECK(is_better(touches, worse));
}

TEST_CASE("foresight: what would touch on its way back is foreseen to a stop",
          "[high_level][guidance]") {
  const auto wall = std::make_unique<View>(tracks_of({quay()}));
  const Manoeuvre on{0.0, 2.0, 1.0};
  const Foresight stopped = foresee(wall->outlook, on);
  CHECK(stopped.stops);
  CHECK_FALSE(stopped.touches);
  CHECK(stopped.least_clearance_m > 0.0);
  Route way;
  show_way(wall->outlook, on, stopped, way);
  CHECK(way.end().y() < 9.0);
  // Too late to stop: it says so.
  const Foresight late = foresee(wall->outlook, {0.0, 8.5, 1.0});
  CHECK(late.touches);
  // The farther it gets before it stops, the better.
  CHECK(is_better(foresee(wall->outlook, {0.0, 4.0, 1.0}), stopped));
  // Also where the way back is given up for what it costs before it touches.
  CHECK(is_better(foresee(wall->outlook, {0.0, 4.0, 1.0}, &stopped), stopped));
}

TEST_CASE("foresight: slower and later is the lesser harm", "[high_level][guidance]") {
  // It comes from ahead, faster than anything flees.
  const auto boat = std::make_unique<View>(tracks_of({disc_track(1, 0.0, 15.0, 0.0, -2.0)}));
  const Foresight ahead = foresee(boat->outlook, kRoute);
  const Foresight stopped = foresee(boat->outlook, {0.0, 12.0, 0.0});
  REQUIRE(ahead.touches);
  REQUIRE(stopped.touches);
  CHECK(is_better(stopped, ahead));
}

TEST_CASE("foresight: what it overlaps already it may leave, and not enter deeper",
          "[high_level][guidance]") {
  const auto beside = std::make_unique<View>(tracks_of({disc_track(1, 0.0, 1.6)}), 0.0);
  CHECK(foresee(beside->outlook, kRoute).touches);
  CHECK_FALSE(foresee(beside->outlook, {0.0, 5.0, -0.4}).touches);
}

TEST_CASE("foresight: a hypothesis that is hardly believed costs, and does not decide",
          "[high_level][guidance]") {
  Track doubtful = disc_track(1, 2.2, 10.0, -0.2, 0.0);
  const auto seen_with = [&](double sigma_m_s) {
    doubtful.velocity_xx_m2_s2 = doubtful.velocity_yy_m2_s2 = sigma_m_s * sigma_m_s;
    return foresee(std::make_unique<View>(tracks_of({doubtful}))->outlook, kRoute);
  };
  CHECK(seen_with(0.02).touches);
  const Foresight hardly = seen_with(0.1);
  REQUIRE(probability_of_motion(doubtful) > 0.05);
  REQUIRE(probability_of_motion(doubtful) < 0.2);
  CHECK_FALSE(hardly.touches);
  CHECK(hardly.delay_s > 0.0);
}

}  // namespace lodesman::testing
