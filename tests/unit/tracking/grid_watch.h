// SPDX-License-Identifier: Apache-2.0
// A boat whose sonar fills an evidence grid, and shapes for it to see. Tests
// only; one thread.
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "low_level/tracking/evidence_grid.h"

namespace lodesman::testing {

using Place = Eigen::Vector2d;

inline constexpr double kGridPing_s = 0.1;
inline constexpr std::size_t kFanBeams = 120;

// A boat in the odometry frame, whose sonar sees 120 degrees ahead.
class GridWatch {
 public:
  EvidenceGrid& grid() { return *grid_; }
  void go_to(double x_m, double y_m, double heading_deg = 0.0) {
    look_.pose.p_WV.xy_m = {x_m, y_m};
    look_.pose.heading = Heading::clockwise_from_y_rad(to_rad(heading_deg));
  }
  // As far as that in each beam.
  void see(double clear_m, int pings = 1) {
    std::fill(clear_m_.begin(), clear_m_.end(), static_cast<float>(clear_m));
    see_beams(pings);
  }
  void see_beams(int pings = 1) {
    for (int i = 0; i < pings; ++i) {
      look_.at_s += kGridPing_s;
      grid_->look(look_);
    }
  }
  void hit(const Obstacle& shape) { grid_->add(shape, look_.at_s); }
  WaterState at(double x_m, double y_m) const { return grid_->state({x_m, y_m}); }

  Look& look() { return look_; }
  std::vector<float>& clear_m() { return clear_m_; }

 private:
  std::unique_ptr<EvidenceGrid> grid_ = std::make_unique<EvidenceGrid>();
  std::vector<float> clear_m_ = std::vector<float>(kFanBeams, 30.0F);
  Look look_{.pose = {},
             .at_s = 1e9,
             .first_bearing_rad = to_rad(-59.5),
             .beam_step_rad = to_rad(1.0),
             .nearest_m = 0.5,
             .farthest_m = 30.0,
             .clear_m = clear_m_};
};

inline Obstacle stone_at(double x_m, double y_m, double radius_m) {
  Obstacle o;
  o.centre_x_m = x_m;
  o.centre_y_m = y_m;
  o.semi_axis_first_m = o.semi_axis_second_m = radius_m;
  return o;
}

inline Obstacle polygon_of(const std::vector<Vertex>& corners) {
  Obstacle o;
  o.shape = ObstacleShape::kPolygon;
  o.vertex_count = static_cast<std::uint32_t>(corners.size());
  std::copy(corners.begin(), corners.end(), o.vertices.begin());
  return o;
}

inline Obstacle box_between(double west_m, double south_m, double east_m, double north_m) {
  return polygon_of({{west_m, south_m}, {east_m, south_m}, {east_m, north_m}, {west_m, north_m}});
}

// From a to b, so wide.
inline Obstacle strip_along(const Place& a, const Place& b, double wide_m) {
  const Place way = (b - a).normalized();
  const Place off = 0.5 * wide_m * Place{way.y(), -way.x()};
  std::vector<Vertex> corners;
  for (const Place& p : {Place{a + off}, Place{b + off}, Place{b - off}, Place{a - off}}) {
    corners.push_back({p.x(), p.y()});
  }
  return polygon_of(corners);
}

inline std::vector<Place> occupied_places(const EvidenceGrid& grid) {
  std::vector<Place> out;
  for (int row = grid.first_row(); row < grid.first_row() + EvidenceGrid::kSide; ++row) {
    for (int column = grid.first_column(); column < grid.first_column() + EvidenceGrid::kSide;
         ++column) {
      const Place p = Place{column + 0.5, row + 0.5} * EvidenceGrid::kCell_m;
      if (grid.state(p) == WaterState::kOccupied) {
        out.push_back(p);
      }
    }
  }
  return out;
}

}  // namespace lodesman::testing
