// SPDX-License-Identifier: Apache-2.0
#include "low_level/thrust/guard.h"

#include <cmath>
#include <memory>
#include <vector>

#include "tests/support/catch.h"
#include "tests/unit/thrust/a_hull.h"

using namespace lodesman;
using lodesman::testing::a_guard;
using std::chrono::milliseconds;
using std::chrono::seconds;

namespace {

constexpr Time kCastOff{seconds{100}};
constexpr Duration kStep = milliseconds{50};

[[nodiscard]] Obstacle stone(double x_m, double y_m, double radius_m = 0.5) {
  Obstacle obstacle;
  obstacle.centre_x_m = x_m;
  obstacle.centre_y_m = y_m;
  obstacle.semi_axis_first_m = obstacle.semi_axis_second_m = radius_m;
  return obstacle;
}

// A boat that is as its guard takes it to be, among stones that rest, in still water. It sails
// north from the origin.
class Sail {
 public:
  explicit Sail(const GuardOptions& options = a_guard())
      : guard{std::make_unique<Guard>(options)}, model_{options.hull} {}

  // One step of the task; a ping every other one.
  SurgeAndHead step(const SurgeAndHead& asked, const GuardView& view = {true, false, false}) {
    now += kStep;
    motion = model_.advanced(motion, thrust, to_seconds(kStep));
    for (Obstacle& each : stones) {
      each.centre_y_m += stones_y_m_s * to_seconds(kStep);
    }
    guard->advance(now, nullptr);
    if (++steps_ % 2 == 0 && pings) {
      ping(stones);
    }
    thrust = guard->judge(asked, view, now).value_or(asked);
    guard->applied(thrust, now);
    for (const Obstacle& each : stones) {
      least_m = std::min(least_m, hull_distance_m(each));
    }
    return thrust;
  }
  void sail(const SurgeAndHead& asked, double for_s, const GuardView& view = {true, false, false}) {
    for (double left_s = for_s; left_s > 1e-9; left_s -= to_seconds(kStep)) {
      step(asked, view);
    }
  }
  // As the sonar has them, from where the boat is.
  void ping(const std::vector<Obstacle>& shown) {
    seen->captured = now;
    ++seen->frame;
    seen->count = 0;
    const double sine = std::sin(motion.heading_rad);
    const double cosine = std::cos(motion.heading_rad);
    for (const Obstacle& each : shown) {
      const double dx_m = each.centre_x_m - motion.x_m;
      const double dy_m = each.centre_y_m - motion.y_m;
      seen->obstacles[seen->count] =
          stone(dx_m * cosine - dy_m * sine, dx_m * sine + dy_m * cosine, each.semi_axis_first_m);
      seen->obstacles[seen->count++].id = each.id;
    }
    guard->see(*seen);
  }
  [[nodiscard]] double hull_distance_m(const Obstacle& each) const {
    const double dx_m = each.centre_x_m - motion.x_m;
    const double dy_m = each.centre_y_m - motion.y_m;
    const double sine = std::sin(motion.heading_rad);
    const double cosine = std::cos(motion.heading_rad);
    const double across_m = std::max(0.0, std::abs(dx_m * cosine - dy_m * sine) - 0.6);
    const double along_m = std::max(0.0, std::abs(dx_m * sine + dy_m * cosine) - 1.02);
    return std::hypot(across_m, along_m) - each.semi_axis_first_m;
  }

  std::unique_ptr<Guard> guard;
  std::unique_ptr<SonarObstacles> seen = std::make_unique<SonarObstacles>();
  std::vector<Obstacle> stones;
  double stones_y_m_s = 0.0;
  ReckonedMotion motion;
  SurgeAndHead thrust;
  Time now = kCastOff;
  double least_m = 1e9;
  bool pings = true;

 private:
  ReckoningModel model_;
  int steps_ = 0;
};

constexpr GuardView kSilent{true, false, true};

}  // namespace

TEST_CASE("guard: full ahead at a stone it stops before it, and stays", "[low_level][thrust]") {
  for (const int surge_ref : {1, 8, 16, 31, 57, 91, 100}) {
    for (const double offset_m : {0.0, 0.5, 0.9, 1.05}) {
      Sail sail;
      sail.stones = {stone(offset_m, 7.0)};
      sail.sail({surge_ref, 0}, surge_ref < 8 ? 600.0 : 90.0);
      INFO(surge_ref << " " << offset_m);
      CHECK(sail.least_m > 0.1);
      CHECK(sail.least_m < 0.5);
      CHECK(sail.guard->status().state == GuardState::kHolding);
      CHECK(sail.guard->status().reason == GuardReason::kObstacle);
      CHECK(sail.guard->status().trips == 1);
      CHECK(std::abs(sail.motion.surge_m_s) < 0.03);
    }
  }
}

TEST_CASE("guard: what it passes clear of stops nothing", "[low_level][thrust]") {
  Sail sail;
  sail.stones = {stone(1.4, 7.0), stone(-1.4, 9.0)};
  sail.sail({91, 0}, 20.0);
  CHECK(sail.guard->status().trips == 0);
  CHECK(sail.guard->status().state == GuardState::kWatching);
  CHECK(sail.motion.y_m > 15.0);
}

TEST_CASE("guard: what one ping alone shows stops nothing, what two of three show does",
          "[low_level][thrust]") {
  Sail sail;
  sail.sail({91, 0}, 10.0);
  sail.pings = false;
  const std::vector<Obstacle> ahead{stone(0.0, sail.motion.y_m + 2.3)};
  sail.ping(ahead);
  CHECK(sail.step({91, 0}).surge_ref == 91);
  sail.ping({});
  CHECK(sail.step({91, 0}).surge_ref == 91);
  CHECK(sail.guard->status().trips == 0);
  sail.ping(ahead);  // the first of them and this one
  CHECK(sail.step({91, 0}).surge_ref == -100);
  CHECK(sail.guard->status().trips == 1);
  CHECK(sail.guard->status().distance_m < 1.0);
  CHECK(sail.guard->status().trip_speed_m_s == Approx(1.1).margin(0.05));
}

TEST_CASE("guard: what opens the distance is never cut", "[low_level][thrust]") {
  Sail sail;
  sail.stones = {stone(0.0, 7.0)};
  sail.sail({57, 0}, 30.0);
  REQUIRE(sail.guard->status().state == GuardState::kHolding);
  SECTION("astern") {
    CHECK(sail.step({-40, 0}).surge_ref == -40);
    sail.sail({-40, 0}, 5.0);
    CHECK(sail.guard->status().state == GuardState::kWatching);
    CHECK(sail.guard->status().trips == 1);
  }
  SECTION("neutral") {
    CHECK(sail.step({0, 0}).surge_ref == 0);
    CHECK(sail.guard->status().state == GuardState::kWatching);
  }
  SECTION("and ahead it is cut anew") { CHECK(sail.step({30, 0}).surge_ref == 0); }
}

TEST_CASE("guard: beside a stone it turns away and not into it", "[low_level][thrust]") {
  Sail sail;
  // Off the starboard bow.
  sail.stones = {stone(1.15, 1.0)};
  sail.sail({0, 0}, 1.0);
  CHECK(sail.step({0, 60}).head_ref == 0);
  CHECK(sail.guard->status().state == GuardState::kHolding);
  CHECK(sail.step({0, -60}).head_ref == -60);
  sail.sail({0, -60}, 3.0);
  CHECK(sail.least_m > 0.0);
  CHECK(sail.motion.heading_rad < -0.3);
}

TEST_CASE("guard: along a wall inside the margin it goes on", "[low_level][thrust]") {
  Sail sail;
  for (int i = 0; i < 40; ++i) {
    sail.stones.push_back(stone(0.6 + 0.5 + 0.1, 0.5 * i, 0.5));
  }
  sail.sail({57, 0}, 15.0);
  CHECK(sail.guard->status().trips == 0);
  CHECK(sail.motion.y_m > 6.0);
}

TEST_CASE("guard: astern at a stone it brakes ahead, and never drives on", "[low_level][thrust]") {
  Sail sail;
  sail.stones = {stone(0.0, -6.0)};
  double most_m_s = 0.0;
  for (int i = 0; i < 400; ++i) {
    sail.step({-80, 0});
    most_m_s = std::max(most_m_s, sail.motion.surge_m_s);
  }
  CHECK(sail.least_m > 0.1);
  CHECK(sail.guard->status().state == GuardState::kHolding);
  CHECK(most_m_s < 0.05);
}

TEST_CASE("guard: nobody steers, so it takes the way off after a moment at neutral",
          "[low_level][thrust]") {
  Sail sail;
  sail.sail({91, 0}, 12.0);
  const double from_m = sail.motion.y_m;
  for (int i = 0; i < 6; ++i) {
    CHECK(sail.step({0, 0}, kSilent).surge_ref == 0);
  }
  CHECK(sail.step({0, 0}, kSilent).surge_ref == -100);
  CHECK(sail.guard->status().reason == GuardReason::kSilence);
  double least_m_s = 1.0;
  for (int i = 0; i < 200; ++i) {
    sail.step({0, 0}, kSilent);
    least_m_s = std::min(least_m_s, sail.motion.surge_m_s);
  }
  CHECK(sail.guard->status().state == GuardState::kHolding);
  CHECK(sail.guard->status().trips == 1);
  CHECK(sail.motion.y_m - from_m < 1.1);  // coasting it would be 2.3 m
  CHECK(least_m_s > -0.04);
  // Whoever steers again is obeyed.
  CHECK(sail.step({57, 0}).surge_ref == 57);
  CHECK(sail.guard->status().state == GuardState::kWatching);
}

TEST_CASE("guard: a short silence, or one with hardly any way on, brakes nothing",
          "[low_level][thrust]") {
  Sail sail;
  sail.sail({91, 0}, 12.0);
  sail.sail({0, 0}, 0.25, kSilent);
  sail.sail({91, 0}, 1.0);
  CHECK(sail.guard->status().trips == 0);
  Sail slow;
  slow.sail({7, 0}, 30.0);
  slow.sail({0, 0}, 5.0, kSilent);
  CHECK(slow.guard->status().trips == 0);
}

TEST_CASE("guard: braking has an end, whatever the model says", "[low_level][thrust]") {
  GuardOptions options = a_guard();
  options.brake_max = milliseconds{500};
  Sail sail{options};
  sail.sail({91, 0}, 12.0);
  sail.sail({0, 0}, 0.35, kSilent);
  REQUIRE(sail.guard->status().state == GuardState::kBraking);
  sail.sail({0, 0}, 0.55, kSilent);
  CHECK(sail.guard->status().state == GuardState::kHolding);
  CHECK(sail.thrust.surge_ref == 0);
  CHECK(sail.motion.surge_m_s > 0.3);
}

TEST_CASE("guard: without sonar it says that it is blind, and cuts nothing",
          "[low_level][thrust]") {
  Sail sail;
  sail.pings = false;
  sail.stones = {stone(0.0, 7.0)};
  sail.sail({57, 0}, 5.0);
  CHECK(sail.guard->status().state == GuardState::kBlind);
  CHECK(sail.thrust.surge_ref == 57);
  SECTION("frames that grow too old say nothing either") {
    sail.ping(sail.stones);
    sail.ping(sail.stones);
    sail.step({57, 0});
    CHECK(sail.guard->status().state == GuardState::kWatching);
    sail.sail({0, 0}, 2.1);
    CHECK(sail.guard->status().state == GuardState::kBlind);
  }
}

TEST_CASE("guard: a frame stamped in the future grows old as any other", "[low_level][thrust]") {
  Sail sail;
  sail.pings = false;
  sail.sail({0, 0}, 1.0);
  for (int i = 0; i < 3; ++i) {
    sail.seen->captured = sail.now + seconds{1'000'000};
    sail.guard->see(*sail.seen);
  }
  sail.step({0, 0});
  CHECK(sail.guard->status().state == GuardState::kWatching);
  sail.sail({0, 0}, 2.1);
  CHECK(sail.guard->status().state == GuardState::kBlind);
}

TEST_CASE("guard: what was stopped for stays known when the sonar falls silent",
          "[low_level][thrust]") {
  Sail sail;
  sail.stones = {stone(0.0, 7.0)};
  sail.sail({57, 0}, 30.0);
  REQUIRE(sail.guard->status().state == GuardState::kHolding);
  sail.pings = false;
  sail.sail({57, 0}, 30.0);
  CHECK(sail.guard->status().state == GuardState::kHolding);
  CHECK(sail.least_m > 0.1);
}

TEST_CASE("guard: it turns nothing that may not turn, and obeys an override",
          "[low_level][thrust]") {
  Sail sail;
  sail.stones = {stone(0.0, 3.0)};
  sail.sail({57, 0}, 1.0);
  sail.step({57, 0}, {false, false, true});
  CHECK(sail.guard->status().state == GuardState::kIdle);
  CHECK(sail.thrust.surge_ref == 57);
  sail.sail({57, 0}, 5.0, {true, true, false});
  CHECK(sail.guard->status().state == GuardState::kOverridden);
  CHECK(sail.least_m < 0.0);
  CHECK(sail.guard->status().trips == 0);
}

TEST_CASE("guard: by configuration it is off", "[low_level][thrust]") {
  GuardOptions options = a_guard();
  options.is_on = false;
  Sail sail{options};
  sail.stones = {stone(0.0, 3.0)};
  sail.sail({91, 0}, 5.0);
  sail.sail({0, 0}, 1.0, kSilent);
  CHECK(sail.guard->status().state == GuardState::kOff);
  CHECK(sail.guard->status().trips == 0);
}

TEST_CASE("guard: what moves out of the way stops nothing, what is met does",
          "[low_level][thrust]") {
  for (const double away_m_s : {0.9, -0.5}) {
    Sail sail;
    sail.sail({57, 0}, 10.0);
    sail.stones = {
        stone(0.0, sail.motion.y_m + 2.4)};  // nearer than it takes to stop, were it at rest
    sail.stones[0].id = 7;
    sail.stones_y_m_s = away_m_s;
    sail.sail({57, 0}, 3.0);
    CHECK((sail.guard->status().trips > 0) == (away_m_s < 0.0));
  }
}

TEST_CASE("guard: who flees from what moves is left to it", "[low_level][thrust]") {
  Sail sail;
  sail.stones = {stone(0.0, 6.0)};
  sail.stones[0].id = 7;
  sail.stones_y_m_s = -0.7;
  sail.sail({30, 0}, 3.0);
  for (int i = 0; i < 100; ++i) {
    CHECK(sail.step({-80, 0}).surge_ref <= -80);
  }
}

TEST_CASE("guard: full astern already is no trip", "[low_level][thrust]") {
  Sail sail;
  sail.sail({91, 0}, 10.0);
  sail.stones = {stone(0.0, sail.motion.y_m + 2.35)};
  sail.pings = false;
  sail.ping(sail.stones);
  sail.ping(sail.stones);
  CHECK(sail.step({-100, 0}).surge_ref == -100);
  CHECK(sail.guard->status().trips == 0);
}

TEST_CASE("guard: a box that takes its time to reverse is braked for earlier",
          "[low_level][thrust]") {
  GuardOptions options = a_guard();
  options.brake_delay = milliseconds{600};
  Sail late{options};
  Sail prompt;
  for (Sail* sail : {&late, &prompt}) {
    sail->stones = {stone(0.0, 12.0)};
    while (sail->guard->status().trips == 0 && sail->motion.y_m < 12.0) {
      sail->step({91, 0});
    }
  }
  CHECK(late.motion.y_m < prompt.motion.y_m - 0.25);
}
