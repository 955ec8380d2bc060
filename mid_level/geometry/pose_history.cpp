// SPDX-License-Identifier: Apache-2.0
#include "mid_level/geometry/pose_history.h"

#include <algorithm>
#include <chrono>

namespace lodesman {
namespace {

[[nodiscard]] VehiclePose between(const WorldPoint& a, const WorldPoint& b, Heading from,
                                  double turn_rad, double share) noexcept {
  return {{{a.xy_m.x() + share * (b.xy_m.x() - a.xy_m.x()),
            a.xy_m.y() + share * (b.xy_m.y() - a.xy_m.y())}},
          Heading::clockwise_from_y_rad(from.rad() + share * turn_rad)};
}
[[nodiscard]] WorldPoint in_world(const VehicleState& s) noexcept { return {{s.x_m, s.y_m}}; }
[[nodiscard]] WorldPoint in_odometry(const VehicleState& s) noexcept {
  return {{s.odometry_x_m, s.odometry_y_m}};
}

}  // namespace

void PoseHistory::add(const VehicleState& state) noexcept {
  if (count_ > 0 && state.valid_at <= ring_[(count_ - 1) % kSize].valid_at) {
    return;
  }
  ring_[count_ % kSize] = state;
  ++count_;
}

std::optional<PoseHistory::Poses> PoseHistory::poses_at(Time at) const noexcept {
  constexpr Duration kAheadOfNewest = std::chrono::milliseconds{100};
  if (count_ == 0) {
    return std::nullopt;
  }
  const VehicleState& newest = ring_[(count_ - 1) % kSize];
  if (at >= newest.valid_at) {
    const Heading heading = Heading::clockwise_from_y_rad(newest.heading_rad);
    return at - newest.valid_at <= kAheadOfNewest
               ? std::optional{Poses{{in_world(newest), heading}, {in_odometry(newest), heading}}}
               : std::nullopt;
  }
  const std::size_t remembered = std::min(count_, kSize);
  for (std::size_t back = 1; back < remembered; ++back) {
    const VehicleState& later = ring_[(count_ - back) % kSize];
    const VehicleState& earlier = ring_[(count_ - back - 1) % kSize];
    if (at >= earlier.valid_at) {
      const double share =
          to_seconds(at - earlier.valid_at) / to_seconds(later.valid_at - earlier.valid_at);
      const Heading from = Heading::clockwise_from_y_rad(earlier.heading_rad);
      const double turn_rad = from.turn_to_rad(Heading::clockwise_from_y_rad(later.heading_rad));
      return Poses{between(in_world(earlier), in_world(later), from, turn_rad, share),
                   between(in_odometry(earlier), in_odometry(later), from, turn_rad, share)};
    }
  }
  return std::nullopt;
}

std::optional<VehiclePose> PoseHistory::at(Time at) const noexcept {
  const auto poses = poses_at(at);
  return poses ? std::optional{poses->world} : std::nullopt;
}

std::optional<VehiclePose> PoseHistory::odometry_at(Time at) const noexcept {
  const auto poses = poses_at(at);
  return poses ? std::optional{poses->odometry} : std::nullopt;
}

Eigen::Vector2d PoseHistory::world_from_odometry_m() const noexcept {
  if (count_ == 0) {
    return Eigen::Vector2d::Zero();
  }
  const VehicleState& newest = ring_[(count_ - 1) % kSize];
  return {newest.world_from_odometry_x_m(), newest.world_from_odometry_y_m()};
}

}  // namespace lodesman
