// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/sonar/heard_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace lodesman {
namespace {

// Ours: a hard surface is bright, and its echo dies away over a few bins.
constexpr std::array<std::uint8_t, 4> kEcho = {kBrightestEcho, 150, 100, 50};

// Whether the ray passes so far beside an ellipse that it surely misses it.
[[nodiscard]] bool passes_by(const Obstacle& o, const Eigen::Vector2d& from,
                             const Eigen::Vector2d& direction) noexcept {
  const double x_m = o.centre_x_m - from.x();
  const double y_m = o.centre_y_m - from.y();
  const double aside_m = std::abs(x_m * direction.y() - y_m * direction.x());
  return o.shape == ObstacleShape::kEllipse &&
         aside_m > std::max(o.semi_axis_first_m, o.semi_axis_second_m);
}

}  // namespace

HeardScene::HeardScene(std::vector<MovingObstacle> obstacles) : obstacles_{std::move(obstacles)} {
  scene_.reserve(obstacles_.size());
  which_.reserve(obstacles_.size());
}

void HeardScene::observe(const VehiclePose& pose, double scenario_time_s) noexcept {
  pose_ = pose;
  scene_.clear();
  which_.clear();
  for (std::size_t i = 0; i < obstacles_.size(); ++i) {
    if (obstacles_[i].exists(scenario_time_s)) {
      scene_.push_back(obstacles_[i].at(scenario_time_s));
      which_.push_back(i);
    }
  }
}

double HeardScene::range_m(double bearing_rad) const noexcept {
  const double in_world_rad = pose_.angle_to_world_rad(bearing_rad);
  const Eigen::Vector2d direction_W{std::sin(in_world_rad), std::cos(in_world_rad)};
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const Obstacle& obstacle : scene_) {
    nearest_m = std::min(nearest_m, ray_range_m(obstacle, pose_.p_WV, direction_W));
  }
  return nearest_m;
}

HeardScene::Surface HeardScene::nearest(double bearing_rad,
                                        std::span<const double> turned_rad) const noexcept {
  Surface nearest;
  for (std::size_t i = 0; i < scene_.size(); ++i) {
    const double in_world_rad = pose_.angle_to_world_rad(bearing_rad - turned_rad[which_[i]]);
    const Eigen::Vector2d direction_W{std::sin(in_world_rad), std::cos(in_world_rad)};
    const double range_m = ray_range_m(scene_[i], pose_.p_WV, direction_W);
    if (range_m < nearest.range_m) {
      nearest = {range_m, which_[i]};
    }
  }
  return nearest;
}

HeardSurface HeardScene::surface(double bearing_rad) const noexcept {
  const double in_world_rad = pose_.angle_to_world_rad(bearing_rad);
  const Eigen::Vector2d direction_W{std::sin(in_world_rad), std::cos(in_world_rad)};
  HeardSurface nearest;
  for (const Obstacle& obstacle : scene_) {
    if (passes_by(obstacle, pose_.p_WV.xy_m, direction_W)) {
      continue;
    }
    const SurfaceHit hit = surface_hit(obstacle, pose_.p_WV, direction_W);
    if (hit.range_m < nearest.hit.range_m) {
      nearest = {hit, &obstacle};
    }
  }
  return nearest;
}

void draw_echo(double surface_m, double range_m, std::span<std::uint8_t> bins) noexcept {
  if (!(surface_m < range_m)) {
    return;
  }
  const auto first =
      static_cast<std::size_t>(surface_m / range_m * static_cast<double>(bins.size()));
  for (std::size_t i = 0; i < kEcho.size() && first + i < bins.size(); ++i) {
    bins[first + i] = kEcho[i];
  }
}

}  // namespace lodesman
