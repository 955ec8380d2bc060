// SPDX-License-Identifier: Apache-2.0
#include "low_level/tracking/followed.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "low_level/tracking/sightings.h"

namespace lodesman {
namespace {

// Of a velocity while nothing is known of it: boats and swimmers.
constexpr double kFirstSpeedSigma_m_s = 0.5;
// White noise of acceleration: what moves changes its velocity by 0.02 m/s in a second ...
constexpr double kAcceleration_m2_s3 = 0.0005;
// ... and by so much more while it is not where it was expected.
constexpr double kSurprised = 4.0;
constexpr double kManoeuvring = 100.0;
constexpr double kSurpriseShare = 0.2;  // of a new innovation in the smoothed one

constexpr double kFirstExistence = 0.6;
constexpr double kSurvival = 0.9995;  // from ping to ping
// A look says so much: one clutter echo lies where something is expected in so many.
constexpr double kClutterLikelihood = 0.1;
constexpr double kFirstDetection = 0.9;
constexpr double kLeastDetection = 0.3;
constexpr double kMostDetection = 0.98;
constexpr double kDetectionShare = 0.05;  // of the last ping in the smoothed probability

// Chi squared of two degrees of freedom: 1 in 100, and half of all.
constexpr double kSurelyMoves = 9.2;
constexpr double kHardlyMoves = 1.4;
constexpr double kSlowest_m_s = 0.07;    // slower than this it rests, as far as a boat is concerned
constexpr double kSureSigma_m_s = 0.12;  // of the velocity, from which on rest can be told
constexpr double kDecisionAge_s = 1.0;
constexpr double kChangeOfMind_s = 0.5;  // for so long the velocity speaks for the other
constexpr double kLeftItsPlace_m = 0.4;  // more than what is seen of a still thing wanders by
constexpr double kBeyond_m = 0.4;        // the water at its bow and stern: more than a cell beyond
constexpr double kShapeGrowth = 0.5;     // of what is seen to be larger, at once
constexpr double kShapeShrinkage = 0.03;

void learn_detection(Followed& one, double was_seen, double visible_share) noexcept {
  one.detection_probability +=
      kDetectionShare * visible_share * (was_seen - one.detection_probability);
  one.detection_probability =
      std::clamp(one.detection_probability, kLeastDetection, kMostDetection);
}

[[nodiscard]] Eigen::Matrix2d spread_of(const Followed& one, const Sighting& seen) noexcept {
  return one.covariance.topLeftCorner<2, 2>() + seen.covariance;
}

// Takes it for as large as is seen, where the end that is seen stays where it is.
void grow_beyond_cut(Followed& one, const Sighting& seen) noexcept {
  const double half_m = seen.shape.semi_axis_second_m;
  const double more_m = half_m - one.shape.semi_axis_second_m;
  if (!seen.is_cut() || more_m <= 0.0) {
    return;
  }
  const double deeper_m = std::max(0.0, half_depth_m(half_m) - one.shape.semi_axis_first_m);
  const Eigen::Vector2d shift = to_the_rest_m(seen, more_m, deeper_m);
  one.state.head<2>() += shift;
  one.anchor += shift;
  one.shape.semi_axis_second_m = half_m;
  one.shape.semi_axis_first_m += deeper_m;
}

}  // namespace

Followed begin_following(const Sighting& seen, std::uint32_t id, double now_s) noexcept {
  Followed one;
  one.id = id;
  one.state << seen.middle, Eigen::Vector2d::Zero();
  one.covariance.setZero();
  one.covariance.topLeftCorner<2, 2>() = seen.covariance;
  one.covariance.bottomRightCorner<2, 2>() =
      kFirstSpeedSigma_m_s * kFirstSpeedSigma_m_s * Eigen::Matrix2d::Identity();
  one.shape = seen.shape;
  one.last_sight = seen.middle;
  one.existence = kFirstExistence;
  one.first_seen_s = one.last_seen_s = now_s;
  one.surprise = 2.0;
  one.detection_probability = kFirstDetection;
  return one;
}

Followed go_on_following(const Track& track, double now_s) noexcept {
  Sighting seen;
  seen.shape = track.shape;
  seen.middle = {track.shape.centre_x_m, track.shape.centre_y_m};
  seen.covariance << track.place_xx_m2, track.place_xy_m2, track.place_xy_m2, track.place_yy_m2;
  Followed one = begin_following(seen, track.id, now_s);
  one.state.tail<2>() << track.velocity_x_m_s, track.velocity_y_m_s;
  one.covariance.bottomRightCorner<2, 2>() << track.velocity_xx_m2_s2, track.velocity_xy_m2_s2,
      track.velocity_xy_m2_s2, track.velocity_yy_m2_s2;
  return one;
}

void come_to_rest(Followed& one) noexcept {
  one.motion = Motion::kResting;
  one.anchor = one.place();
  one.unlike_s = 0.0;
}

void predict(Followed& one, double dt_s) noexcept {
  const double noise = kAcceleration_m2_s3 * (one.surprise > kSurprised ? kManoeuvring : 1.0);
  Eigen::Matrix4d motion = Eigen::Matrix4d::Identity();
  motion.topRightCorner<2, 2>() = dt_s * Eigen::Matrix2d::Identity();
  one.state = motion * one.state;
  one.covariance = motion * one.covariance * motion.transpose();
  const auto add = [&](int row, int column, double value) {
    for (int i = 0; i < 2; ++i) {
      one.covariance(row + i, column + i) += value;
    }
  };
  add(0, 0, noise * dt_s * dt_s * dt_s / 3.0);
  add(0, 2, noise * dt_s * dt_s / 2.0);
  add(2, 0, noise * dt_s * dt_s / 2.0);
  add(2, 2, noise * dt_s);
  one.existence *= kSurvival;
}

double squared_distance(const Followed& one, const Sighting& seen) noexcept {
  const Sighting whole = completed(seen, one.shape.semi_axis_second_m);
  const Eigen::Vector2d off = whole.middle - one.place();
  return off.dot(spread_of(one, whole).inverse() * off);
}

double log_spread(const Followed& one, const Sighting& seen) noexcept {
  const Sighting whole = completed(seen, one.shape.semi_axis_second_m);
  return std::log(spread_of(one, whole).determinant());
}

void update(Followed& one, const Sighting& part, double now_s) noexcept {
  grow_beyond_cut(one, part);
  const Sighting seen = completed(part, one.shape.semi_axis_second_m);
  const Eigen::Vector2d off = seen.middle - one.place();
  const Eigen::Matrix2d spread = spread_of(one, seen);
  const Eigen::Matrix2d weight = spread.inverse();
  const Eigen::Matrix<double, 4, 2> gain = one.covariance.leftCols<2>() * weight;
  one.state += gain * off;
  one.covariance -= gain * spread * gain.transpose();
  one.covariance = 0.5 * (one.covariance + one.covariance.transpose()).eval();
  one.surprise += kSurpriseShare * (off.dot(weight * off) - one.surprise);
  one.last_seen_s = now_s;
  one.last_sight = seen.middle;
  const double seen_if_there = one.detection_probability;
  one.existence = one.existence * seen_if_there /
                  (one.existence * seen_if_there + (1.0 - one.existence) * kClutterLikelihood);
  learn_detection(one, 1.0, 1.0);
  const auto grow = [](double& have, double measured) {
    have += (measured > have ? kShapeGrowth : kShapeShrinkage) * (measured - have);
  };
  grow(one.shape.semi_axis_first_m, seen.shape.semi_axis_first_m);
  grow(one.shape.semi_axis_second_m, seen.shape.semi_axis_second_m);
  one.shape.angle_rad = seen.shape.angle_rad;
  one.shape.peak = seen.shape.peak;
}

void miss(Followed& one, double visible_share) noexcept {
  const double seen_if_there = visible_share * one.detection_probability;
  one.existence *= (1.0 - seen_if_there) / (1.0 - one.existence * seen_if_there);
  learn_detection(one, 0.0, visible_share);
}

// | from      | to      | when the velocity ...                                                  |
// | undecided | moving  | is more than its doubt explains, for a while                           |
// | undecided | resting | is nothing that its doubt, which is small, cannot be                   |
// | resting   | moving  | is as for undecided, it has left its place, and there is water before  |
// |           |         | or behind it: what is seen of a wall wanders too, with wall both ways  |
// | moving    | resting | is as for undecided, for a while                                       |
void decide_motion(Followed& one, bool in_open_water, double now_s, double dt_s) noexcept {
  const Eigen::Vector2d velocity = one.velocity();
  const Eigen::Matrix2d doubt = one.covariance.bottomRightCorner<2, 2>();
  const double speed_m_s = velocity.norm();
  const double significance = velocity.dot(doubt.inverse() * velocity);
  const double sigma_m_s = std::sqrt(0.5 * doubt.trace());
  if (one.motion == Motion::kResting && !in_open_water) {
    one.anchor = one.place();  // a part of something longer is where it is seen
  }
  const bool may_move = one.motion != Motion::kResting ||
                        (in_open_water && (one.place() - one.anchor).norm() > kLeftItsPlace_m);
  const bool moves = significance > kSurelyMoves && speed_m_s > kSlowest_m_s && may_move;
  const bool rests =
      sigma_m_s < kSureSigma_m_s && (significance < kHardlyMoves || speed_m_s < kSlowest_m_s);
  const bool speaks_for_other = one.motion == Motion::kMoving ? rests : moves;
  one.unlike_s = speaks_for_other ? one.unlike_s + dt_s : 0.0;
  const bool old_enough = now_s - one.first_seen_s >= kDecisionAge_s;
  if (one.unlike_s >= kChangeOfMind_s && one.motion != Motion::kMoving) {
    one.motion = Motion::kMoving;
    one.unlike_s = 0.0;
  } else if (one.unlike_s >= kChangeOfMind_s ||
             (one.motion == Motion::kUndecided && rests && old_enough)) {
    come_to_rest(one);
  }
}

Eigen::Vector2d to_its_bow(const Followed& one) noexcept {
  const double speed_m_s = one.velocity().norm();
  const double size_m = std::max(one.shape.semi_axis_first_m, one.shape.semi_axis_second_m);
  return speed_m_s > 0.0 ? Eigen::Vector2d{(size_m + kBeyond_m) / speed_m_s * one.velocity()}
                         : Eigen::Vector2d::Zero();
}

}  // namespace lodesman
