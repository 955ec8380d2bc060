// SPDX-License-Identifier: Apache-2.0
// Answers a PathRequest in the world: zones, start and goal in metres in, a line out. It keeps to
// the sides that the request asks for unless another way is shorter by the stated gain, and lets
// zones give what they may where there is no way otherwise. Nothing is remembered from one request
// to the next. Owned by one thread; it allocates when made and never after.
#pragma once

#include <array>
#include <cstdint>

#include "low_level/path/tangent_path.h"
#include "mid_level/messages/path.h"

namespace lodesman {

class WorldPathFinder {
 public:
  // Of one search, and a plan is three searches at most. Tens are usual; where 64 walls of 32
  // vertices take more than this, a search would last longer than a plan may, and ends as kLimit:
  // no line, and who asked keeps what it has.
  static constexpr std::uint32_t kMaxTried = 4096;

  // Fills all that concerns a path in the world, and the reason. kNoPath: the line leads to the
  // point nearest to the goal that was found.
  void find_path(const PathRequest& request, SonarPath& out) noexcept;

 private:
  // give: all zones as narrow as they may be.
  void draw(const PathRequest& request, bool give) noexcept;
  [[nodiscard]] TangentResult search(const PathRequest& request, bool keep_sides) noexcept;
  void take(const PathRequest& request, const TangentResult& result, SonarPath& out) noexcept;

  TangentPath tangents_{TangentLimits{.max_tried = kMaxTried}};
  std::array<ZonePx, kMaxObstacles> zones_{};
  std::array<BendSides, kMaxObstacles> sides_{};
  std::size_t zone_count_ = 0;
};

}  // namespace lodesman
