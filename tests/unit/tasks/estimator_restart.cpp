// SPDX-License-Identifier: Apache-2.0
// An estimator that was away for a while, frozen or dead, and the one that comes after it: against
// one that was there all the time.
#include <cmath>

#include "high_level/tasks/estimator.h"
#include "tests/support/catch.h"
#include "tests/unit/estimate/support.h"
#include "tests/unit/tasks/support.h"

namespace lodesman::testing {
namespace {

constexpr Duration kTick = milliseconds{20};

[[nodiscard]] EstimatorOptions sea_options(PositionSource source) {
  EstimatorOptions options;
  options.source = source;
  options.dead_reckoning = {milliseconds{200}, SpeedTable::proportional(0.01375)};
  options.filter = filter_options();
  options.origin = GeoPoint{35.0, 139.0};
  return options;
}

// A boat that sails in a current, what its low level tells, and an estimator that may come and go.
class Sea {
 public:
  explicit Sea(PositionSource source) : options_{sea_options(source)} {
    boat_.current_m_s = {0.2, -0.1};
    begin();
  }
  void begin() { task_.emplace(*board_, Role::kHigh, options_); }
  void kill() { task_.reset(); }

  // The low level may be gone too, and then the propellers stand still.
  void sail(Duration time, bool steps = true, bool low_is_there = true) {
    for (const Time end = boat_.now + time; boat_.now < end;) {
      const int surge_ref = low_is_there && steps ? 57 : 0;
      boat_.step(surge_ref, surge_ref / 4);
      ++tick_;
      if (low_is_there) {
        tell(surge_ref);
      }
      if (steps && task_) {
        task_->step(boat_.now);
      }
    }
  }
  [[nodiscard]] const VehicleState& state() {
    const auto* newest = states_.latest();
    REQUIRE(newest != nullptr);
    return newest->value;
  }
  [[nodiscard]] Time now() const { return boat_.now; }
  [[nodiscard]] double error_m() {
    return (Eigen::Vector2d{state().x_m, state().y_m} - boat_.motion.position.xy_m).norm();
  }
  // Of the odometry frame against the world's: it is to stay where it was.
  [[nodiscard]] Eigen::Vector2d odometry_off_m() {
    return Eigen::Vector2d{state().odometry_x_m, state().odometry_y_m} - boat_.motion.position.xy_m;
  }
  [[nodiscard]] const Eigen::Vector2d& current_m_s() const { return boat_.current_m_s; }

 private:
  void tell(int surge_ref) {
    attitude_.publish(boat_.attitude(), boat_.now);
    if (tick_ % 3 == 0) {
      ThrustApplied applied;
      applied.reason = ThrustReason::kCommanded;
      applied.surge_ref = surge_ref;
      applied.head_ref = surge_ref / 4;
      thrust_.publish(applied, boat_.now);
    }
    WorldTruth truth;
    truth.x_m = boat_.motion.position.xy_m.x();
    truth.y_m = boat_.motion.position.xy_m.y();
    truth_.publish(truth, boat_.now);
    if (tick_ % 50 == 0) {
      const GeoPoint at = frame_.to_geo(boat_.fix(0.5));
      fixes_.publish({boat_.now, at.latitude_deg, at.longitude_deg, 0.5}, boat_.now);
    }
  }

  EstimatorOptions options_;
  LocalFrame frame_{*options_.origin};
  SailedBoat boat_{filter_options(), 7, 0.0};
  int tick_ = 0;
  std::unique_ptr<Blackboard> board_ = std::make_unique<Blackboard>();
  std::optional<EstimatorTask> task_;
  Writer<Attitude> attitude_{board_->attitude, Role::kLow, "attitude"};
  Writer<PositionFix> fixes_{board_->position_fix, Role::kLow, "position_fix"};
  Writer<WorldTruth> truth_{board_->world_truth, Role::kLow, "world_truth"};
  Writer<ThrustApplied> thrust_{board_->thrust_applied, Role::kLow, "thrust_applied"};
  Reader<VehicleState> states_{board_->vehicle_state};
};

TEST_CASE("estimator restart: the next one goes on without a jump, with the current it had learnt",
          "[high_level][tasks]") {
  Sea sea{PositionSource::kGps};
  sea.sail(seconds{60});
  REQUIRE(sea.error_m() < 0.3);
  const Eigen::Vector2d off_m = sea.odometry_off_m();
  const double doubt_m2 = sea.state().position_xx_m2;
  sea.kill();
  sea.sail(milliseconds{1500}, false);
  sea.begin();
  sea.sail(2 * kTick);
  CHECK(sea.state().valid_at == sea.now());
  CHECK(sea.error_m() < 0.35);
  CHECK((sea.odometry_off_m() - off_m).norm() < 0.05);
  CHECK(sea.state().current_x_m_s == Approx(sea.current_m_s().x()).margin(0.05));
  CHECK(sea.state().current_y_m_s == Approx(sea.current_m_s().y()).margin(0.05));
  CHECK(sea.state().position_xx_m2 > doubt_m2);
  CHECK(sea.state().position_xx_m2 < 1.0);
}

TEST_CASE("estimator restart: one that was frozen makes up for it by what was applied",
          "[high_level][tasks]") {
  Sea sea{PositionSource::kGps};
  sea.sail(seconds{60});
  const Eigen::Vector2d off_m = sea.odometry_off_m();
  sea.sail(seconds{4}, false);
  sea.sail(2 * kTick);
  CHECK(sea.error_m() < 0.4);
  CHECK((sea.odometry_off_m() - off_m).norm() < 0.1);
}

TEST_CASE("estimator restart: while the low level is gone it coasts, says nothing, and goes on",
          "[high_level][tasks]") {
  Sea sea{PositionSource::kGps};
  sea.sail(seconds{60});
  const Eigen::Vector2d off_m = sea.odometry_off_m();
  sea.sail(seconds{4}, true, false);
  CHECK(sea.now() - sea.state().valid_at > seconds{3});
  sea.sail(2 * kTick);
  CHECK(sea.state().valid_at == sea.now());
  // The propellers stand still at once here, and the filter reckons with half a second more.
  CHECK(sea.error_m() < 0.7);
  CHECK((sea.odometry_off_m() - off_m).norm() < 0.7);
  CHECK(sea.state().current_x_m_s == Approx(sea.current_m_s().x()).margin(0.06));
}

TEST_CASE("estimator restart: what is too old is not gone on with", "[high_level][tasks]") {
  Sea sea{PositionSource::kGps};
  sea.sail(seconds{60});
  REQUIRE(sea.state().current_x_m_s > 0.15);
  sea.kill();
  sea.sail(EstimatorTask::kLongestGap + seconds{1}, false);
  sea.begin();
  sea.sail(seconds{1});  // one fix
  CHECK(sea.error_m() < 2.0);
  CHECK(std::abs(sea.state().current_x_m_s) < 0.12);  // it is to be learnt again
}

TEST_CASE("estimator restart: dead reckoning goes on from where it was", "[high_level][tasks]") {
  Sea sea{PositionSource::kDeadReckoning};
  sea.sail(seconds{20});
  const VehicleState before = sea.state();
  sea.kill();
  sea.sail(seconds{1}, false);
  sea.begin();
  sea.sail(kTick);
  const double moved_m = std::hypot(sea.state().x_m - before.x_m, sea.state().y_m - before.y_m);
  CHECK(std::hypot(before.x_m, before.y_m) > 1.0);
  CHECK(moved_m < 0.5);
  CHECK(sea.state().surge_m_s > 0.3 * before.surge_m_s);
}

TEST_CASE("estimator restart: where the truth is told, it stays where it truly is",
          "[high_level][tasks]") {
  Sea sea{PositionSource::kTruth};
  sea.sail(seconds{20});
  REQUIRE(sea.error_m() < 1e-9);
  sea.sail(seconds{4}, false);  // frozen
  sea.sail(seconds{5});
  CHECK(sea.error_m() < 1e-9);
  sea.kill();
  sea.sail(seconds{2}, false);
  sea.begin();
  sea.sail(seconds{5});
  CHECK(sea.error_m() < 1e-9);
}

TEST_CASE("estimator restart: a memory that is no covariance is no memory", "[high_level][tasks]") {
  PoseFilter filter{filter_options()};
  EstimatorMemory memory;
  memory.has_filter = true;
  memory.at = kStart;
  memory.fix_believed = kStart;
  CHECK_FALSE(filter.resume(memory));  // all zero
  for (std::size_t i = 0; i < EstimatorMemory::kStates; ++i) {
    memory.covariance.at(i * (EstimatorMemory::kStates + 1)) = 1.0;
  }
  memory.covariance[1] = memory.covariance[EstimatorMemory::kStates] = 2.0;
  CHECK_FALSE(filter.resume(memory));  // x and y correlated by more than all
  CHECK_FALSE(filter.has_begun());
  memory.covariance[1] = memory.covariance[EstimatorMemory::kStates] = 0.5;
  CHECK(filter.resume(memory));
  memory.fix_believed = Time{};
  CHECK_FALSE(PoseFilter{filter_options()}.resume(memory));
}

}  // namespace
}  // namespace lodesman::testing
