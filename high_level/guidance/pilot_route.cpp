// SPDX-License-Identifier: Apache-2.0
// The route that the pilot keeps: made of an answer, gone on with, and which side of what it goes.
#include <algorithm>
#include <cmath>

#include "high_level/guidance/pilot.h"
#include "mid_level/geometry/obstacle_distance.h"

namespace lodesman {
namespace {

using Vec = Eigen::Vector2d;

constexpr double kPassing_m = 4.0;  // an obstacle whose zone is farther off a path is not passed
constexpr double kBetter_m = 1.5;   // nearer to the goal by this is a better place to wait at
constexpr int kAsksForBest = 10;    // pings on the way to one, before the goal is asked for again
constexpr int kFreeAsks = 10;       // pings on any way, where a line cannot be gone back to

[[nodiscard]] Vec centre_of(const Obstacle& shape) noexcept {
  if (shape.shape == ObstacleShape::kEllipse) {
    return {shape.centre_x_m, shape.centre_y_m};
  }
  Vec centre = Vec::Zero();
  for (std::uint32_t i = 0; i < shape.vertex_count; ++i) {
    centre += Vec{shape.vertices[i].x_m, shape.vertices[i].y_m} / shape.vertex_count;
  }
  return centre;
}

}  // namespace

// On the way to the best point the goal itself is asked for now and then; there, always.
bool Pilot::asks_for_best() noexcept {
  const bool there = best_ && (*best_ - own_W_).norm() < kDrifted_m;
  if (!best_ || there || asks_for_best_ == kAsksForBest) {
    asks_for_best_ = 0;
    return false;
  }
  ++asks_for_best_;
  return true;
}

// Whether the best point stands that is made for already, and with it the route to it. Points round
// a closed goal are much alike, and each look shows another one as the nearest.
bool Pilot::keeps_best(const SonarPath& path) noexcept {
  if (asked_for_best_) {
    const bool led = path.reason == PathReason::kFound || path.reason == PathReason::kLimit;
    best_ = led ? best_ : std::nullopt;
    return false;
  }
  if (path.reason != PathReason::kNoPath || path.point_count == 0) {
    best_.reset();
    return false;
  }
  const PathPoint& last = path.points[path.point_count - 1];
  const Vec goal{asked_->goal_x_m, asked_->goal_y_m};
  const Vec nearest{last.x_m, last.y_m};
  const bool stands = best_ && zone_clearance_m(*asked_, *best_) > -kSlightly_m &&
                      (*best_ - goal).norm() < (nearest - goal).norm() + kBetter_m;
  if (!stands) {
    best_ = nearest;
  }
  return stands;
}

// The way that the answer shows; of a search that met its bound the way that was there before.
PathReason Pilot::take_route(const SonarPath& path) noexcept {
  const bool found = path.reason == PathReason::kFound;
  if (line_ && line_->rejoins && !found && path.reason != PathReason::kLimit) {
    return make_for_the_end_of_the_line(path.reason);
  }
  const bool best_kept = keeps_best(path);
  if (path.reason == PathReason::kLimit && route_.count > 1) {
    return path.reason;
  }
  if (!best_kept) {
    make_route(path);
  }
  if (found) {
    remember_sides(route_);
    if (line_ && line_->rejoins) {
      (void)route_.add(line_->leg.to_W);
    }
  }
  route_is_narrow_ = path.narrow;
  stay_at_end_ = stay_ || goal_moved_ || asked_for_best_ || !found;
  return path.reason;
}

// The line cannot be gone back to where it was to be: until the next answer on the way that there
// was, or straight, as far as the manoeuvres allow.
PathReason Pilot::make_for_the_end_of_the_line(PathReason reason) noexcept {
  free_asks_ = kFreeAsks;
  if (route_.count > 1) {
    return PathReason::kFound;
  }
  route_.clear();
  (void)route_.add(own_W_);
  (void)route_.add(line_->leg.to_W);
  stay_at_end_ = false;
  return reason;
}

void Pilot::make_route(const SonarPath& path) noexcept {
  route_.clear();
  const bool on_line = line_ && (line_->line.is_clear || line_->line.leave_m > line_->line.along_m);
  (void)route_.add(on_line ? line_->leg.at(line_->line.along_m) : own_W_);
  if (line_ && line_->line.is_clear && path.reason == PathReason::kFound) {
    (void)route_.add({asked_->goal_x_m, asked_->goal_y_m});
    return;
  }
  const bool led = path.point_count > 0;
  for (std::uint32_t i = 0; i < path.point_count; ++i) {
    const Vec point{path.points[i].x_m, path.points[i].y_m};
    if ((point - route_.end()).norm() > 1e-3) {
      (void)route_.add(point);
    }
  }
  if (!led) {
    (void)route_.add({asked_->start_x_m, asked_->start_y_m});
  }
  if (route_.count == 1) {
    (void)route_.add(route_.end());
  }
}

// Sides are kept to as long as the path still goes by.
void Pilot::remember_sides(const Route& route) noexcept {
  side_count_ = 0;
  for (std::uint32_t i = 0; i < asked_->zone_count; ++i) {
    const Obstacle& shape = asked_->zones[i].shape;
    const Vec centre = centre_of(shape);
    const RoutePlace place = nearest_place(route, centre, {}, 1e9);
    const bool at_start = place.leg == 0 && place.share <= 0.0;
    const bool at_end = place.leg + 2 >= route.count && place.share >= 1.0;
    const Vec there = point_at(route, place);
    if (shape.id == 0 || at_start || at_end || edge_distance_m(shape, {there}) > kPassing_m) {
      continue;
    }
    const Vec along = route.points[place.leg + 1] - route.points[place.leg];
    const Vec across = centre - there;
    const double to_port = along.x() * across.y() - along.y() * across.x();
    sides_[side_count_++] = {shape.id, to_port > 0.0 ? Side::kPort : Side::kStarboard};
  }
}

}  // namespace lodesman
