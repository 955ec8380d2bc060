// SPDX-License-Identifier: Apache-2.0
// One ping after another of a scene in noisy water, as the simulated sonar draws them. Tests and
// measures only, on their one thread.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "hal_sim/sonar/noisy_water.h"
#include "mid_level/geometry/obstacle_distance.h"

namespace lodesman::testing {

// From then on as much of what lasts ends as begins: nothing lasts much longer.
inline constexpr int kUntilUsual = 150;

inline constexpr EchoGrid kUsualGrid{120, 500, 30.0, to_rad(120.0)};

// Numbered as in a scenario, from 1 on.
inline void number(std::vector<MovingObstacle>& scene) {
  for (std::uint32_t i = 0; i < scene.size(); ++i) {
    scene[i].at_start.id = i + 1;
  }
}

[[nodiscard]] inline MovingObstacle ellipse_at(double x_m, double y_m, double first_m,
                                               double second_m, double angle_rad = 0.0) {
  MovingObstacle mover;
  mover.at_start.centre_x_m = x_m;
  mover.at_start.centre_y_m = y_m;
  mover.at_start.semi_axis_first_m = first_m;
  mover.at_start.semi_axis_second_m = second_m;
  mover.at_start.angle_rad = angle_rad;
  return mover;
}

[[nodiscard]] inline MovingObstacle wall_through(const std::vector<Vertex>& vertices) {
  MovingObstacle mover;
  mover.at_start.shape = ObstacleShape::kPolyline;
  for (const Vertex& vertex : vertices) {
    mover.at_start.vertices[mover.at_start.vertex_count++] = vertex;
  }
  return mover;
}

// Whether an obstacle that was found lies on one that is there.
[[nodiscard]] inline bool touches(const Obstacle& seen, const Obstacle& there) {
  constexpr double kBeside_m = 0.5;  // a beam at 30 m
  if (seen.shape == ObstacleShape::kEllipse) {
    const double reach_m = std::max(seen.semi_axis_first_m, seen.semi_axis_second_m);
    return edge_distance_m(there, {{seen.centre_x_m, seen.centre_y_m}}) < reach_m + kBeside_m;
  }
  const auto on_it = [&](const Vertex& at) {
    return edge_distance_m(there, {{at.x_m, at.y_m}}) < kBeside_m;
  };
  return std::any_of(seen.vertices.begin(), seen.vertices.begin() + seen.vertex_count, on_it) ||
         (there.shape == ObstacleShape::kEllipse &&
          edge_distance_m(seen, {{there.centre_x_m, there.centre_y_m}}) < kBeside_m);
}

class NoisyPings {
 public:
  NoisyPings(const WaterKind& kind, std::vector<MovingObstacle> scene, std::uint64_t seed,
             const EchoGrid& grid = kUsualGrid)
      : water_{kind, grid, seed}, scene_{(number(scene), std::move(scene))} {
    ping_->range_m = grid.range_m;
    ping_->make_image(grid.beams, grid.bins, grid.sector_rad);
    look_from({});
  }

  void go_on(int pings) {
    for (int i = 0; i < pings; ++i) {
      (void)next();
    }
  }
  void look_from(const VehiclePose& pose) { scene_.observe(pose, 0.0); }
  // Valid up to the next one.
  const SonarPing& next() {
    ++ping_->number;
    water_.draw(scene_, *ping_);
    return *ping_;
  }

 private:
  NoisyWater water_;
  HeardScene scene_;
  std::unique_ptr<SonarPing> ping_ = std::make_unique<SonarPing>();
};

}  // namespace lodesman::testing
