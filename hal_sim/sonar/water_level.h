// SPDX-License-Identifier: Apache-2.0
// How bright water without anything in it is at each range: the head's own ring-down, the haze
// before it, noise that grows with range, and where surface and bottom are first heard. One thread;
// allocates when made and never after.
#pragma once

#include <span>
#include <vector>

#include "hal_sim/sonar/water_kind.h"
#include "mid_level/base/random_stream.h"

namespace lodesman {

class WaterLevel {
 public:
  // Depths of surface and bottom are drawn here, and drift from ping to ping.
  WaterLevel(const WaterKind& kind, const EchoGrid& grid, RandomStream& chance);

  // One level a bin of the grid.
  void draw(std::span<float> water, RandomStream& chance) noexcept;

 private:
  WaterKind kind_;
  EchoGrid grid_;
  double bottom_;             // [-] of the range, where it is first heard
  double surface_;            // [-] of the range
  std::vector<float> still_;  // [-] a bin: without surface and bottom
};

}  // namespace lodesman
