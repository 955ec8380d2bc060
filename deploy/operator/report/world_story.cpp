// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/report/world_story.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "deploy/operator/report/numbers.h"
#include "deploy/operator/report/shapes.h"
#include "deploy/operator/report/titles.h"

namespace lodesman::cli {
namespace {

constexpr double kMargin_m = 0.7;
constexpr double kNearby_m = 6.0;    // so far beyond all else an obstacle is shown
constexpr double kSmallest_m = 4.0;  // side of the box

bool is_found(const PlanRecord& plan) { return plan.reason == PathReason::kFound; }

const PlanRecord* first_plan(const std::vector<PlanRecord>& plans) {
  const auto found = std::find_if(plans.begin(), plans.end(), is_found);
  return found != plans.end() ? &*found : plans.empty() ? nullptr : &plans.front();
}

// Rather one after a found plan: only then are there previous waypoints to show.
const PlanRecord* first_without_path(const std::vector<PlanRecord>& plans) {
  const auto found = std::find_if(plans.begin(), plans.end(), is_found);
  const auto after = std::find_if_not(found, plans.end(), is_found);
  if (after != plans.end()) {
    return &*after;
  }
  const auto any = std::find_if_not(plans.begin(), plans.end(), is_found);
  return any != plans.end() ? &*any : nullptr;
}

std::string no_path_caption(PathReason reason) {
  std::string words = to_string(reason);
  std::replace(words.begin(), words.end(), '_', ' ');
  return reason == PathReason::kNoPath ? words : "no path: " + words;
}

double end_s(const RunRecord& record) {
  return record.trajectory.empty() ? record.result.time_s : record.trajectory.back().t_s;
}

void add_unless_near(std::vector<Moment>& moments, double apart_s, Moment moment) {
  const auto near = [&](const Moment& other) { return std::abs(other.t_s - moment.t_s) < apart_s; };
  if (moments.size() < kMaxMoments && std::isfinite(moment.t_s) &&
      std::none_of(moments.begin(), moments.end(), near)) {
    moments.push_back(std::move(moment));
  }
}

void find_plans(const std::vector<PlanRecord>& plans, bool changes_side, Moment& moment) {
  for (const PlanRecord& plan : plans) {
    if (plan.t_s > moment.t_s) {
      break;
    }
    moment.plan = &plan;
    if (is_found(plan)) {
      moment.replaced = changes_side ? moment.last_found : nullptr;
      moment.last_found = &plan;
    }
  }
}

void include(ViewBox& box, const Line& line, double around = 0.0) {
  for (const Point& point : line) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
      if (std::isfinite(point[axis])) {
        box.low[axis] = std::min(box.low[axis], point[axis] - around);
        box.high[axis] = std::max(box.high[axis], point[axis] + around);
      }
    }
  }
}

void include_obstacle(ViewBox& box, const ViewBox& limits, const Obstacle& obstacle) {
  std::vector<Line> shapes = zone_shapes(obstacle);
  shapes.push_back(outline(obstacle));
  for (Line& shape : shapes) {
    for (Point& point : shape) {
      for (std::size_t axis = 0; axis < 2; ++axis) {
        point[axis] = std::clamp(point[axis], limits.low[axis], limits.high[axis]);
      }
    }
    include(box, shape);
  }
}

}  // namespace

std::vector<Moment> story(const RunRecord& record) {
  const RunResult& result = record.result;
  const double end = end_s(record);
  const double apart_s = std::max(1.0, 0.02 * end);
  std::vector<Moment> moments;
  add_unless_near(moments, apart_s, {.t_s = end, .caption = outcome_words(result), .is_end = true});
  if (const PlanRecord* first = first_plan(record.plans)) {
    add_unless_near(moments, apart_s, {.t_s = first->t_s, .caption = "first plan"});
  }
  const std::optional<double>& flip_s = result.first_side_flip_s;
  if (flip_s) {
    add_unless_near(moments, apart_s, {.t_s = *flip_s, .caption = "path changes side"});
  }
  if (const PlanRecord* none = first_without_path(record.plans)) {
    add_unless_near(moments, apart_s, {.t_s = none->t_s, .caption = no_path_caption(none->reason)});
  }
  if (result.time_of_min_inoffensive_distance_s && result.min_inoffensive_distance_m) {
    add_unless_near(
        moments, apart_s,
        {.t_s = *result.time_of_min_inoffensive_distance_s,
         .caption = "closest: ID " + fixed(*result.min_inoffensive_distance_m, 2) + " m"});
  }
  std::sort(moments.begin(), moments.end(),
            [](const Moment& a, const Moment& b) { return a.t_s < b.t_s; });
  for (Moment& moment : moments) {
    const bool changes_side = flip_s && !(moment.t_s < *flip_s) && !(moment.t_s > *flip_s);
    find_plans(record.plans, changes_side, moment);
  }
  return moments;
}

ViewBox view_box(const RunRecord& record, const std::vector<Moment>& moments) {
  const double waypoint_m = record.waypoint_radius_m;
  ViewBox box{.low = record.start_m, .high = record.start_m};
  include(box, {record.start_m}, record.vehicle_radius_m);
  include(box, {record.goal_m}, record.goal_radius_m);
  for (const TrajectoryRow& row : record.trajectory) {
    include(box, {{row.x_m, row.y_m}}, record.vehicle_radius_m);
  }
  for (const Moment& moment : moments) {
    for (const PlanRecord* plan : {moment.plan, moment.last_found, moment.replaced}) {
      if (plan != nullptr) {
        include(box, plan->waypoints_m, waypoint_m);
        include(box, plan->path_m);
      }
    }
  }
  ViewBox limits = box;
  include(limits, {box.low, box.high}, kNearby_m);
  for (const MovingObstacle& obstacle : record.obstacles) {
    for (const Moment& moment : moments) {
      if (obstacle.exists(moment.t_s)) {
        include_obstacle(box, limits, obstacle.at(moment.t_s));
      }
    }
    include_obstacle(box, limits, obstacle.at(obstacle.appears_at_s));
  }
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const double missing = std::max(0.0, kSmallest_m - (box.high[axis] - box.low[axis]));
    box.low[axis] -= kMargin_m + missing / 2.0;
    box.high[axis] += kMargin_m + missing / 2.0;
  }
  return box;
}

const TrajectoryRow* row_at(const std::vector<TrajectoryRow>& rows, double t_s) {
  if (rows.empty()) {
    return nullptr;
  }
  const auto later =
      std::find_if(rows.begin(), rows.end(), [&](const auto& row) { return row.t_s > t_s + 1e-6; });
  return later == rows.begin() ? &rows.front() : &*(later - 1);
}

bool moves(const MovingObstacle& obstacle) {
  return std::hypot(obstacle.velocity_x_m_s, obstacle.velocity_y_m_s) > 0.0 &&
         obstacle.stops_at_s > 0.0;
}

}  // namespace lodesman::cli
