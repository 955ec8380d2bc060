// SPDX-License-Identifier: Apache-2.0
// OMPL's RRTConnect on the bitmap as a plane, with its own defaults, up to its first path: another
// task than ours, for its paths are of any direction and not the shortest. One thread.
#pragma once

#include <memory>

#include "low_level/path/grid.h"

namespace lodesman::bench {

class OmplRrtConnect {
 public:
  // It gives up on a frame after this.
  static constexpr double kTimeBoxS = 0.02;

  // Null where the bench was built without OMPL.
  [[nodiscard]] static std::unique_ptr<OmplRrtConnect> make(const PassableGrid& grid);

  virtual ~OmplRrtConnect() = default;
  // Whether it found a path in time.
  [[nodiscard]] virtual bool search(PathPixel start, PathPixel goal) = 0;
};

}  // namespace lodesman::bench
