// SPDX-License-Identifier: Apache-2.0
#include "tests/unit/path/tangent_check.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/catch.h"

namespace lodesman::testing {
namespace {

bool ellipse_holds(const EllipsePx& e, PointPx p) {
  const double theta = std::atan2(e.sin_theta, e.cos_theta);
  const double bearing = std::atan2(p.row - e.centre.row, p.column - e.centre.column) - theta;
  const double off = std::hypot(p.row - e.centre.row, p.column - e.centre.column);
  const double edge = e.a * e.b / std::hypot(e.b * std::cos(bearing), e.a * std::sin(bearing));
  return off < edge - 1e-7;
}

// The distance to a line falls and then rises along it.
double nearest_by_thirds(const CapsulePx& edge, PointPx p) {
  const auto distance = [&edge, p](double t) {
    return std::hypot(p.column - edge.from.column - t * (edge.to.column - edge.from.column),
                      p.row - edge.from.row - t * (edge.to.row - edge.from.row));
  };
  double low = 0.0;
  double high = 1.0;
  for (int i = 0; i < 80; ++i) {
    const double third = (high - low) / 3.0;
    if (distance(low + third) < distance(high - third)) {
      high -= third;
    } else {
      low += third;
    }
  }
  return std::min({distance(low), distance(0.0), distance(1.0)});
}

bool wall_holds(const WallPx& wall, PointPx p) {
  double turned = 0.0;
  for (std::uint32_t i = 0; i < wall.edge_count(); ++i) {
    const CapsulePx edge = wall.edge(i);
    if (nearest_by_thirds(edge, p) < edge.radius - 1e-7) {
      return true;
    }
    const double from = std::atan2(edge.from.row - p.row, edge.from.column - p.column);
    const double to = std::atan2(edge.to.row - p.row, edge.to.column - p.column);
    turned += std::remainder(to - from, 2.0 * std::numbers::pi);
  }
  return wall.closed && std::abs(turned) > std::numbers::pi;
}

}  // namespace

EllipsePx disc_px(double column, double row, double radius) {
  return {{column, row}, radius, radius, 1.0, 0.0};
}

WallPx wall_px(std::initializer_list<PointPx> vertices, double radius, bool closed) {
  WallPx wall;
  wall.vertex_count = static_cast<std::uint32_t>(vertices.size());
  std::copy(vertices.begin(), vertices.end(), wall.vertices.begin());
  wall.radius = radius;
  wall.closed = closed;
  return wall;
}

bool holds_point(const ZonePx& zone, PointPx point) {
  const auto* ellipse = std::get_if<EllipsePx>(&zone);
  return ellipse != nullptr ? ellipse_holds(*ellipse, point)
                            : wall_holds(std::get<WallPx>(zone), point);
}

void require_sound(const TangentResult& result, std::span<const ZonePx> zones,
                   const RegionPx& region, PointPx start, PointPx goal) {
  REQUIRE(result.reason == PathReason::kFound);
  REQUIRE(result.path.size() >= 2);
  const auto same_point = [](PointPx a, PointPx b) {
    return std::hypot(a.column - b.column, a.row - b.row) <= 0.0;
  };
  REQUIRE(same_point(result.path.front(), start));
  REQUIRE(same_point(result.path.back(), goal));
  double length = 0.0;
  for (std::size_t i = 1; i < result.path.size(); ++i) {
    const PointPx from = result.path[i - 1];
    const PointPx to = result.path[i];
    CAPTURE(from.column, from.row, to.column, to.row);
    REQUIRE(region.contains(to));
    const double step = std::hypot(to.column - from.column, to.row - from.row);
    length += step;
    const BoxPx box = box_of(from, to);
    for (const ZonePx& zone : zones) {
      REQUIRE_FALSE(touches(zone, from, to));
      const bool wall = std::holds_alternative<WallPx>(zone);
      const int samples = static_cast<int>(step * (wall ? 0.5 : 4.0)) + 1;
      bool clear = true;
      for (int k = 0; k <= samples && (wall || box_of(zone).meets(box)); ++k) {
        const double t = static_cast<double>(k) / samples;
        clear = clear && !holds_point(zone, {from.column + t * (to.column - from.column),
                                             from.row + t * (to.row - from.row)});
      }
      REQUIRE(clear);
    }
  }
  REQUIRE(length == Approx(result.length_px).margin(1e-9));
}

Zones grown_by_polygons(std::span<const ZonePx> zones) {
  constexpr double kMore = 1.5 * (kOvershootPx + kClearancePx);
  // inscribed_bound() has a corner at least every pi/31 of a turn.
  const double scale = 1.0 / std::cos(std::numbers::pi / 62.0);
  Zones grown{zones.begin(), zones.end()};
  for (ZonePx& zone : grown) {
    if (auto* ellipse = std::get_if<EllipsePx>(&zone)) {
      ellipse->a = (ellipse->a + kMore) * scale;
      ellipse->b = (ellipse->b + kMore) * scale;
    } else {
      auto& wall = std::get<WallPx>(zone);
      wall.radius = (wall.radius + kMore) * scale;
    }
  }
  return grown;
}

}  // namespace lodesman::testing
