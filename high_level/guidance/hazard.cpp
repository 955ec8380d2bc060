// SPDX-License-Identifier: Apache-2.0
#include "high_level/guidance/hazard.h"

#include <algorithm>
#include <cmath>

#include "mid_level/base/heading.h"
#include "mid_level/geometry/obstacle_distance.h"

namespace lodesman {
namespace {

using Vec = Eigen::Vector2d;

constexpr double kMovesBefore = 0.3;     // probability of motion, before its velocity is looked at
constexpr double kUsualSpeed_m_s = 0.5;  // of what moves, standard deviation of each component
constexpr double kNegligible = 0.05;     // a hypothesis less likely than this is left out
constexpr double kMoving_m_s = 0.05;     // slower than this nothing has a bow to cross

constexpr double kAheadRange_m = 8.0;
constexpr double kAheadBeside_m = 1.0;

[[nodiscard]] double larger_sigma(double xx, double xy, double yy) noexcept {
  const double mean = 0.5 * (xx + yy);
  const double spread = std::hypot(0.5 * (xx - yy), xy);
  return std::sqrt(std::max(0.0, mean + spread));
}

// A disc round the shape: its centre, and how far its farthest point lies.
void enclose(const Obstacle& shape, Vec& centre, double& radius_m) noexcept {
  if (shape.shape == ObstacleShape::kEllipse) {
    centre = {shape.centre_x_m, shape.centre_y_m};
    radius_m = std::max(shape.semi_axis_first_m, shape.semi_axis_second_m);
    return;
  }
  centre.setZero();
  const std::uint32_t count = std::max(1U, shape.vertex_count);
  for (std::uint32_t i = 0; i < shape.vertex_count; ++i) {
    centre += Vec{shape.vertices[i].x_m, shape.vertices[i].y_m} / count;
  }
  radius_m = 0.0;
  for (std::uint32_t i = 0; i < shape.vertex_count; ++i) {
    radius_m =
        std::max(radius_m, (Vec{shape.vertices[i].x_m, shape.vertices[i].y_m} - centre).norm());
  }
}

}  // namespace

double probability_of_motion(const Track& track) noexcept {
  const double squared_m2_s2 =
      track.velocity_x_m_s * track.velocity_x_m_s + track.velocity_y_m_s * track.velocity_y_m_s;
  const double noise_m2_s2 = 0.5 * (track.velocity_xx_m2_s2 + track.velocity_yy_m2_s2);
  if (noise_m2_s2 <= 0.0) {
    return squared_m2_s2 > 0.0 ? 1.0 : 0.0;
  }
  // Two normal distributions of the velocity measured: noise alone, and motion with noise.
  const double moving_m2_s2 = kUsualSpeed_m_s * kUsualSpeed_m_s + noise_m2_s2;
  const double exponent = 0.5 * squared_m2_s2 * (1.0 / noise_m2_s2 - 1.0 / moving_m2_s2);
  const double odds = kMovesBefore / (1.0 - kMovesBefore) * (noise_m2_s2 / moving_m2_s2) *
                      std::exp(std::min(exponent, 100.0));
  return odds / (1.0 + odds);
}

void foresee_hazards(Time now, const Tracks& tracks, double own_sigma_m, Hazards& out) noexcept {
  out.count = 0;
  out.fastest_m_s = 0.0;
  for (std::uint32_t i = 0; i < std::min<std::uint32_t>(tracks.count, kMaxObstacles); ++i) {
    const Track& track = tracks.tracks[i];
    Hazard rests;
    rests.track = &track;
    rests.age_s = to_seconds(now - track.last_seen);
    rests.place_sigma_m = std::hypot(
        larger_sigma(track.place_xx_m2, track.place_xy_m2, track.place_yy_m2), own_sigma_m);
    enclose(track.shape, rests.centre, rests.around_m);
    Hazard moves = rests;
    moves.probability = probability_of_motion(track);
    moves.velocity_m_s = {track.velocity_x_m_s, track.velocity_y_m_s};
    moves.velocity_sigma_m_s =
        larger_sigma(track.velocity_xx_m2_s2, track.velocity_xy_m2_s2, track.velocity_yy_m2_s2);
    rests.probability = 1.0 - moves.probability;
    if (rests.probability > kNegligible) {
      out.list[out.count++] = rests;
    }
    if (moves.probability > kNegligible) {
      out.list[out.count++] = moves;
      out.fastest_m_s = std::max(out.fastest_m_s, moves.velocity_m_s.norm());
    }
  }
}

HullDiscs HullDiscs::of(double half_length_m, double half_beam_m) noexcept {
  const double at_m = 0.5 * half_length_m;
  return {at_m, std::hypot(at_m, half_beam_m)};
}

double clearance_m(const Hazard& hazard, double after_s, const VehicleMotion& own,
                   const HullDiscs& hull, double wanted_m) noexcept {
  const Vec relative = own.position.xy_m - after_s * hazard.velocity_m_s;
  const double bound_m =
      (relative - hazard.centre).norm() - hazard.around_m - hull.at_m - hull.radius_m;
  if (bound_m > wanted_m) {
    return bound_m;
  }
  const Vec to_disc = hull.at_m * Vec{std::sin(own.heading_rad), std::cos(own.heading_rad)};
  const Obstacle& shape = hazard.track->shape;
  return std::min(edge_distance_m(shape, {relative + to_disc}),
                  edge_distance_m(shape, {relative - to_disc})) -
         hull.radius_m;
}

double closeness_ahead(const Hazard& hazard, double after_s, const VehicleMotion& own) noexcept {
  const double speed_m_s = hazard.velocity_m_s.norm();
  if (speed_m_s < kMoving_m_s) {
    return 0.0;
  }
  const Vec from_it = own.position.xy_m - after_s * hazard.velocity_m_s - hazard.centre;
  const Vec its_way = hazard.velocity_m_s / speed_m_s;
  const double along_m = from_it.dot(its_way) - hazard.around_m;
  const double across_m = std::abs(from_it.x() * its_way.y() - from_it.y() * its_way.x());
  const bool in_its_way =
      along_m > 0.0 && along_m < kAheadRange_m && across_m < hazard.around_m + kAheadBeside_m;
  return in_its_way ? 1.0 - along_m / kAheadRange_m : 0.0;
}

}  // namespace lodesman
