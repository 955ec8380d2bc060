// SPDX-License-Identifier: Apache-2.0
#include "high_level/tasks/estimator.h"

#include <cmath>

#include "tests/support/catch.h"
#include "tests/unit/estimate/support.h"
#include "tests/unit/tasks/support.h"

namespace lodesman::testing {
namespace {

[[nodiscard]] EstimatorOptions options_for(PositionSource source) {
  EstimatorOptions options;
  options.source = source;
  options.dead_reckoning = {milliseconds{200}, SpeedTable::proportional(0.01375)};
  options.filter = filter_options();
  options.current_time = seconds{30};
  options.origin = GeoPoint{35.0, 139.0};
  return options;
}

struct Estimator {
  explicit Estimator(PositionSource source) : Estimator{options_for(source)} {}
  explicit Estimator(const EstimatorOptions& options) : task{*board, Role::kHigh, options} {}

  void head(double rad, Time at) { attitude.publish({at, rad, 0.0}, at); }
  void fix(double latitude_deg, Time at) { position.publish({at, latitude_deg, 139.0, 1.0}, at); }
  void drive(int surge_ref, Time at) {
    ThrustApplied applied;
    applied.reason = ThrustReason::kCommanded;
    applied.surge_ref = surge_ref;
    thrust.publish(applied, at);
  }
  // The estimate that a step at that time published, if it did.
  [[nodiscard]] std::optional<VehicleState> after_step(Time now) {
    task.step(now);
    const auto published = all_of(states);
    return published.empty() ? std::nullopt : std::optional{published.back()};
  }

  std::unique_ptr<Blackboard> board = std::make_unique<Blackboard>();
  EstimatorTask task;
  Writer<Attitude> attitude{board->attitude, Role::kLow, "attitude"};
  Writer<PositionFix> position{board->position_fix, Role::kLow, "position_fix"};
  Writer<ThrustApplied> thrust{board->thrust_applied, Role::kLow, "thrust_applied"};
  Reader<VehicleState> states{board->vehicle_state};
  Reader<WorldOrigin> origins{board->world_origin};
};

[[nodiscard]] EstimatorOptions options_at_start() {
  EstimatorOptions options = options_for(PositionSource::kGps);
  options.origin.reset();
  options.origin_search = {10.0, 5.0};
  return options;
}

// Its origin found where the receiver has the boat, a second a fix.
void find_origin(Estimator& estimator, double latitude_deg, Time from) {
  for (int i = 0; i < OriginSearch::kAgreeing; ++i) {
    const Time now = from + i * seconds{1};
    estimator.head(0.0, now);
    estimator.fix(latitude_deg, now);
    static_cast<void>(estimator.after_step(now));
  }
}

TEST_CASE("estimator task: without a fresh heading it publishes nothing", "[high_level][tasks]") {
  Estimator estimator{PositionSource::kDeadReckoning};
  CHECK_FALSE(estimator.after_step(kStart));
  estimator.head(0.5, kStart);
  REQUIRE(estimator.after_step(kStart));
  CHECK(estimator.after_step(kStart + max_age::kAttitude));
  CHECK_FALSE(estimator.after_step(kStart + max_age::kAttitude + Duration{1}));
  estimator.head(0.5, kStart + seconds{3600});  // of the future
  CHECK_FALSE(estimator.after_step(kStart + seconds{1}));
}

TEST_CASE("estimator task: a fix is moved from the antenna to the vehicle by the heading",
          "[high_level][tasks]") {
  EstimatorOptions options = options_for(PositionSource::kGps);
  options.antenna = {{0.5, -2.0}};  // to starboard, and astern
  struct Row {
    double heading_rad, x_m, y_m;
  };
  for (const Row& row : {Row{0.0, -0.5, 2.0}, Row{1.5707963267948966, 2.0, 0.5},
                         Row{-1.5707963267948966, -2.0, -0.5}}) {
    Estimator estimator{options};
    estimator.head(row.heading_rad, kStart);
    estimator.fix(35.0, kStart);
    const auto state = estimator.after_step(kStart);
    REQUIRE(state);
    CHECK(state->x_m == Approx(row.x_m).margin(1e-6));
    CHECK(state->y_m == Approx(row.y_m).margin(1e-6));
  }
}

TEST_CASE("estimator task: without a fresh position it publishes nothing", "[high_level][tasks]") {
  for (const auto source : {PositionSource::kGps, PositionSource::kTruth}) {
    Estimator estimator{source};
    estimator.head(0.5, kStart);
    CHECK_FALSE(estimator.after_step(kStart));
  }
}

TEST_CASE("G5: a gap between fixes is bridged as long as is set, and no longer",
          "[high_level][tasks]") {
  Estimator estimator{PositionSource::kGps};
  const Duration bridged = filter_options().gate.longest_gap;
  double doubt_m2 = 0.0;
  estimator.fix(35.0, kStart);
  for (Time now = kStart; now <= kStart + bridged; now += milliseconds{50}) {
    estimator.head(0.5, now);
    const auto state = estimator.after_step(now);
    REQUIRE(state);
    CHECK(state->fix_measured == kStart);
    doubt_m2 = state->position_xx_m2;
  }
  CHECK(doubt_m2 > 1.5);  // the fix's alone is 1
  const Time late = kStart + bridged + milliseconds{50};
  estimator.head(0.5, late);
  CHECK_FALSE(estimator.after_step(late));
}

TEST_CASE("estimator task: with fixes too it reckons with thrust that was applied alone",
          "[high_level][tasks]") {
  Estimator estimator{PositionSource::kGps};
  const auto gone_m = [&](Time from, bool thrust_is_applied) {
    double begin_m = 0.0;
    double y_m = 0.0;
    for (Time now = from; now < from + seconds{10}; now += milliseconds{50}) {
      estimator.head(0.0, now);
      if (now == from) {
        estimator.fix(35.0, now);
      }
      if (thrust_is_applied) {
        estimator.drive(57, now);
      }
      const auto state = estimator.after_step(now);
      REQUIRE(state);
      begin_m = now == from ? state->y_m : begin_m;
      y_m = state->y_m;
      CHECK(std::abs(state->world_from_odometry_y_m()) < 1.0);
    }
    return y_m - begin_m;
  };
  CHECK(std::abs(gone_m(kStart, false)) < 0.1);
  CHECK(gone_m(kStart + seconds{10}, true) > 4.0);
}

TEST_CASE("estimator task: it reckons with thrust that is applied and not with what is stale",
          "[high_level][tasks]") {
  Estimator estimator{PositionSource::kDeadReckoning};
  const auto sail = [&](Time from, bool thrust_goes_on) {
    double y_m = 0.0;
    for (Time now = from; now < from + seconds{10}; now += milliseconds{50}) {
      estimator.head(0.0, now);
      if (thrust_goes_on) {
        estimator.drive(16, now);
      }
      const auto state = estimator.after_step(now);
      REQUIRE(state);
      y_m = state->y_m;
    }
    return y_m;
  };
  const double sailed_m = sail(kStart, true);
  CHECK(sailed_m == Approx(2.2).margin(0.1));
  const double coast_m = sail(kStart + seconds{10}, false) - sailed_m;
  CHECK(coast_m <= 0.22 * (to_seconds(max_age::kThrustApplied) + 0.3));
}

TEST_CASE("estimator task: samples that are no numbers leave the estimate finite",
          "[high_level][tasks]") {
  Estimator estimator{PositionSource::kGps};
  for (int i = 0; i < 100; ++i) {
    const Time now = kStart + i * milliseconds{50};
    estimator.head(i == 20 ? kNaN : 0.5, now);
    estimator.fix(i == 40 ? kNaN : i == 60 ? 1e300 : 35.0, now);
    estimator.drive(16, now);
    if (const auto state = estimator.after_step(now)) {
      CHECK(std::isfinite(state->x_m + state->y_m + state->heading_rad + state->surge_m_s));
      CHECK(std::isfinite(state->current_x_m_s + state->current_y_m_s));
      CHECK(std::hypot(state->x_m, state->y_m) < 10.0);
    }
  }
  estimator.head(0.5, kStart + seconds{5});
  CHECK(estimator.after_step(kStart + seconds{5}));
}

TEST_CASE("estimator task: an origin that is set is told once", "[high_level][tasks]") {
  Estimator estimator{PositionSource::kGps};
  for (int i = 0; i < 3; ++i) {
    static_cast<void>(estimator.after_step(kStart + i * milliseconds{50}));
  }
  const auto told = all_of(estimator.origins);
  REQUIRE(told.size() == 1);
  CHECK(told[0].latitude_deg == Approx(35.0));
  CHECK(told[0].source == OriginSource::kConfiguration);
}

TEST_CASE("estimator task: at_start, the first good fixes have the boat at the origin, for good",
          "[high_level][tasks]") {
  EstimatorOptions options = options_at_start();
  options.antenna = {{0.0, -2.0}};  // astern
  Estimator estimator{options};
  estimator.head(0.0, kStart);
  estimator.fix(48.0, kStart);
  CHECK_FALSE(estimator.after_step(kStart));
  CHECK(all_of(estimator.origins).empty());
  find_origin(estimator, 48.0, kStart + seconds{1});
  const auto told = all_of(estimator.origins);
  REQUIRE(told.size() == 1);
  // The boat lies 2 m north of its antenna.
  CHECK((told[0].latitude_deg - 48.0) * 111200.0 == Approx(2.0).margin(0.01));
  CHECK(told[0].source == OriginSource::kFirstFix);
  CHECK(told[0].sigma_m == Approx(1.0));
  CHECK(told[0].fixed == kStart + seconds{2});
  // It is the origin from that fix on, and no later one moves it.
  double y_m = 100.0;
  for (int i = 0; i < 40; ++i) {
    const Time now = kStart + seconds{4} + i * milliseconds{500};
    estimator.head(0.0, now);
    estimator.fix(48.0 + 5e-5, now);  // 5.6 m north
    if (const auto state = estimator.after_step(now)) {
      y_m = state->y_m;
    }
  }
  CHECK(y_m == Approx(5.56).margin(0.5));
  CHECK(all_of(estimator.origins).empty());
}

TEST_CASE("estimator task: started anew it keeps the origin that the first fixes gave",
          "[high_level][tasks]") {
  const auto board = std::make_unique<Blackboard>();
  WorldOrigin before{48.0, 7.0, OriginSource::kFirstFix, 1.0, kStart};
  Writer<WorldOrigin>{board->world_origin, Role::kHigh, "world_origin"}.publish(before, kStart);
  Writer<Attitude> attitude{board->attitude, Role::kLow, "attitude"};
  Writer<PositionFix> position{board->position_fix, Role::kLow, "position_fix"};
  Reader<VehicleState> states{board->vehicle_state};
  Reader<WorldOrigin> origins{board->world_origin};
  const auto estimate_by = [&](const EstimatorOptions& options) {
    EstimatorTask task{*board, Role::kHigh, options};
    attitude.publish({kStart, 0.0, 0.0}, kStart);
    position.publish({kStart, 48.001, 7.0, 1.0}, kStart);
    task.step(kStart);
    return all_of(states);
  };
  const auto kept = estimate_by(options_at_start());
  REQUIRE(kept.size() == 1);
  CHECK(kept[0].y_m == Approx(111.2).margin(0.1));
  CHECK(all_of(origins).size() == 1);
  // Where it is set, that counts.
  static_cast<void>(estimate_by(options_for(PositionSource::kGps)));
  const auto told = all_of(origins);
  REQUIRE(told.size() == 1);
  CHECK(told[0].latitude_deg == Approx(35.0));
}

TEST_CASE("estimator task: an origin that a configuration gave before is none of the first fixes",
          "[high_level][tasks]") {
  Estimator estimator{options_at_start()};
  Blackboard& board = *estimator.board;
  const auto other = std::make_unique<Blackboard>();
  Writer<WorldOrigin>{other->world_origin, Role::kHigh, "world_origin"}.publish({60.0, 7.0},
                                                                                kStart);
  EstimatorTask task{*other, Role::kHigh, options_at_start()};
  Writer<Attitude>{other->attitude, Role::kLow, "attitude"}.publish({kStart, 0.0, 0.0}, kStart);
  Writer<PositionFix>{other->position_fix, Role::kLow, "position_fix"}.publish(
      {kStart, 48.0, 7.0, 1.0}, kStart);
  task.step(kStart);
  Reader<VehicleState> states{other->vehicle_state};
  CHECK(states.latest() == nullptr);
  CHECK(Reader<WorldOrigin>{board.world_origin}.latest() == nullptr);
}

}  // namespace
}  // namespace lodesman::testing
