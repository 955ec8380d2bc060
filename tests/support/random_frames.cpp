// SPDX-License-Identifier: Apache-2.0
#include "tests/support/random_frames.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lodesman::testing {
namespace {

bool covers(const std::vector<EllipsePx>& obstacles, PathPixel pixel) {
  return std::any_of(obstacles.begin(), obstacles.end(), [&](const EllipsePx& obstacle) {
    return obstacle.contains(pixel.column, pixel.row);
  });
}

}  // namespace

FrameMaker::FrameMaker(std::uint32_t seed, const FanShape& fan, int times)
    : random_{seed}, fan_{fan}, times_{times}, scale_{fan.radius_px / 500.0} {}

double FrameMaker::number(double low, double high) {
  return std::uniform_real_distribution<double>{low, high}(random_);
}

int FrameMaker::whole(int low, int high) {
  return std::uniform_int_distribution<int>{low, high}(random_);
}

// Somewhere about the straight way to the goal.
EllipsePx FrameMaker::ellipse(PathPixel goal) {
  const double range = number(80.0, 480.0) * scale_;
  const double ahead = std::atan2(goal.column - fan_.apex_column, fan_.apex_row - goal.row);
  const double bearing = ahead + number(-0.35, 0.35) + number(-0.35, 0.35);
  const double shrink = scale_ / std::sqrt(times_);
  return EllipsePx::with_angle(
      {fan_.apex_column + range * std::sin(bearing), fan_.apex_row - range * std::cos(bearing)},
      number(8.0, 60.0) * shrink, number(8.0, 60.0) * shrink, number(0.0, std::numbers::pi));
}

// Discs that overlap, in a straight row.
void FrameMaker::add_discs(std::vector<EllipsePx>& to, PointPx from, PointPx along, double radius) {
  const double length = std::hypot(along.column, along.row);
  const int count = std::max(1, static_cast<int>(std::ceil(length / (1.6 * radius))));
  for (int i = 0; i <= count; ++i) {
    const double share = static_cast<double>(i) / count;
    to.push_back(
        {{from.column + share * along.column, from.row + share * along.row}, radius, radius});
  }
}

// The same on a circle; bearings run clockwise from straight ahead.
void FrameMaker::add_arc(std::vector<EllipsePx>& to, PointPx centre, double radius, double from_rad,
                         double to_rad) {
  const double disc = std::max(2.0, 0.45 * radius);
  const int count = static_cast<int>(std::ceil((to_rad - from_rad) * radius / (1.5 * disc)));
  for (int i = 0; i <= count; ++i) {
    const double bearing = from_rad + (to_rad - from_rad) * i / count;
    to.push_back(
        {{centre.column + radius * std::sin(bearing), centre.row - radius * std::cos(bearing)},
         disc,
         disc});
  }
}

// Across the whole view, with a gap somewhere in it, or none.
void FrameMaker::add_wall(std::vector<EllipsePx>& to, double gap) {
  const double radius = number(28.0, 40.0) * scale_;
  const double row = fan_.apex_row - number(120.0, 230.0) * scale_;
  const double tilt = number(-0.15, 0.15);
  const double reach = 1.8 * (fan_.apex_row - row);  // beyond the sides of the fan
  const double opening = gap > 0.0 ? number(-120.0, 120.0) * scale_ : 0.0;
  const auto at = [&](double off) { return PointPx{fan_.apex_column + off, row + tilt * off}; };
  for (const double side : {-1.0, 1.0}) {
    const PointPx from = at(opening + side * (gap > 0.0 ? radius + gap / 2.0 : 0.0));
    const PointPx to_end = at(side * reach);
    add_discs(to, from, {to_end.column - from.column, to_end.row - from.row}, radius);
  }
}

void FrameMaker::add_obstacles(RandomFrame& frame) {
  std::vector<EllipsePx>& to = frame.obstacles;
  const PointPx goal{static_cast<double>(frame.goal.column), static_cast<double>(frame.goal.row)};
  const PointPx way{goal.column - fan_.apex_column, goal.row - fan_.apex_row};
  const auto some = [&](int low, int high) {
    for (int i = whole(low, high) * times_; i > 0; --i) {
      to.push_back(ellipse(frame.goal));
    }
  };
  switch (frame.kind) {
    case FrameKind::kOpen: return some(1, 2);
    case FrameKind::kMulti: return some(3, 7);
    case FrameKind::kClutter: return some(8, 12);
    case FrameKind::kHeadOn:
      for (int i = whole(1, 3); i > 0; --i) {
        const double radius = number(15.0, 60.0) * scale_;
        to.push_back(
            {{static_cast<double>(fan_.apex_column), fan_.apex_row - number(100.0, 300.0) * scale_},
             radius,
             radius});
      }
      return;
    case FrameKind::kTrap: {
      const double share = number(0.45, 0.65);
      const PointPx base{fan_.apex_column + share * way.column, fan_.apex_row + share * way.row};
      const double half = number(50.0, 110.0) * scale_;
      const double arm = number(60.0, 120.0) * scale_;
      const double disc = number(18.0, 26.0) * scale_;
      add_discs(to, {base.column - half, base.row}, {2.0 * half, 0.0}, disc);
      add_discs(to, {base.column - half, base.row}, {0.0, arm}, disc);
      add_discs(to, {base.column + half, base.row}, {0.0, arm}, disc);
      return;
    }
    case FrameKind::kNarrow: return add_wall(to, number(2.0, 8.0));
    case FrameKind::kPocket: {
      some(1, 4);
      const double open = number(0.0, 2.0 * std::numbers::pi);
      return add_arc(to, goal, number(45.0, 75.0) * scale_, open + 0.7,
                     open + 2.0 * std::numbers::pi - 0.7);
    }
    case FrameKind::kNoPath:
      some(2, 5);
      return whole(0, 1) == 0
                 ? add_arc(to, goal, number(20.0, 50.0) * scale_, 0.0, 2.0 * std::numbers::pi)
                 : add_wall(to, 0.0);
  }
}

RandomFrame FrameMaker::make(FrameKind kind) {
  RandomFrame frame;
  frame.kind = kind;
  frame.start = {static_cast<std::int16_t>(fan_.apex_column),
                 static_cast<std::int16_t>(fan_.apex_row)};
  do {
    const double range = number(333.0, 483.0) * scale_;
    const double bearing = kind == FrameKind::kHeadOn ? 0.0 : number(-0.4, 0.4) + number(-0.4, 0.4);
    frame.goal = {
        static_cast<std::int16_t>(std::lround(fan_.apex_column + range * std::sin(bearing))),
        static_cast<std::int16_t>(std::lround(fan_.apex_row - range * std::cos(bearing)))};
    frame.obstacles.clear();
    add_obstacles(frame);
  } while (!fan_.holds(frame.goal.column, frame.goal.row) || covers(frame.obstacles, frame.start) ||
           covers(frame.obstacles, frame.goal));
  return frame;
}

}  // namespace lodesman::testing
