// SPDX-License-Identifier: Apache-2.0
// One compact obstacle followed from ping to ping: where it is and how it moves, by a Kalman filter
// of nearly constant velocity, how large it is, whether it is there at all, and whether it moves or
// rests. Plain data and pure functions in the odometry frame; any thread; nothing allocates.
#pragma once

#include <array>
#include <cstdint>

#include <Eigen/Core>

#include "low_level/tracking/fan_view.h"
#include "mid_level/messages/obstacle.h"
#include "mid_level/messages/tracks.h"

namespace lodesman {

enum class Motion : std::uint8_t {
  kUndecided,  // too new to say
  kResting,
  kMoving,
};

// An obstacle of one ping as the filter takes it: an ellipse whose middle is measured.
struct Sighting {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();      // [m] [odometry]
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  // [m^2]
  // [odometry] an ellipse, its first axis along the line of sight, its second across it.
  Obstacle shape;
  CutEnds cut;

  [[nodiscard]] bool is_cut() const noexcept { return cut.port || cut.starboard; }
};

struct Followed {
  std::uint32_t id = 0;  // [-] > 0
  Motion motion = Motion::kUndecided;
  Eigen::Vector4d state = Eigen::Vector4d::Zero();  // [m, m, m/s, m/s] place and velocity
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Identity();
  Eigen::Vector2d anchor = Eigen::Vector2d::Zero();      // [m] where it rests in open water
  Eigen::Vector2d last_sight = Eigen::Vector2d::Zero();  // [m] where it was seen last
  Obstacle shape;             // an ellipse; its centre is not kept, the state is
  double existence = 0.0;     // [-] [0, 1] probability
  double first_seen_s = 0.0;  // [s]
  double last_seen_s = 0.0;   // [s]
  double still_share = 0.0;   // [-] of what was seen of it last, where something rests
  double unlike_s = 0.0;      // [s] for which its velocity has spoken for the other motion
  double surprise = 0.0;      // [-] smoothed normalised innovation squared: 2 where the model holds
  double detection_probability = 0.0;  // [-] share of the pings that could show it and did, lately

  [[nodiscard]] Eigen::Vector2d place() const noexcept { return state.head<2>(); }
  [[nodiscard]] Eigen::Vector2d velocity() const noexcept { return state.tail<2>(); }
};

// First seen so: nothing is known of how it moves.
[[nodiscard]] Followed begin_following(const Sighting& seen, std::uint32_t id,
                                       double now_s) noexcept;
// As one that was here before knew it last.
[[nodiscard]] Followed go_on_following(const Track& track, double now_s) noexcept;
void predict(Followed& one, double dt_s) noexcept;
// Squared Mahalanobis distance of what was seen from what was expected.
[[nodiscard]] double squared_distance(const Followed& one, const Sighting& seen) noexcept;
// [-] log of the determinant of what that distance is measured by: between two that expected it,
// the surer one is likelier.
[[nodiscard]] double log_spread(const Followed& one, const Sighting& seen) noexcept;
// What comes into view that was cut before was there: that it is larger is no motion.
void update(Followed& one, const Sighting& part, double now_s) noexcept;
// It was looked for, and the share of it that could be seen was not.
void miss(Followed& one, double visible_share) noexcept;
// [m] From its middle to the water at its bow, if it moves; that at its stern is as far behind.
[[nodiscard]] Eigen::Vector2d to_its_bow(const Followed& one) noexcept;
// Moves it on along the transitions of Motion, after an update or a miss `dt_s` after the last.
// `in_open_water`: the water at its bow or stern is known to be free.
void decide_motion(Followed& one, bool in_open_water, double now_s, double dt_s) noexcept;
void come_to_rest(Followed& one) noexcept;

}  // namespace lodesman
