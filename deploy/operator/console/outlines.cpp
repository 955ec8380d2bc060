// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/console/outlines.h"

#include <cmath>
#include <numbers>

namespace lodesman::console {
namespace {

constexpr double kStep_rad = std::numbers::pi / 6.0;  // of a round corner

[[nodiscard]] std::vector<Vertex> ellipse(const Obstacle& o, double first_m, double second_m) {
  std::vector<Vertex> edge;
  for (int i = 0; i < kEllipseCorners; ++i) {
    const double around = 2.0 * std::numbers::pi * i / kEllipseCorners;
    const double along = first_m * std::cos(around);
    const double across = second_m * std::sin(around);
    edge.push_back({o.centre_x_m + along * std::sin(o.angle_rad) + across * std::cos(o.angle_rad),
                    o.centre_y_m + along * std::cos(o.angle_rad) - across * std::sin(o.angle_rad)});
  }
  return edge;
}

// The vertices of a wall, once round it: of one that is open there and back.
[[nodiscard]] std::vector<Vertex> way_round(const Obstacle& o) {
  std::vector<Vertex> way{o.vertices.begin(), o.vertices.begin() + o.vertex_count};
  if (o.shape == ObstacleShape::kPolyline) {
    for (std::uint32_t i = o.vertex_count - 1; i-- > 1;) {
      way.push_back(o.vertices[i]);
    }
    return way;
  }
  double doubled_area = 0.0;
  for (std::size_t i = 0; i < way.size(); ++i) {
    const Vertex& next = way[(i + 1) % way.size()];
    doubled_area += way[i].x_m * next.y_m - next.x_m * way[i].y_m;
  }
  // Clockwise, so that what is to the left of each side is outside.
  if (doubled_area > 0.0) {
    way = {way.rbegin(), way.rend()};
  }
  return way;
}

// So far to the left of the way, round its outer corners.
[[nodiscard]] std::vector<Vertex> left_of(const std::vector<Vertex>& way, double distance_m) {
  std::vector<Vertex> line;
  for (std::size_t i = 0; i < way.size(); ++i) {
    const Vertex& before = way[(i + way.size() - 1) % way.size()];
    const Vertex& here = way[i];
    const Vertex& next = way[(i + 1) % way.size()];
    const double came = std::atan2(here.y_m - before.y_m, here.x_m - before.x_m);
    const double goes = std::atan2(next.y_m - here.y_m, next.x_m - here.x_m);
    double turn = std::remainder(goes - came, 2.0 * std::numbers::pi);
    // About turns, as at the end of a wall, go round the end.
    turn = turn > std::numbers::pi - 1e-9 ? -std::numbers::pi : turn;
    const int steps = turn < 0.0 ? static_cast<int>(std::ceil(-turn / kStep_rad)) : 1;
    for (int k = 0; k <= steps; ++k) {
      const double left = came + turn * k / steps + 0.5 * std::numbers::pi;
      line.push_back(
          {here.x_m + distance_m * std::cos(left), here.y_m + distance_m * std::sin(left)});
    }
  }
  return line;
}

}  // namespace

std::vector<Vertex> outline_of(const Obstacle& o) {
  if (o.shape == ObstacleShape::kEllipse) {
    return ellipse(o, o.semi_axis_first_m, o.semi_axis_second_m);
  }
  return o.vertex_count < 2 ? std::vector<Vertex>{} : way_round(o);
}

std::vector<Vertex> zone_of(const Obstacle& o) {
  if (!(o.protection_first_m > 0.0)) {
    return {};
  }
  if (o.shape == ObstacleShape::kEllipse) {
    return ellipse(o, o.protection_first_m, o.protection_second_m);
  }
  return o.vertex_count < 2 ? std::vector<Vertex>{} : left_of(way_round(o), o.protection_first_m);
}

}  // namespace lodesman::console
