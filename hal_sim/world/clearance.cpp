// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/world/clearance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace lodesman {
namespace {

using Vec = Eigen::Vector2d;

constexpr int kCoarseSamples = 64;
constexpr int kGoldenSteps = 48;
constexpr double kGoldenRatio = 0.6180339887498949;

// ---- The hull: a rectangle round the origin, half its size in `half`.

[[nodiscard]] double rectangle_distance(const Vec& half, const Vec& p) noexcept {
  const Vec outside = p.cwiseAbs() - half;
  return outside.cwiseMax(0.0).norm() + std::min(outside.maxCoeff(), 0.0);
}

// The smallest distance from the rectangle over a side a-b of a wall. A rectangle's distance is
// convex, so where the two are apart the smallest is at an end of the side or at a corner of the
// rectangle; where they overlap, it is that of the rectangle's largest of four linear distances,
// which is least at an end or where two of the four are equal.
[[nodiscard]] double side_clearance(const Vec& half, const Vec& a, const Vec& b) noexcept {
  const Vec way = b - a;
  const auto depth = [&](double share) noexcept {
    return ((a + share * way).cwiseAbs() - half).maxCoeff();
  };
  double deepest = std::min(depth(0.0), depth(1.0));
  // Distance i at share t is offset[i] + t slope[i].
  const std::array<double, 4> offset = {a.x() - half.x(), -a.x() - half.x(), a.y() - half.y(),
                                        -a.y() - half.y()};
  const std::array<double, 4> slope = {way.x(), -way.x(), way.y(), -way.y()};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) {
      const double share = (offset[j] - offset[i]) / (slope[i] - slope[j]);
      if (share > 0.0 && share < 1.0) {  // false for parallel ones, too
        deepest = std::min(deepest, depth(share));
      }
    }
  }
  if (deepest <= 0.0) {
    return deepest;
  }
  double nearest = std::min(rectangle_distance(half, a), rectangle_distance(half, b));
  for (const double x : {-half.x(), half.x()}) {
    for (const double y : {-half.y(), half.y()}) {
      nearest = std::min(nearest, segment_distance_m(a, b, {x, y}));
    }
  }
  return nearest;
}

// The middle of the rectangle: every point as deep in it as possible lies on this segment.
struct Middle {
  Vec a;
  Vec b;
  double depth;
};
[[nodiscard]] Middle middle_of(const Vec& half) noexcept {
  const double depth = half.minCoeff();
  const Vec end = half - Vec{depth, depth};
  return {-end, end, depth};
}

// The smallest value of a function with one minimum in [low, high].
template <class Function>
[[nodiscard]] double golden_minimum(double low, double high, Function f) noexcept {
  double left = high - kGoldenRatio * (high - low);
  double right = low + kGoldenRatio * (high - low);
  double f_left = f(left);
  double f_right = f(right);
  for (int i = 0; i < kGoldenSteps; ++i) {
    if (f_left < f_right) {
      high = right;
      right = left;
      f_right = f_left;
      left = high - kGoldenRatio * (high - low);
      f_left = f(left);
    } else {
      low = left;
      left = right;
      f_left = f_right;
      right = low + kGoldenRatio * (high - low);
      f_right = f(right);
    }
  }
  return std::min(f_left, f_right);
}

// The rectangle's distance is smallest over an ellipse either on the ellipse's edge or, where the
// ellipse covers some of the rectangle's middle, there.
[[nodiscard]] double ellipse_clearance(const Vec& half, const Vec& centre, const Vec& first,
                                       const Vec& second) noexcept {
  const Middle middle = middle_of(half);
  // In the frame that makes the ellipse a unit circle.
  const auto to_unit = [&](const Vec& p) noexcept {
    return Vec{first.dot(p - centre) / first.squaredNorm(),
               second.dot(p - centre) / second.squaredNorm()};
  };
  if (segment_distance_m(to_unit(middle.a), to_unit(middle.b), Vec::Zero()) <= 1.0) {
    return -middle.depth;
  }
  const auto on_edge = [&](double angle_rad) noexcept {
    return rectangle_distance(half,
                              centre + std::cos(angle_rad) * first + std::sin(angle_rad) * second);
  };
  constexpr double kSample_rad = 2.0 * std::numbers::pi / kCoarseSamples;
  double best = std::numeric_limits<double>::infinity();
  double best_rad = 0.0;
  for (int i = 0; i < kCoarseSamples; ++i) {
    const double here = on_edge(i * kSample_rad);
    if (here < best) {
      best = here;
      best_rad = i * kSample_rad;
    }
  }
  return std::min(best, golden_minimum(best_rad - kSample_rad, best_rad + kSample_rad, on_edge));
}

[[nodiscard]] double wall_clearance(const Obstacle& wall, const VehiclePose& pose,
                                    const Vec& half) noexcept {
  const auto to_vehicle = [&](const Vec& p) noexcept { return pose.to_vehicle({p}).xy_m; };
  double nearest = std::numeric_limits<double>::infinity();
  for_each_side(wall, [&](const Vec& a, const Vec& b) {
    nearest = std::min(nearest, side_clearance(half, to_vehicle(a), to_vehicle(b)));
  });
  // A polygon's smallest is on its sides, unless it covers some of the hull's middle; then either
  // a side crosses the middle, which the sides have found, or the middle lies within.
  const Middle middle = middle_of(half);
  return wall.shape == ObstacleShape::kPolygon && encloses(wall, pose.to_world({middle.a}).xy_m)
             ? -middle.depth
             : nearest;
}

}  // namespace

double hull_clearance_m(const Obstacle& obstacle, const VehiclePose& pose,
                        const HullSize& hull) noexcept {
  const Vec half{hull.beam_m / 2.0, hull.length_m / 2.0};
  if (obstacle.shape != ObstacleShape::kEllipse) {
    return wall_clearance(obstacle, pose, half);
  }
  const Vec centre = pose.to_vehicle({{obstacle.centre_x_m, obstacle.centre_y_m}}).xy_m;
  const Vec along = first_axis(pose.angle_to_vehicle_rad(obstacle.angle_rad));
  return ellipse_clearance(half, centre, obstacle.semi_axis_first_m * along,
                           obstacle.semi_axis_second_m * Vec{along.y(), -along.x()});
}

}  // namespace lodesman
