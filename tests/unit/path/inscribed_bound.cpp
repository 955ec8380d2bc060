// SPDX-License-Identifier: Apache-2.0
#include "tests/unit/path/inscribed_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace lodesman::testing {
namespace {

constexpr int kCorners = 64;
// Touching a polygon by less than this is passing it. [px]
constexpr double kTouch = 1e-7;

struct Polygon {
  std::vector<PointPx> corners;  // from +column to +row
  BoxPx box;
};

struct Place {
  PointPx at;
  int polygon = -1;  // start and goal: none
  int corner = 0;
};

double cross(PointPx o, PointPx a, PointPx b) {
  return (a.column - o.column) * (b.row - o.row) - (a.row - o.row) * (b.column - o.column);
}

double distance(PointPx a, PointPx b) { return std::hypot(a.column - b.column, a.row - b.row); }

Polygon polygon_of(std::vector<PointPx> corners) {
  Polygon polygon{std::move(corners), {}};
  polygon.box = {polygon.corners[0], polygon.corners[0]};
  for (const PointPx& c : polygon.corners) {
    polygon.box.low = {std::min(polygon.box.low.column, c.column),
                       std::min(polygon.box.low.row, c.row)};
    polygon.box.high = {std::max(polygon.box.high.column, c.column),
                        std::max(polygon.box.high.row, c.row)};
  }
  return polygon;
}

Polygon polygon_of(const EllipsePx& e) {
  std::vector<PointPx> corners;
  for (int k = 0; k < kCorners; ++k) {
    const double t = 2.0 * std::numbers::pi * k / kCorners;
    const double u = e.a * std::cos(t);
    const double v = e.b * std::sin(t);
    corners.push_back({e.centre.column + u * e.cos_theta - v * e.sin_theta,
                       e.centre.row + u * e.sin_theta + v * e.cos_theta});
  }
  return polygon_of(std::move(corners));
}

// Half a disc beyond `to`, and half a disc beyond `from`.
Polygon polygon_of(const CapsulePx& capsule) {
  const double heading =
      std::atan2(capsule.to.row - capsule.from.row, capsule.to.column - capsule.from.column);
  std::vector<PointPx> corners;
  for (int k = 0; k < kCorners; ++k) {
    const int half = kCorners / 2;
    const double share = static_cast<double>(k % half) / (half - 1) - 0.5;
    const double t = heading + std::numbers::pi * (share + (k < half ? 0.0 : 1.0));
    const PointPx centre = k < half ? capsule.to : capsule.from;
    corners.push_back(
        {centre.column + capsule.radius * std::cos(t), centre.row + capsule.radius * std::sin(t)});
  }
  return polygon_of(std::move(corners));
}

std::vector<Polygon> polygons_of(std::span<const ZonePx> zones) {
  std::vector<Polygon> polygons;
  for (const ZonePx& zone : zones) {
    if (const auto* ellipse = std::get_if<EllipsePx>(&zone)) {
      polygons.push_back(polygon_of(*ellipse));
    } else if (const auto* wall = std::get_if<WallPx>(&zone)) {
      for (std::uint32_t i = 0; i < wall->edge_count(); ++i) {
        polygons.push_back(polygon_of(wall->edge(i)));
      }
    }
  }
  return polygons;
}

// Whether more than kTouch of a segment lies deeper than kTouch in the polygon.
bool goes_through(const Polygon& polygon, PointPx from, PointPx to) {
  const double length = distance(from, to);
  double enters = 0.0;
  double leaves = 1.0;
  for (std::size_t k = 0; k < polygon.corners.size(); ++k) {
    const PointPx a = polygon.corners[k];
    const PointPx b = polygon.corners[(k + 1) % polygon.corners.size()];
    const double side = distance(a, b);
    if (side < kTouch) {
      continue;  // where the halves of a disc meet
    }
    const double from_depth = cross(a, b, from) - kTouch * side;
    const double to_depth = cross(a, b, to) - kTouch * side;
    if (from_depth <= 0.0 && to_depth <= 0.0) {
      return false;
    }
    if (from_depth < 0.0) {
      enters = std::max(enters, from_depth / (from_depth - to_depth));
    } else if (to_depth < 0.0) {
      leaves = std::min(leaves, from_depth / (from_depth - to_depth));
    }
  }
  return (leaves - enters) * length > kTouch;
}

class Graph {
 public:
  Graph(std::vector<Polygon> polygons, const RegionPx& region, PointPx start, PointPx goal)
      : polygons_{std::move(polygons)}, places_{{start, -1, 0}, {goal, -1, 0}} {
    for (int p = 0; p < static_cast<int>(polygons_.size()); ++p) {
      for (int k = 0; k < kCorners; ++k) {
        const PointPx at = corner(p, k);
        if (region.contains(at)) {
          places_.push_back({at, p, k});
        }
      }
    }
  }

  // Dijkstra over all pairs of places, without a heap.
  [[nodiscard]] std::optional<double> shortest() const {
    constexpr double kFar = std::numeric_limits<double>::infinity();
    std::vector<double> length(places_.size(), kFar);
    std::vector<bool> done(places_.size(), false);
    length[0] = 0.0;
    for (;;) {
      std::size_t next = places_.size();
      for (std::size_t i = 0; i < places_.size(); ++i) {
        if (!done[i] && length[i] < (next < places_.size() ? length[next] : kFar)) {
          next = i;
        }
      }
      if (next == places_.size()) {
        return std::nullopt;
      }
      if (next == 1) {
        return length[1];
      }
      done[next] = true;
      for (std::size_t i = 0; i < places_.size(); ++i) {
        const double whole = length[next] + distance(places_[next].at, places_[i].at);
        if (!done[i] && whole < length[i] && joined(places_[next], places_[i])) {
          length[i] = whole;
        }
      }
    }
  }

 private:
  [[nodiscard]] PointPx corner(int polygon, int k) const {
    return polygons_[static_cast<std::size_t>(polygon)]
        .corners[static_cast<std::size_t>((k + kCorners) % kCorners)];
  }
  // A shortest path has the polygon of a corner on one side of its line there.
  [[nodiscard]] bool supports(const Place& place, PointPx other) const {
    if (place.polygon < 0) {
      return true;
    }
    const double next = cross(place.at, other, corner(place.polygon, place.corner + 1));
    const double previous = cross(place.at, other, corner(place.polygon, place.corner - 1));
    const double slack = 1e-9 * distance(place.at, other);
    return (next >= -slack && previous >= -slack) || (next <= slack && previous <= slack);
  }
  [[nodiscard]] bool joined(const Place& a, const Place& b) const {
    if (!supports(a, b.at) || !supports(b, a.at)) {
      return false;
    }
    const BoxPx box = box_of(a.at, b.at);
    return std::none_of(polygons_.begin(), polygons_.end(), [&](const Polygon& polygon) {
      return polygon.box.meets(box) && goes_through(polygon, a.at, b.at);
    });
  }

  std::vector<Polygon> polygons_;
  std::vector<Place> places_;
};

}  // namespace

std::optional<double> inscribed_bound(std::span<const ZonePx> zones, const RegionPx& region,
                                      PointPx start, PointPx goal) {
  return Graph{polygons_of(zones), region, start, goal}.shortest();
}

}  // namespace lodesman::testing
