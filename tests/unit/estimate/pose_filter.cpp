// SPDX-License-Identifier: Apache-2.0
#include "high_level/estimate/pose_filter.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/support/allocations.h"
#include "tests/support/catch.h"
#include "tests/unit/estimate/support.h"

namespace lodesman::testing {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using Vec = Eigen::Vector2d;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// A boat without luck of its own, and the filter that follows it.
struct Voyage {
  explicit Voyage(const Vec& current_m_s = Vec::Zero()) { boat.current_m_s = current_m_s; }

  void step() {
    const Vec before = odometry();
    const Vec was = boat.motion.position.xy_m;
    boat.step(surge_ref, head_ref);
    filter.advance(boat.now, surge_ref, head_ref, boat.attitude());
    const double jump_m = (odometry() - before - (boat.motion.position.xy_m - was)).norm();
    if (filter.knows_position() && sailed_s > 1.0) {
      largest_jump_m = std::max(largest_jump_m, jump_m);
    }
    sailed_s += SailedBoat::kStep_s;
  }
  // So long with a fix every 0.2 s, each off by that.
  void sail(double for_s, const Vec& off_m = Vec::Zero()) {
    for (int i = 0; i < std::lround(for_s / SailedBoat::kStep_s); ++i) {
      step();
      if (i % 10 == 0) {
        verdict = give(off_m);
      }
    }
  }
  void sail_blind(double for_s) {
    for (int i = 0; i < std::lround(for_s / SailedBoat::kStep_s); ++i) {
      step();
    }
  }
  FixVerdict give(const Vec& off_m = Vec::Zero()) {
    return filter.fix({boat.fix(sigma_m).xy_m + off_m}, sigma_m, boat.now);
  }
  [[nodiscard]] Vec odometry() const {
    const VehicleState state = filter.state();
    return {state.odometry_x_m, state.odometry_y_m};
  }
  [[nodiscard]] Vec place() const { return filter.mean().head<2>(); }
  [[nodiscard]] double error_m() const { return (place() - boat.motion.position.xy_m).norm(); }
  [[nodiscard]] double sigma_of_place_m() const {
    return std::sqrt(filter.covariance().topLeftCorner<2, 2>().trace());
  }

  SailedBoat boat{filter_options(), 7, 0.0};
  PoseFilter filter{filter_options()};
  int surge_ref = 57;
  int head_ref = 0;
  double sigma_m = 0.5;
  double sailed_s = 0.0;
  double largest_jump_m = 0.0;
  FixVerdict verdict = FixVerdict::kRefused;
};

}  // namespace

TEST_CASE("pose filter: it is nearer than the fixes are, and learns the current",
          "[high_level][estimate]") {
  Voyage voyage{{0.2, -0.1}};
  voyage.sail(60.0);
  CHECK(voyage.error_m() < 0.25);
  CHECK(voyage.sigma_of_place_m() < 0.3);
  CHECK((voyage.filter.mean().tail<2>() - Vec{0.2, -0.1}).norm() < 0.05);
  CHECK(voyage.filter.state().trust == PositionTrust::kTracked);
}

TEST_CASE("pose filter: thrust that was not applied moves nothing", "[high_level][estimate]") {
  Voyage voyage;
  voyage.surge_ref = 0;
  voyage.sail(20.0);
  CHECK(std::abs(voyage.filter.mean()[PoseFilter::kSurge]) < 0.05);
  CHECK(voyage.place().norm() < 0.3);
}

TEST_CASE("G11: one fix far off is refused, after a minute without any too",
          "[high_level][estimate]") {
  for (const double off_m : {5.0, 15.0, 30.0, 100.0}) {
    Voyage voyage;
    voyage.sail(30.0);
    const Vec before = voyage.place();
    CHECK(voyage.give({off_m, 0.0}) == FixVerdict::kRefused);
    CHECK((voyage.place() - before).norm() == Approx(0.0).margin(1e-12));
    voyage.step();
    CHECK(voyage.give() == FixVerdict::kBelieved);

    voyage.sail_blind(60.0);
    CHECK_FALSE(voyage.filter.knows_position());
    const FixVerdict alone = voyage.give({off_m, 0.0});
    CHECK((alone == FixVerdict::kRefused || alone == FixVerdict::kAwaits));
    CHECK_FALSE(voyage.filter.knows_position());
    voyage.sail(1.0);
    CHECK(voyage.filter.knows_position());
    CHECK(voyage.error_m() < 1.0);
  }
}

TEST_CASE("G11: fixes that go on to be far off are approached no faster than set",
          "[high_level][estimate]") {
  Voyage voyage;
  voyage.sail(30.0);
  voyage.sail(2.0, {5.0, 0.0});  // ten of them
  CHECK(voyage.verdict == FixVerdict::kRefused);
  CHECK(voyage.error_m() < 0.5);
  voyage.sail(2.0);
  CHECK(voyage.verdict == FixVerdict::kBelieved);
  bool told = false;
  double fastest_m_s = 0.0;
  for (int i = 0; i < 25; ++i) {
    const Vec off = voyage.place() - voyage.boat.motion.position.xy_m;
    voyage.sail(1.0, {5.0, 0.0});
    const Vec off_now = voyage.place() - voyage.boat.motion.position.xy_m;
    told = told || voyage.filter.state().trust == PositionTrust::kApproaching;
    if (voyage.filter.state().trust == PositionTrust::kApproaching) {
      fastest_m_s = std::max(fastest_m_s, (off_now - off).norm());
    }
    CHECK(voyage.filter.knows_position());
  }
  CHECK(told);
  CHECK(fastest_m_s <= 0.55);  // half a metre a second, and what its speed is off by
  CHECK((voyage.place() - voyage.boat.motion.position.xy_m - Vec{5.0, 0.0}).norm() < 0.3);
  CHECK(voyage.filter.state().trust == PositionTrust::kTracked);
  CHECK(voyage.largest_jump_m < 0.01);
}

TEST_CASE("pose filter: a boat that goes as no model foresees is followed again",
          "[high_level][estimate]") {
  Voyage towed;
  towed.sail(30.0);
  towed.boat.current_m_s = {1.5, 0.0};  // three times what the gate allows for
  towed.sail(30.0);
  CHECK(towed.error_m() < 1.0);
  CHECK((towed.filter.mean().tail<2>() - towed.boat.current_m_s).norm() < 0.3);
  CHECK(towed.filter.state().trust == PositionTrust::kTracked);
}

TEST_CASE("G12: another receiver with a bias moves the estimate slowly", "[high_level][estimate]") {
  Voyage voyage;
  voyage.sail(30.0);
  voyage.sail_blind(5.0);  // one is lost ...
  double largest_step_m = 0.0;
  for (int i = 0; i < 200; ++i) {  // ... and another takes over, 3 m beside it
    voyage.step();
    const Vec before = voyage.place();
    if (i % 10 == 0) {
      (void)voyage.give({0.0, 3.0});
    }
    largest_step_m = std::max(largest_step_m, (voyage.place() - before).norm());
  }
  CHECK(largest_step_m < 1.0);
  CHECK(voyage.largest_jump_m < 0.02);
}

TEST_CASE("pose filter: a fix that comes late counts where it was measured",
          "[high_level][estimate]") {
  Voyage voyage;
  PoseFilter late{filter_options()};
  std::array<std::pair<WorldPoint, Time>, 40> on_their_way;
  std::size_t sent = 0;
  std::size_t come = 0;
  for (int i = 0; i < 400; ++i) {
    voyage.head_ref = i < 200 ? 20 : -20;
    voyage.boat.step(voyage.surge_ref, voyage.head_ref);
    const Attitude attitude = voyage.boat.attitude();
    voyage.filter.advance(voyage.boat.now, voyage.surge_ref, voyage.head_ref, attitude);
    late.advance(voyage.boat.now, voyage.surge_ref, voyage.head_ref, attitude);
    if (i % 10 == 0 && i <= 300) {
      on_their_way[sent] = {voyage.boat.fix(0.5), voyage.boat.now};
      (void)voyage.filter.fix(on_their_way[sent].first, 0.5, voyage.boat.now);
      ++sent;
    }
    if (come < sent && voyage.boat.now - on_their_way[come].second >= milliseconds{700}) {
      (void)late.fix(on_their_way[come].first, 0.5, on_their_way[come].second);
      ++come;
    }
  }
  REQUIRE(come == sent);
  CHECK((late.mean() - voyage.filter.mean()).norm() == Approx(0.0).margin(1e-6));
  CHECK((late.covariance() - voyage.filter.covariance()).norm() == Approx(0.0).margin(1e-6));
}

TEST_CASE("G5: without fixes it goes on by its model, with growing doubt, and then says it is lost",
          "[high_level][estimate]") {
  Voyage voyage{{0.1, 0.0}};
  voyage.sail(60.0);
  const double known_m = voyage.sigma_of_place_m();
  voyage.sail_blind(10.0);
  CHECK(voyage.filter.knows_position());
  CHECK(voyage.filter.state().trust == PositionTrust::kBridged);
  CHECK(voyage.sigma_of_place_m() > 1.2 * known_m);
  CHECK(voyage.error_m() < 3.0 * voyage.sigma_of_place_m());
  CHECK(voyage.error_m() < 1.0);
  voyage.sail_blind(5.1);
  CHECK_FALSE(voyage.filter.knows_position());
  CHECK(voyage.filter.state().trust == PositionTrust::kLost);
}

TEST_CASE("pose filter: the odometry pose never jumps, whatever the fixes do",
          "[high_level][estimate]") {
  Voyage voyage{{0.3, 0.1}};
  voyage.sigma_m = 2.0;
  double largest_shift_m = 0.0;
  for (int i = 0; i < 600; ++i) {
    voyage.head_ref = i % 60 < 30 ? 15 : -15;
    const Vec shift = voyage.place() - voyage.odometry();
    voyage.sail(0.2);
    if (i > 5) {
      largest_shift_m =
          std::max(largest_shift_m, (voyage.place() - voyage.odometry() - shift).norm());
    }
  }
  CHECK(voyage.largest_jump_m < 0.05);
  CHECK(largest_shift_m > 0.1);  // the correction goes into world_from_odometry
}

TEST_CASE("C3: a receiver that repeats itself under way is not believed",
          "[high_level][estimate]") {
  Voyage voyage;
  voyage.sail(30.0);
  const WorldPoint stuck = voyage.boat.fix(0.0);
  FixVerdict verdict = FixVerdict::kBelieved;
  for (int i = 0; i < 500; ++i) {
    voyage.step();
    if (i % 10 == 0) {
      verdict = voyage.filter.fix(stuck, 0.5, voyage.boat.now);
    }
  }
  CHECK(verdict == FixVerdict::kFrozen);
  CHECK(voyage.filter.state().trust == PositionTrust::kFrozen);
  voyage.sail(3.0);
  CHECK(voyage.verdict == FixVerdict::kBelieved);

  Voyage moored;  // the same place again and again is right there
  moored.surge_ref = 0;
  for (int i = 0; i < 500; ++i) {
    moored.step();
    if (i % 10 == 0) {
      CHECK(moored.filter.fix({{1.0, 2.0}}, 0.5, moored.boat.now) != FixVerdict::kFrozen);
    }
  }
}

TEST_CASE("G6: an accuracy that is unknown is no accuracy of nought", "[high_level][estimate]") {
  Voyage voyage;
  voyage.step();
  CHECK(voyage.filter.fix({{0.0, 0.0}}, kNaN, voyage.boat.now) == FixVerdict::kSenseless);
  CHECK(voyage.filter.fix({{0.0, 0.0}}, 0.0, voyage.boat.now) == FixVerdict::kFirst);
  CHECK(voyage.filter.covariance()(0, 0) == Approx(25.0));
}

TEST_CASE("pose filter: what is no number, old or of the future is refused",
          "[high_level][estimate]") {
  Voyage voyage;
  voyage.sail(5.0);
  const Vec before = voyage.place();
  const Time now = voyage.boat.now;
  CHECK(voyage.filter.fix({{kNaN, 0.0}}, 0.5, now) == FixVerdict::kSenseless);
  CHECK(voyage.filter.fix({{0.0, INFINITY}}, 0.5, now) == FixVerdict::kSenseless);
  CHECK(voyage.filter.fix({before}, 0.5, now + milliseconds{1}) == FixVerdict::kUntimely);
  CHECK(voyage.filter.fix({before}, 0.5, now - seconds{4}) == FixVerdict::kUntimely);
  CHECK((voyage.place() - before).norm() == Approx(0.0).margin(1e-12));
  Attitude wild = voyage.boat.attitude();
  wild.measured = now + milliseconds{20};
  wild.heading_rad = kNaN;
  voyage.filter.advance(now + milliseconds{20}, 57, 0, wild);
  CHECK_FALSE(voyage.filter.knows_position());
  voyage.boat.now += milliseconds{20};
  voyage.sail(1.0);
  CHECK(voyage.filter.knows_position());
  CHECK(voyage.filter.mean().allFinite());
}

TEST_CASE("G4: a fix that is given twice counts once", "[high_level][estimate]") {
  Voyage voyage;
  voyage.sail(5.0);
  voyage.step();
  const WorldPoint once = voyage.boat.fix(0.5);
  CHECK(voyage.filter.fix(once, 0.5, voyage.boat.now) == FixVerdict::kBelieved);
  CHECK(voyage.filter.fix(once, 0.5, voyage.boat.now) == FixVerdict::kUntimely);
}

TEST_CASE("pose filter: it asks nothing of the heap once it is made", "[high_level][estimate]") {
  Voyage voyage;
  voyage.sail(5.0);
  const AllocationScope scope;
  voyage.sail(5.0);
  voyage.sail(6.0, {40.0, 0.0});
  CHECK(scope.count() == 0);
}

}  // namespace lodesman::testing
