// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/run/estimated_truth.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "mid_level/geometry/obstacle_distance.h"

namespace lodesman::cli {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Moved on to that time where it surely moves.
[[nodiscard]] Obstacle shape_at(const Track& track, Time at) noexcept {
  const double after_s = track.surely_moves() ? to_seconds(at - track.last_seen) : 0.0;
  return translated(track.shape, track.velocity_x_m_s * after_s, track.velocity_y_m_s * after_s);
}

}  // namespace

EstimatedTruth::EstimatedTruth(const Blackboard& board, double vehicle_radius_m,
                               std::vector<MovingObstacle> known, std::optional<Time> begins)
    : vehicle_radius_m_{vehicle_radius_m},
      known_{std::move(known)},
      begins_{begins},
      mission_{board.mission_status},
      state_{board.vehicle_state},
      tracks_{board.tracks},
      thrust_{board.thrust_applied},
      board_{std::make_unique<Blackboard>()},
      writer_{board_->world_truth, Role::kLow, "world_truth"} {
  truth_.least_inoffensive_distance_m = kInfinity;
  truth_.hull_clearance_m = kInfinity;
  truth_.least_hull_clearance_m = kInfinity;
}

void EstimatedTruth::update() {
  if (const auto* mission = mission_.latest(); mission != nullptr) {
    first_started_ = begins_.value_or(mission->value.first_started);
  }
  if (const auto* thrust = thrust_.latest(); thrust != nullptr) {
    truth_.thrust_left = thrust->value.left;
    truth_.thrust_right = thrust->value.right;
  }
  while (const auto* tracks = tracks_.next()) {
    newest_ = tracks->value;
    for (std::uint32_t i = 0; i < newest_.count; ++i) {
      const Track& track = newest_.tracks[i];
      Seen& seen = seen_.try_emplace(track.id, Seen{tracks->value.captured, {}}).first->second;
      seen.last = track;
    }
  }
  while (const auto* state = state_.next()) {
    publish(*state);
  }
}

void EstimatedTruth::publish(const Stamped<VehicleState>& state) {
  const VehicleState& now = state.value;
  truth_.scenario_time_s = scenario_time_s(state.stamp);
  truth_.x_m = now.x_m;
  truth_.y_m = now.y_m;
  truth_.heading_rad = now.heading_rad;
  truth_.surge_m_s = now.surge_m_s;
  truth_.sway_m_s = now.sway_m_s;
  truth_.yaw_rate_rad_s = now.yaw_rate_rad_s;
  truth_.inoffensive_distance_m = inoffensive_distance_m({{now.x_m, now.y_m}}, state.stamp);
  const bool sails = first_started_ != Time{} && state.stamp >= first_started_;
  if (sails && truth_.inoffensive_distance_m < truth_.least_inoffensive_distance_m) {
    truth_.least_inoffensive_distance_m = truth_.inoffensive_distance_m;
    truth_.least_inoffensive_distance_at_s = truth_.scenario_time_s;
  }
  writer_.publish(truth_, state.stamp);
}

double EstimatedTruth::inoffensive_distance_m(const WorldPoint& place, Time at) const {
  double nearest_m = kInfinity;
  for (const MovingObstacle& obstacle : known_) {
    if (const double now_s = scenario_time_s(at); obstacle.exists(now_s)) {
      nearest_m = std::min(nearest_m, edge_distance_m(obstacle.at(now_s), place));
    }
  }
  for (std::uint32_t i = 0; known_.empty() && i < newest_.count; ++i) {
    nearest_m = std::min(nearest_m, edge_distance_m(shape_at(newest_.tracks[i], at), place));
  }
  return nearest_m - vehicle_radius_m_;
}

double EstimatedTruth::scenario_time_s(Time stamp) const noexcept {
  return first_started_ == Time{} ? 0.0 : std::max(to_seconds(stamp - first_started_), 0.0);
}

std::vector<MovingObstacle> EstimatedTruth::seen() const {
  std::vector<MovingObstacle> obstacles;
  obstacles.reserve(seen_.size());
  for (const auto& [id, seen] : seen_) {
    MovingObstacle obstacle;
    obstacle.at_start = shape_at(seen.last, first_started_);
    obstacle.at_start.protection_first_m = seen.last.shape.semi_axis_first_m;
    obstacle.at_start.protection_second_m = seen.last.shape.semi_axis_second_m;
    if (seen.last.surely_moves()) {
      obstacle.velocity_x_m_s = seen.last.velocity_x_m_s;
      obstacle.velocity_y_m_s = seen.last.velocity_y_m_s;
    }
    obstacle.appears_at_s = scenario_time_s(seen.first);
    obstacles.push_back(obstacle);
  }
  return obstacles;
}

}  // namespace lodesman::cli
