// SPDX-License-Identifier: Apache-2.0
// A line with fewer corners, for shapes that hold only so many. A pure function on caller-owned
// memory, which allocates nothing; any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "mid_level/messages/obstacle.h"
#include "mid_level/messages/sonar.h"

namespace lodesman {

// One a beam, and two ends.
inline constexpr std::size_t kMostLinePoints = kMaxBeams + 2;

// In place, ends kept; gives how many are left: at most `most`, which is at least 2. What is left
// out lies within the tolerance of what is left, or within one that is as much larger as it has to
// be. The line has from one to kMostLinePoints points.
[[nodiscard]] std::uint32_t thin_out(std::span<Vertex> line, double tolerance_m,
                                     std::uint32_t most) noexcept;

}  // namespace lodesman
