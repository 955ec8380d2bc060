// SPDX-License-Identifier: Apache-2.0
#include "low_level/tracking/sightings.h"

#include <algorithm>
#include <cmath>

#include "mid_level/geometry/obstacle_distance.h"

namespace lodesman {
namespace {

using Vec = Eigen::Vector2d;

constexpr double kCompact_m = 5.0;    // longer things rest, as far as this sonar can tell
constexpr double kMostDepth_m = 1.0;  // half of what a flat front is taken to be deep
// Standard deviations of the middle: of an edge along and across the beam, and by the shape.
constexpr double kAlongSigma_m = 0.05;
constexpr double kAcrossSigma_beams = 0.4;
constexpr double kShapeSigma = 0.12;  // of the half extent each way
// Of something cut, so much more doubt of its middle, and by what is beyond the cut.
constexpr double kCutSigma_m = 0.15;
constexpr double kBeyondCut = 0.5;

// [m] From `from` along a unit vector: the least and the greatest of any part of the shape.
struct Extent {
  double least_m;
  double greatest_m;
  [[nodiscard]] double half_m() const noexcept { return 0.5 * (greatest_m - least_m); }
  [[nodiscard]] double middle_m() const noexcept { return 0.5 * (greatest_m + least_m); }
};

[[nodiscard]] Extent extent_along(const Obstacle& o, const Vec& direction) noexcept {
  if (o.shape == ObstacleShape::kEllipse) {
    const Vec first = first_axis(o.angle_rad);
    const double half_m =
        std::hypot(o.semi_axis_first_m * first.dot(direction),
                   o.semi_axis_second_m * Vec{first.y(), -first.x()}.dot(direction));
    const double middle_m = Vec{o.centre_x_m, o.centre_y_m}.dot(direction);
    return {middle_m - half_m, middle_m + half_m};
  }
  const auto along = [&](const Vertex& v) { return Vec{v.x_m, v.y_m}.dot(direction); };
  Extent extent{along(o.vertices[0]), along(o.vertices[0])};
  for (std::uint32_t i = 1; i < std::min<std::uint32_t>(o.vertex_count, kMaxVertices); ++i) {
    extent.least_m = std::min(extent.least_m, along(o.vertices[i]));
    extent.greatest_m = std::max(extent.greatest_m, along(o.vertices[i]));
  }
  return extent;
}

}  // namespace

bool is_compact(const Obstacle& in_head) noexcept {
  return std::max(extent_along(in_head, Vec::UnitX()).half_m(),
                  extent_along(in_head, Vec::UnitY()).half_m()) <= 0.5 * kCompact_m;
}

bool is_front(const Obstacle& in_head) noexcept {
  const Vec sight = first_axis(std::atan2(in_head.centre_x_m, in_head.centre_y_m));
  const double across_m = extent_along(in_head, {sight.y(), -sight.x()}).half_m();
  return across_m <= kMostDepth_m && extent_along(in_head, sight).half_m() <= across_m;
}

Sighting sighting_of(const Obstacle& in_head, const VehiclePose& head, double beam_width_rad,
                     CutEnds cut) noexcept {
  const double bearing_rad = std::atan2(in_head.centre_x_m, in_head.centre_y_m);
  const Vec sight = first_axis(bearing_rad);
  const Vec beside{sight.y(), -sight.x()};
  const Extent along = extent_along(in_head, sight);
  const Extent across = extent_along(in_head, beside);
  const double half_m = std::max(along.half_m(), half_depth_m(across.half_m()));
  const double range_m = along.least_m + half_m;
  const Vec middle_V = range_m * sight + across.middle_m() * beside;
  Sighting seen;
  seen.cut = cut;
  seen.middle = head.to_world({middle_V}).xy_m;
  seen.shape.shape = ObstacleShape::kEllipse;
  seen.shape.centre_x_m = seen.middle.x();
  seen.shape.centre_y_m = seen.middle.y();
  seen.shape.semi_axis_first_m = half_m;
  seen.shape.semi_axis_second_m = across.half_m();
  seen.shape.angle_rad = head.angle_to_world_rad(bearing_rad);
  seen.shape.peak = in_head.peak;
  const double along_sigma_m = kAlongSigma_m + kShapeSigma * half_m;
  const double across_sigma_m =
      kAcrossSigma_beams * beam_width_rad * std::max(range_m, 0.0) + kShapeSigma * across.half_m();
  const Vec ahead = first_axis(seen.shape.angle_rad);
  const Vec aside{ahead.y(), -ahead.x()};
  seen.covariance = along_sigma_m * along_sigma_m * ahead * ahead.transpose() +
                    across_sigma_m * across_sigma_m * aside * aside.transpose();
  return seen;
}

double half_depth_m(double half_across_m) noexcept { return std::min(half_across_m, kMostDepth_m); }

Vec to_the_rest_m(const Sighting& seen, double hidden_m, double deeper_m) noexcept {
  const Vec sight = first_axis(seen.shape.angle_rad);
  const Vec to_starboard{sight.y(), -sight.x()};
  const double side = seen.cut.port == seen.cut.starboard ? 0.0 : seen.cut.port ? -1.0 : 1.0;
  return side * hidden_m * to_starboard + deeper_m * sight;
}

Sighting completed(const Sighting& seen, double half_across_m) noexcept {
  if (!seen.is_cut()) {
    return seen;
  }
  Sighting whole = seen;
  const double hidden_m = std::max(0.0, half_across_m - seen.shape.semi_axis_second_m);
  whole.shape.semi_axis_second_m += hidden_m;
  const double deeper_m =
      std::max(0.0, half_depth_m(whole.shape.semi_axis_second_m) - whole.shape.semi_axis_first_m);
  whole.shape.semi_axis_first_m += deeper_m;
  whole.middle += to_the_rest_m(seen, hidden_m, deeper_m);
  whole.shape.centre_x_m = whole.middle.x();
  whole.shape.centre_y_m = whole.middle.y();
  // With both ends cut it may be any part of it that is seen.
  const bool one_end = seen.cut.port != seen.cut.starboard;
  const double sigma_m = kCutSigma_m + (one_end ? kBeyondCut : 1.0) * hidden_m;
  const Vec sight = first_axis(seen.shape.angle_rad);
  const Vec across{sight.y(), -sight.x()};
  whole.covariance += sigma_m * sigma_m * across * across.transpose();
  return whole;
}

}  // namespace lodesman
