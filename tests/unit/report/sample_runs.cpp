// SPDX-License-Identifier: Apache-2.0
#include "tests/unit/report/sample_runs.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include "deploy/operator/report/side_flips.h"

namespace lodesman::testing {
namespace {

using cli::PlanRecord;
using cli::RunRecord;
using cli::TrajectoryRow;
using Point = std::array<double, 2>;
using Path = std::vector<Point>;

constexpr double kStep_s = 0.1;
constexpr double kSpeed_m_s = 0.22;
constexpr double kSpacing_m = 1.3;

double distance(const Point& a, const Point& b) { return std::hypot(b[0] - a[0], b[1] - a[1]); }

// The same line with a point every `spacing`.
Path resampled(const Path& corners, double spacing) {
  Path path{corners.front()};
  double left = spacing;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    Point from = corners[i - 1];
    while (distance(from, corners[i]) >= left) {
      const double share = left / distance(from, corners[i]);
      from = {from[0] + share * (corners[i][0] - from[0]),
              from[1] + share * (corners[i][1] - from[1])};
      path.push_back(from);
      left = spacing;
    }
    left -= distance(from, corners[i]);
  }
  path.push_back(corners.back());
  return path;
}

// Straight, or round a circle on one side (+1: right) where that is in the way.
Path round_circle(const Point& start, const Point& goal, const Point& centre, double radius,
                  double side) {
  Path corners{start};
  for (int degrees = -80; degrees <= 80; degrees += 8) {
    const double turn = degrees * std::numbers::pi / 180.0;
    const Point on{centre[0] + side * radius * std::cos(turn), centre[1] + radius * std::sin(turn)};
    if (on[1] > start[1] + 0.5 && on[1] < goal[1] - 0.5) {
      corners.push_back(on);
    }
  }
  corners.push_back(goal);
  return corners;
}

using Planner = std::function<PlanRecord(double t_s, const Point& at)>;

struct Boat {
  Point at{};
  double heading_rad = 0.0;
  int head_ref = 0;

  void steer_to(const Point& target) {
    const double wanted_rad = std::atan2(target[0] - at[0], target[1] - at[1]);
    const double error_rad = std::remainder(wanted_rad - heading_rad, 2.0 * std::numbers::pi);
    head_ref = static_cast<int>(std::clamp(error_rad * 120.0, -100.0, 100.0));
    heading_rad += std::clamp(error_rad, -0.25, 0.25) * 0.6 * kStep_s * 2.0;
    at[0] += kSpeed_m_s * kStep_s * std::sin(heading_rad);
    at[1] += kSpeed_m_s * kStep_s * std::cos(heading_rad);
  }
};

int thrust(int sum) {
  const double root = std::sqrt(std::abs(sum) / 2.0);
  return std::clamp(static_cast<int>(128.0 + (sum < 0 ? -12.8 : 12.8) * root), 0, 255);
}

double circle_id_m(const RunRecord& run, const Point& at, double t_s) {
  double id_m = std::numeric_limits<double>::infinity();
  for (const MovingObstacle& moving : run.obstacles) {
    const Obstacle o = moving.at(t_s);
    id_m = std::min(id_m, std::hypot(at[0] - o.centre_x_m, at[1] - o.centre_y_m) -
                              o.semi_axis_first_m - run.vehicle_radius_m);
  }
  return id_m;
}

void keep_previous(PlanRecord& plan, const std::vector<PlanRecord>& plans) {
  plan.path_m.clear();
  plan.cost_10_14.reset();
  plan.waypoint_source = plans.empty() ? "none" : "previous";
  plan.waypoints_m = plans.empty() ? Path{} : plans.back().waypoints_m;
}

void finish(RunRecord& run, const std::string& name) {
  cli::RunResult& result = run.result;
  result.scenario = name;
  result.profile = "paper";
  result.mode = "lockstep";
  result.outcome = "goal";
  result.reached = true;
  result.time_s = run.trajectory.back().t_s;
  result.first_side_flip_s = cli::side_flips(run.plans, run.obstacles).first_s;
  for (const TrajectoryRow& row : run.trajectory) {
    if (std::isfinite(row.id_m) && row.id_m < result.min_inoffensive_distance_m.value_or(1e9)) {
      result.min_inoffensive_distance_m = row.id_m;
      result.time_of_min_inoffensive_distance_s = row.t_s;
    }
  }
}

void sail(RunRecord& run, const std::string& name, const Planner& planner, double drift_m_s) {
  Boat boat{.at = run.start_m};
  std::size_t next = 0;
  for (int i = 0; i < 3000 && distance(boat.at, run.goal_m) > 0.4; ++i) {
    const double t_s = i * kStep_s;
    if (i % 16 == 0) {
      PlanRecord plan = planner(t_s, boat.at);
      plan.id = run.plans.size() + 1;
      plan.t_s = plan.captured_s = t_s;
      plan.start_m = boat.at;
      plan.start_heading_deg = boat.heading_rad * 180.0 / std::numbers::pi;
      plan.goal_m = run.goal_m;
      if (plan.reason == PathReason::kFound) {
        plan.waypoint_source = "current";
        plan.waypoints_m = resampled(plan.path_m, kSpacing_m);
        plan.waypoints_m.erase(plan.waypoints_m.begin());
        plan.path_m = resampled(plan.path_m, 0.06);
        next = 0;
      } else {
        keep_previous(plan, run.plans);
      }
      run.plans.push_back(plan);
    }
    const PlanRecord& plan = run.plans.back();
    while (next + 1 < plan.waypoints_m.size() && distance(boat.at, plan.waypoints_m[next]) < 0.5) {
      ++next;
    }
    const Point target = plan.waypoints_m.empty() ? run.goal_m : plan.waypoints_m[next];
    boat.steer_to(target);
    const double heading_deg = boat.heading_rad * 180.0 / std::numbers::pi;
    run.trajectory.push_back({.t_s = t_s,
                              .x_m = boat.at[0],
                              .y_m = boat.at[1],
                              .heading_deg = heading_deg < 0.0 ? heading_deg + 360.0 : heading_deg,
                              .estimate_x_m = boat.at[0] + drift_m_s * t_s,
                              .estimate_y_m = boat.at[1],
                              .surge_m_s = kSpeed_m_s,
                              .surge_ref = 16,
                              .head_ref = boat.head_ref,
                              .thrust_left = thrust(16 + boat.head_ref),
                              .thrust_right = thrust(16 - boat.head_ref),
                              .id_m = circle_id_m(run, boat.at, t_s),
                              .plan_id = plan.id,
                              .path_found = plan.reason == PathReason::kFound,
                              .waypoint_x_m = target[0],
                              .waypoint_y_m = target[1]});
  }
  finish(run, name);
}

RunRecord circle_run(const std::string& name, const MovingObstacle& moving, double flip_s) {
  RunRecord run;
  run.goal_m = {0.0, 20.0};
  run.obstacles = {moving};
  sail(
      run, name,
      [&](double t_s, const Point& at) {
        const Obstacle o = moving.at(t_s);
        const Point centre{o.centre_x_m, o.centre_y_m};
        const double zone_m = o.protection_first_m;
        PlanRecord plan;
        plan.reason =
            distance(at, centre) < zone_m ? PathReason::kStartBlocked : PathReason::kFound;
        plan.cost_10_14 = 3400;
        plan.path_m = at[1] > centre[1] + 1.0 ? Path{at, run.goal_m}
                                              : round_circle(at, run.goal_m, centre, zone_m + 0.05,
                                                             t_s < flip_s ? -1.0 : 1.0);
        return plan;
      },
      0.0);
  return run;
}

// Along fixed corners; the plan is what is left of them.
RunRecord route_run(RunRecord run, const std::string& name, const Path& corners, double drift_m_s) {
  run.start_m = corners.front();
  run.goal_m = corners.back();
  std::size_t passed = 1;
  sail(
      run, name,
      [&](double, const Point& at) {
        while (passed + 1 < corners.size() && distance(at, corners[passed]) < 1.0) {
          ++passed;
        }
        PlanRecord plan;
        plan.reason = PathReason::kFound;
        plan.path_m = {at};
        plan.path_m.insert(plan.path_m.end(), corners.begin() + static_cast<long>(passed),
                           corners.end());
        return plan;
      },
      drift_m_s);
  return run;
}

}  // namespace

MovingObstacle ellipse_at(double x_m, double y_m, double first_m, double second_m, double angle_deg,
                          double zone_first_m, double zone_second_m) {
  MovingObstacle moving;
  Obstacle& o = moving.at_start;
  o.centre_x_m = x_m;
  o.centre_y_m = y_m;
  o.semi_axis_first_m = first_m;
  o.semi_axis_second_m = second_m;
  o.angle_rad = angle_deg * std::numbers::pi / 180.0;
  o.protection_first_m = zone_first_m;
  o.protection_second_m = zone_second_m;
  return moving;
}

MovingObstacle circle_at(double x_m, double y_m, double radius_m, double zone_m) {
  return ellipse_at(x_m, y_m, radius_m, radius_m, 0.0, zone_m, zone_m);
}

MovingObstacle wall_of(ObstacleShape shape, const std::vector<Point>& points_m, double zone_m) {
  MovingObstacle moving;
  Obstacle& o = moving.at_start;
  o.shape = shape;
  o.protection_first_m = zone_m;
  for (const Point& point : points_m) {
    o.vertices[o.vertex_count++] = {point[0], point[1]};
  }
  return moving;
}

RunRecord static_run() { return circle_run("paper-static", circle_at(0.0, 10.0, 0.5, 3.5), 26.0); }

RunRecord moving_run() {
  MovingObstacle moving = circle_at(0.0, 16.0, 0.5, 3.5);
  moving.velocity_y_m_s = -0.11;
  moving.stops_at_s = 16.0 / 0.11;
  return circle_run("paper-moving", moving, 0.0);
}

RunRecord trap_run() {
  RunRecord run;
  run.obstacles = {ellipse_at(0.0, 11.2, 3.0, 0.3, 90.0, 3.6, 0.9),
                   ellipse_at(0.0, 16.8, 3.0, 0.3, 90.0, 3.6, 0.9),
                   ellipse_at(-3.2, 14.0, 3.0, 0.3, 0.0, 3.6, 0.9)};
  return route_run(std::move(run), "paper-local-minimum",
                   {{0.0, 0.0}, {2.5, 8.0}, {4.3, 10.5}, {4.3, 12.2}, {2.0, 14.0}, {0.0, 14.0}},
                   0.0);
}

RunRecord wall_run() {
  RunRecord run;
  run.obstacles = {
      wall_of(ObstacleShape::kPolyline, {{-12.0, 9.0}, {2.0, 9.0}, {6.0, 12.0}, {60.0, 12.0}}, 1.0),
      wall_of(ObstacleShape::kPolygon, {{-22.0, 4.0}, {-17.0, 4.0}, {-17.0, 7.0}, {-22.0, 9.0}},
              1.0)};
  return route_run(
      std::move(run), "quay-wall",
      {{0.0, 0.0}, {-4.0, 6.0}, {-12.0, 7.5}, {-14.0, 9.0}, {-12.0, 11.0}, {0.0, 16.0}}, 0.008);
}

}  // namespace lodesman::testing
