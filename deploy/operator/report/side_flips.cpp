// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/report/side_flips.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace lodesman::cli {
namespace {

using Place = std::array<double, 2>;

constexpr double kRadPerDeg = std::numbers::pi / 180.0;
// A path that passes something turns about it by half a turn; one that ends beside it by a quarter.
constexpr double kPassedSweep_rad = std::numbers::pi / 2.0;

double distance(const Place& a, const Place& b) { return std::hypot(b[0] - a[0], b[1] - a[1]); }

Place nearest_on_segment(const Place& a, const Place& b, const Place& to) {
  const Place along{b[0] - a[0], b[1] - a[1]};
  const double squared = along[0] * along[0] + along[1] * along[1];
  const double dot = (to[0] - a[0]) * along[0] + (to[1] - a[1]) * along[1];
  const double share = squared > 0.0 ? std::clamp(dot / squared, 0.0, 1.0) : 0.0;
  return {a[0] + share * along[0], a[1] + share * along[1]};
}

// A wall is passed round the one or the other of its ends, so what counts of it is the place that
// the path comes nearest to.
Place wall_point_nearest(const Obstacle& wall, const std::vector<Place>& path) {
  const bool closed = wall.shape == ObstacleShape::kPolygon;
  const std::size_t count = std::min<std::size_t>(wall.vertex_count, kMaxVertices);
  const auto vertex = [&](std::size_t i) {
    return Place{wall.vertices[i % count].x_m, wall.vertices[i % count].y_m};
  };
  Place nearest = vertex(0);
  double nearest_m = distance(nearest, path.front());
  for (std::size_t i = 0; i + (closed ? 0 : 1) < count; ++i) {
    for (const Place& on_path : path) {
      const Place candidate = nearest_on_segment(vertex(i), vertex(i + 1), on_path);
      const double candidate_m = distance(candidate, on_path);
      if (candidate_m < nearest_m) {
        nearest = candidate;
        nearest_m = candidate_m;
      }
    }
  }
  return nearest;
}

// What of an obstacle counts for a path.
Place place_for(const std::vector<Place>& path, const Obstacle& obstacle) {
  return obstacle.shape != ObstacleShape::kEllipse
             ? wall_point_nearest(obstacle, path)
             : Place{obstacle.centre_x_m, obstacle.centre_y_m};
}

bool is_ahead_and_near(const PlanRecord& plan, const Place& place) {
  const double heading_rad = plan.start_heading_deg * kRadPerDeg;
  const double dx_m = place[0] - plan.start_m[0];
  const double dy_m = place[1] - plan.start_m[1];
  return dx_m * std::sin(heading_rad) + dy_m * std::cos(heading_rad) > 0.0 &&
         std::hypot(dx_m, dy_m) <= kSideFlipRange_m;
}

// [rad] counter-clockwise: how far somebody at `place` turns who watches a boat sail the path.
// Unlike a cross product at the closest approach it does not depend on the direction of a single
// step of a path of pixels, nor on which of two equally near pixels is the first.
double swept_rad(const std::vector<Place>& path, const Place& place) {
  double sum_rad = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Place from{path[i - 1][0] - place[0], path[i - 1][1] - place[1]};
    const Place to{path[i][0] - place[0], path[i][1] - place[1]};
    sum_rad += std::atan2(from[0] * to[1] - from[1] * to[0], from[0] * to[0] + from[1] * to[1]);
  }
  return sum_rad;
}

// Whether who sails one path and comes back by the other has gone round a place.
bool enclose(const std::vector<Place>& one, const std::vector<Place>& other, const Place& place) {
  std::vector<Place> round = one;
  round.insert(round.end(), other.rbegin(), other.rend());
  round.push_back(one.front());
  return std::abs(swept_rad(round, place)) > std::numbers::pi;
}

bool lies_between(const std::vector<Place>& one, const std::vector<Place>& other,
                  const Obstacle& obstacle) {
  return enclose(one, other, place_for(one, obstacle)) ||
         enclose(one, other, place_for(other, obstacle));
}

}  // namespace

PassingSide passing_side(const PlanRecord& plan, const Obstacle& obstacle) {
  const bool is_wall = obstacle.shape != ObstacleShape::kEllipse;
  if (plan.reason != PathReason::kFound || plan.path_m.size() < 2 ||
      (is_wall && obstacle.vertex_count == 0)) {
    return PassingSide::kNone;
  }
  const Place place = place_for(plan.path_m, obstacle);
  if (!is_ahead_and_near(plan, place)) {
    return PassingSide::kNone;
  }
  const double turned_rad = swept_rad(plan.path_m, place);
  if (std::abs(turned_rad) < kPassedSweep_rad) {
    return PassingSide::kNone;
  }
  return turned_rad < 0.0 ? PassingSide::kLeft : PassingSide::kRight;
}

SideFlipCounter::SideFlipCounter(std::vector<MovingObstacle> obstacles)
    : obstacles_{std::move(obstacles)}, before_(obstacles_.size(), PassingSide::kNone) {}

void SideFlipCounter::add(const PlanRecord& plan) {
  if (plan.reason != PathReason::kFound) {
    return;
  }
  for (std::size_t i = 0; i < obstacles_.size(); ++i) {
    const Obstacle obstacle = obstacles_[i].at(plan.captured_s);
    const PassingSide now =
        obstacles_[i].exists(plan.captured_s) ? passing_side(plan, obstacle) : PassingSide::kNone;
    const bool both = now != PassingSide::kNone && before_[i] != PassingSide::kNone;
    if (both && now != before_[i] && lies_between(plan.path_m, path_before_, obstacle)) {
      ++flips_.count;
      flips_.first_s = flips_.first_s.value_or(plan.t_s);
    }
    before_[i] = now;
  }
  path_before_ = plan.path_m;
}

SideFlips side_flips(const std::vector<PlanRecord>& plans,
                     const std::vector<MovingObstacle>& obstacles) {
  SideFlipCounter counter{obstacles};
  for (const PlanRecord& plan : plans) {
    counter.add(plan);
  }
  return counter.flips();
}

}  // namespace lodesman::cli
