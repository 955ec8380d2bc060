// SPDX-License-Identifier: Apache-2.0
#include "high_level/guidance/zones.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "high_level/guidance/hazard.h"
#include "mid_level/geometry/moving_obstacle.h"
#include "mid_level/geometry/obstacle_distance.h"

namespace lodesman {
namespace {

using Vec = Eigen::Vector2d;

constexpr double kArrivalMax_s = 60.0;  // no zone is placed farther ahead in time
constexpr double kReach_m = 12.0;
constexpr double kStep_m = 0.2;
constexpr int kDirections = 72;
constexpr double kOutside_m = 0.05;  // beyond the edge, so that a search accepts it

[[nodiscard]] Vec way(int direction) noexcept {
  const double angle_rad = 2.0 * std::numbers::pi * direction / kDirections;
  return {std::sin(angle_rad), std::cos(angle_rad)};
}

// From a point to an obstacle itself, negative inside.
[[nodiscard]] double shape_clearance_m(const PathRequest& request, const Vec& point) noexcept {
  double least_m = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < request.zone_count; ++i) {
    least_m = std::min(least_m, edge_distance_m(request.zones[i].shape, {point}));
  }
  return least_m;
}

// From a point to a zone's edge, as the path finder draws it: an ellipse's zone is an ellipse.
[[nodiscard]] double zone_distance_m(const Obstacle& obstacle, const Vec& point) noexcept {
  if (obstacle.shape != ObstacleShape::kEllipse) {
    return edge_distance_m(obstacle, {point}) - obstacle.protection_first_m;
  }
  Obstacle zone = obstacle;
  zone.semi_axis_first_m = obstacle.protection_first_m;
  zone.semi_axis_second_m = obstacle.protection_second_m;
  return edge_distance_m(zone, {point});
}

}  // namespace

double sure_zone_m(const ZoneOptions& options, const VehicleModel& vehicle,
                   double speed_m_s) noexcept {
  return options.hull_radius_m + options.margin_m +
         options.margin_per_stopping_way * vehicle.stopping_way_m(speed_m_s) +
         options.margin_per_turning_way * vehicle.turning_way_m(speed_m_s);
}

void put_zone(Obstacle& shape, double clear_m) noexcept {
  const bool ellipse = shape.shape == ObstacleShape::kEllipse;
  shape.protection_first_m = clear_m + (ellipse ? shape.semi_axis_first_m : 0.0);
  shape.protection_second_m = clear_m + (ellipse ? shape.semi_axis_second_m : 0.0);
}

void make_zones(const ZoneOptions& options, const VehicleModel& vehicle, const Tracks& tracks,
                Time now, const Vec& from_W, double speed_m_s, PathRequest& request,
                double own_sigma_m) noexcept {
  request.zone_count = 0;
  const double sure_m = sure_zone_m(options, vehicle, speed_m_s);
  for (std::uint32_t i = 0; i < std::min<std::uint32_t>(tracks.count, kMaxObstacles); ++i) {
    const Track& track = tracks.tracks[i];
    const Vec velocity = probability_of_motion(track) > 0.5
                             ? Vec{track.velocity_x_m_s, track.velocity_y_m_s}
                             : Vec{0.0, 0.0};
    if (velocity.norm() > options.slow_share * speed_m_s) {
      continue;
    }
    const double age_s = to_seconds(now - track.last_seen);
    const Obstacle here = translated(track.shape, age_s * velocity.x(), age_s * velocity.y());
    const double distance_m = std::max(0.0, edge_distance_m(here, {from_W}));
    const double arrival_s = std::min(kArrivalMax_s, distance_m / speed_m_s);
    PathZone& zone = request.zones[request.zone_count++];
    zone = {};
    zone.shape = translated(here, arrival_s * velocity.x(), arrival_s * velocity.y());
    const double variance_m2 =
        std::max(track.place_xx_m2, track.place_yy_m2) +
        age_s * age_s * std::max(track.velocity_xx_m2_s2, track.velocity_yy_m2_s2) +
        own_sigma_m * own_sigma_m;
    const double doubt_m =
        std::min(options.doubt_max_m, options.doubt_sigmas * std::sqrt(variance_m2));
    const double clear_m = sure_m + doubt_m;
    put_zone(zone.shape, clear_m);
    zone.give_m = std::max(0.0, clear_m - options.hull_radius_m - options.least_margin_m);
  }
}

double zone_clearance_m(const PathRequest& request, const Vec& point_W) noexcept {
  double least_m = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < request.zone_count; ++i) {
    least_m = std::min(least_m, zone_distance_m(request.zones[i].shape, point_W));
  }
  return least_m;
}

std::optional<Vec> way_out(const PathRequest& request, const Vec& point_W) noexcept {
  constexpr double kSlack_m = 0.02;
  const double start_m = shape_clearance_m(request, point_W);
  std::optional<Vec> best;
  double nearest_m = kReach_m + kStep_m;
  for (int direction = 0; direction < kDirections; ++direction) {
    double allowed_m = start_m;
    for (double out_m = kStep_m; out_m < nearest_m; out_m += kStep_m) {
      const Vec p = point_W + out_m * way(direction);
      const double shape_m = shape_clearance_m(request, p);
      // Near an obstacle it must not get nearer; far enough from all of them it may pass.
      if (shape_m < std::min(allowed_m, 1.0) - kSlack_m) {
        break;
      }
      allowed_m = std::max(allowed_m, std::min(shape_m, 1.0));
      if (zone_clearance_m(request, p) >= kOutside_m) {
        nearest_m = out_m;
        best = p;
        break;
      }
    }
  }
  return best;
}

bool make_room(PathRequest& request, const Vec& point_W) noexcept {
  bool needed = false;
  for (std::uint32_t i = 0; i < request.zone_count; ++i) {
    const double need_m = kOutside_m - zone_distance_m(request.zones[i].shape, point_W);
    if (need_m > request.zones[i].give_m) {
      return false;
    }
    needed = needed || need_m > 0.0;
  }
  for (std::uint32_t i = 0; i < request.zone_count && needed; ++i) {
    PathZone& zone = request.zones[i];
    const double need_m = std::max(0.0, kOutside_m - zone_distance_m(zone.shape, point_W));
    zone.shape.protection_first_m -= need_m;
    zone.shape.protection_second_m -= need_m;
    zone.give_m -= need_m;
  }
  return needed;
}

std::optional<Vec> nearest_free(const PathRequest& request, const Vec& point_W, const Vec& from_W,
                                double outside_m) noexcept {
  for (double out_m = kStep_m; out_m <= kReach_m; out_m += kStep_m) {
    std::optional<Vec> best;
    for (int direction = 0; direction < kDirections; ++direction) {
      const Vec p = point_W + out_m * way(direction);
      if (zone_clearance_m(request, p) >= outside_m &&
          (!best || (p - from_W).norm() < (*best - from_W).norm())) {
        best = p;
      }
    }
    if (best) {
      return best;
    }
  }
  return std::nullopt;
}

}  // namespace lodesman
