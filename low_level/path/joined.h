// SPDX-License-Identifier: Apache-2.0
// Whether any path joins two pixels at all, at a cost that does not depend on how the map winds.
// Owned by one thread; it allocates when made and never after.
#pragma once

#include <cstdint>
#include <vector>

#include "low_level/path/bit_lines.h"

namespace lodesman {

// Rows are cut into runs of free pixels, and runs of neighbouring rows that touch are put into one
// set. A diagonal step needs both pixels beside it, so what 8 neighbours join, 4 do.
class Joined {
 public:
  // For bitmaps of this shape.
  Joined(int lines, int length);

  // Both places must be free.
  [[nodiscard]] bool joined(const BitLines& lines, int line_a, int place_a, int line_b,
                            int place_b) noexcept;

 private:
  struct Run {
    std::int32_t first = 0;
    std::int32_t last = 0;
    std::int32_t parent = 0;
  };
  [[nodiscard]] std::int32_t root_of(std::int32_t run) noexcept;
  void join(std::int32_t a, std::int32_t b) noexcept;
  [[nodiscard]] std::int32_t cut(const BitLines& lines, int line, std::int32_t count) noexcept;

  std::vector<Run> runs_;
};

}  // namespace lodesman
