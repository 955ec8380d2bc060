// SPDX-License-Identifier: Apache-2.0
// How bright a cell must be to be an echo, range by range, learnt from the ping itself: whatever is
// as bright in most beams is the water, the bottom or a ring of side lobes. Every level is a ratio,
// so that no sonar's own scale matters. One thread; allocates when made and never after.
#pragma once

#include <array>
#include <cstdint>

#include "low_level/sonar/echo_plane.h"
#include "low_level/sonar/segmentation_options.h"

namespace lodesman {

struct RangeLevels {
  using Levels = std::array<std::int16_t, EchoPlane::kMaxAlong>;
  Levels background{};
  Levels weak{};
  Levels seed{};
  double needed_excess = 0.0;  // [-] of a cell that may belong to an echo

  // Of a plane that has cells. `sector_rad` is the ping's.
  void learn(const EchoPlane& plane, const ContrastOptions& options, double sector_rad) noexcept;

 private:
  void take_medians(const EchoPlane& plane) noexcept;
  [[nodiscard]] double variation(const EchoPlane& plane, double least) noexcept;
  void take_brightest(const EchoPlane& plane) noexcept;
  void calm(std::uint32_t bins, double most_rise, double least) noexcept;

  Levels brightest_{};
  std::array<float, EchoPlane::kMaxAlong> calm_{};
};

}  // namespace lodesman
