// SPDX-License-Identifier: Apache-2.0
// Sonar views made up at random, of the kinds that a path finder finds easy and hard: for tests and
// benches. One thread.
#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <string_view>
#include <vector>

#include "low_level/path/grid.h"
#include "low_level/path/zone.h"
#include "mid_level/geometry/sonar_view.h"
#include "mid_level/messages/path.h"

namespace lodesman::testing {

enum class FrameKind : std::uint8_t {
  kOpen,     // one or two obstacles
  kHeadOn,   // obstacles on the straight line to a goal right ahead
  kMulti,    // three to seven
  kClutter,  // eight to twelve
  kTrap,     // a U, open towards the boat, and the goal behind it
  kNarrow,   // a wall of discs across the view with a gap of 2 to 8 pixels
  kPocket,   // the goal in a C
  kNoPath,   // the goal in a ring, or the whole view walled off
};
inline constexpr std::array<std::string_view, 8> kFrameKindNames{
    "open", "head-on", "multi", "clutter", "U", "narrow", "pocket", "no-path"};

struct RandomFrame {
  FrameKind kind = FrameKind::kOpen;
  PathPixel start;
  PathPixel goal;
  std::vector<EllipsePx> obstacles;

  void draw(PassableGrid& grid) const noexcept {
    grid.clear();
    for (const EllipsePx& obstacle : obstacles) {
      grid.block(obstacle);
    }
  }
};

class FrameMaker {
 public:
  // Sizes are of the sonar's own fan, and grow with the radius of `fan`. Obstacles come in
  // `times` as large a number and smaller, so that they cover as much.
  explicit FrameMaker(std::uint32_t seed, const FanShape& fan = {}, int times = 1);

  // Start and goal are free; whether a path joins them is not known but of kNoPath.
  [[nodiscard]] RandomFrame make(FrameKind kind);

 private:
  [[nodiscard]] double number(double low, double high);
  [[nodiscard]] int whole(int low, int high);
  [[nodiscard]] EllipsePx ellipse(PathPixel goal);
  void add_discs(std::vector<EllipsePx>& to, PointPx from, PointPx along, double radius);
  void add_arc(std::vector<EllipsePx>& to, PointPx centre, double radius, double from_rad,
               double to_rad);
  void add_wall(std::vector<EllipsePx>& to, double gap);
  void add_obstacles(RandomFrame& frame);

  std::mt19937 random_;
  FanShape fan_;
  int times_;
  double scale_;
};

}  // namespace lodesman::testing
