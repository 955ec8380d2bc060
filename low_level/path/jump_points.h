// SPDX-License-Identifier: Apache-2.0
// The jump points that a search has reached, and from which other ones it came to each. Owned by
// one thread; it allocates when made and never after.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "low_level/path/pixel_steps.h"
#include "mid_level/messages/path.h"

namespace lodesman {

// A pixel from which a search runs out, or the goal.
struct JumpPoint {
  PathPixel pixel;
  std::int32_t cost = std::numeric_limits<std::int32_t>::max();  // to the goal
  // How far each of its diagonals has been found free, by direction / 2.
  std::array<std::int16_t, 4> reach{};
  std::int32_t came_from = -1;  // the first of its arrivals
  std::uint8_t todo = 0;        // directions to run out along: a bit a direction of kSteps
  std::uint8_t done = 0;
  std::int32_t next = -1;    // with the same hash
  std::uint32_t looked = 0;  // when the walk last considered it; 0 is never
};

class JumpPoints {
 public:
  static constexpr std::int32_t kNone = -1;

  // One cheapest run that came to a jump point, or to the start.
  struct Arrival {
    std::int32_t from = kNone;  // the jump point that it ran out from
    std::int32_t next = kNone;  // another one to the same
  };

  // With room for so many jump points, and as many arrivals.
  explicit JumpPoints(std::size_t capacity);

  void clear() noexcept;
  [[nodiscard]] std::int32_t count() const noexcept { return count_; }
  // `i` is one that at() has given since clear().
  [[nodiscard]] JumpPoint& operator[](std::int32_t i) noexcept { return points_.data()[i]; }
  [[nodiscard]] const JumpPoint& operator[](std::int32_t i) const noexcept {
    return points_.data()[i];
  }
  // The one of a pixel, which is made where there is none.
  [[nodiscard]] std::int32_t at(PathPixel pixel) noexcept;
  // Puts an arrival before others, of which `first` is the first. False where there is no room
  // left.
  [[nodiscard]] bool arrive(std::int32_t from, std::int32_t& first) noexcept;
  [[nodiscard]] const Arrival& arrival(std::int32_t i) const noexcept {
    return arrivals_.data()[i];
  }

 private:
  std::vector<JumpPoint> points_;
  std::int32_t count_ = 0;
  std::vector<std::int32_t> hash_heads_;  // of chains of points; of this search if the point fits
  std::vector<Arrival> arrivals_;
  std::int32_t arrival_count_ = 0;
};

}  // namespace lodesman
