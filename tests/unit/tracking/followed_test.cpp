// SPDX-License-Identifier: Apache-2.0
#include "low_level/tracking/followed.h"

#include <cmath>
#include <random>

#include "tests/support/catch.h"

namespace lodesman {
namespace {

constexpr double kStep_s = 0.1;
constexpr double kSigma_m = 0.1;

Sighting sighting(double x_m, double y_m) {
  Sighting seen;
  seen.middle = {x_m, y_m};
  seen.covariance = kSigma_m * kSigma_m * Eigen::Matrix2d::Identity();
  seen.shape.semi_axis_first_m = seen.shape.semi_axis_second_m = 0.5;
  return seen;
}

// Seen for so long, going so, in the noise of its sightings.
Followed watched(double seconds, Eigen::Vector2d velocity_m_s, std::uint32_t seed) {
  std::mt19937 random{seed};
  std::normal_distribution<double> noise{0.0, kSigma_m};
  Followed one = begin_following(sighting(noise(random), noise(random)), 1, 0.0);
  const auto pings = static_cast<int>(std::lround(seconds / kStep_s));
  for (int i = 1; i <= pings; ++i) {
    const Eigen::Vector2d at = i * kStep_s * velocity_m_s;
    predict(one, kStep_s);
    update(one, sighting(at.x() + noise(random), at.y() + noise(random)), i * kStep_s);
    decide_motion(one, true, i * kStep_s, kStep_s);
  }
  return one;
}

}  // namespace

TEST_CASE("followed: at first sight nothing is known of its motion", "[low_level][tracking]") {
  const Followed one = begin_following(sighting(3.0, 4.0), 7, 12.0);
  CHECK(one.id == 7);
  CHECK(one.motion == Motion::kUndecided);
  CHECK(one.place().x() == Approx(3.0));
  CHECK(one.velocity().norm() == Approx(0.0).margin(1e-12));
  CHECK(std::sqrt(one.covariance(2, 2)) >= 0.5);
  CHECK(one.existence > 0.5);
  CHECK(one.existence < 1.0);
}

TEST_CASE("followed: what moves is known to within two seconds, what rests within three",
          "[low_level][tracking]") {
  int moving = 0;
  int resting = 0;
  for (std::uint32_t seed = 1; seed <= 100; ++seed) {
    moving += watched(2.0, {0.4, -0.3}, seed).motion == Motion::kMoving ? 1 : 0;
    resting += watched(3.0, {0.0, 0.0}, seed).motion == Motion::kResting ? 1 : 0;
  }
  CHECK(moving >= 98);
  CHECK(resting >= 95);
}

TEST_CASE("followed: its doubt is what it is off by", "[low_level][tracking]") {
  double place = 0.0;
  double velocity = 0.0;
  constexpr int kRuns = 200;
  for (std::uint32_t seed = 1; seed <= kRuns; ++seed) {
    const Followed one = watched(4.0, {0.6, 0.2}, seed);
    const Eigen::Vector2d off = one.place() - Eigen::Vector2d{2.4, 0.8};
    const Eigen::Vector2d off_m_s = one.velocity() - Eigen::Vector2d{0.6, 0.2};
    place += off.squaredNorm() / (one.covariance(0, 0) + one.covariance(1, 1)) / kRuns;
    velocity += off_m_s.squaredNorm() / (one.covariance(2, 2) + one.covariance(3, 3)) / kRuns;
  }
  CHECK(place > 0.5);
  CHECK(place < 1.5);
  CHECK(velocity > 0.2);  // it allows for changes that do not come
  CHECK(velocity < 1.5);
}

TEST_CASE("followed: unseen it is given up where it should be seen, and kept where it is hidden",
          "[low_level][tracking]") {
  Followed open = watched(3.0, {0.5, 0.0}, 1);
  Followed hidden = open;
  const double sigma_m = std::sqrt(hidden.covariance(0, 0));
  for (int i = 0; i < 30; ++i) {
    predict(open, kStep_s);
    miss(open, 1.0);
    predict(hidden, kStep_s);
    miss(hidden, 0.0);
  }
  CHECK(open.existence < 0.05);
  CHECK(hidden.existence > 0.9);
  CHECK(std::sqrt(hidden.covariance(0, 0)) > 2.0 * sigma_m);
  CHECK(hidden.velocity().x() == Approx(0.5).margin(0.15));
}

TEST_CASE("followed: one that is missed now and then is not given up", "[low_level][tracking]") {
  std::mt19937 random{3};
  Followed one = begin_following(sighting(0.0, 0.0), 1, 0.0);
  for (int i = 1; i <= 200; ++i) {
    predict(one, kStep_s);
    if (random() % 3 != 0 || i < 5) {
      update(one, sighting(0.0, 0.0), i * kStep_s);
    } else {
      miss(one, 1.0);
    }
    CHECK(one.existence > 0.1);
  }
  CHECK(one.detection_probability == Approx(0.67).margin(0.2));
}

TEST_CASE("followed: it grows at once and shrinks slowly", "[low_level][tracking]") {
  Followed one = watched(1.0, {0.0, 0.0}, 1);
  Sighting large = sighting(0.0, 0.0);
  large.shape.semi_axis_first_m = 1.5;
  for (int i = 0; i < 3; ++i) {
    update(one, large, 1.0);
  }
  CHECK(one.shape.semi_axis_first_m > 1.3);
  for (int i = 0; i < 5; ++i) {
    update(one, sighting(0.0, 0.0), 1.0);
  }
  CHECK(one.shape.semi_axis_first_m > 1.1);
}

TEST_CASE("followed: one that stops rests, one that starts moves", "[low_level][tracking]") {
  Followed one = watched(3.0, {0.5, 0.0}, 4);
  REQUIRE(one.motion == Motion::kMoving);
  double t_s = 3.0;
  for (int i = 0; i < 60; ++i) {
    t_s += kStep_s;
    predict(one, kStep_s);
    update(one, sighting(1.5, 0.0), t_s);
    decide_motion(one, true, t_s, kStep_s);
  }
  CHECK(one.motion == Motion::kResting);
  for (int i = 0; i < 40; ++i) {
    t_s += kStep_s;
    predict(one, kStep_s);
    update(one, sighting(1.5, 0.05 * i), t_s);
    decide_motion(one, true, t_s, kStep_s);
  }
  CHECK(one.motion == Motion::kMoving);
  CHECK(one.velocity().y() == Approx(0.5).margin(0.1));
}

}  // namespace lodesman
