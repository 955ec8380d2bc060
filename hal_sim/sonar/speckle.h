// SPDX-License-Identifier: Apache-2.0
// Speckle: by what each cell of a ping differs from what its place sends back on average. A field
// larger than a ping is made once, and each ping looks at another part of it. One thread; allocates
// when made and never after.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mid_level/base/random_stream.h"

namespace lodesman {

// Of mean 1, Weibull distributed and correlated with its neighbours as measured, in cells of the
// grid, whatever they measure.
class SpeckleField {
 public:
  SpeckleField(std::uint32_t beams, std::uint32_t bins, RandomStream& chance);

  // The next ping looks at a part of the field that `chance` chooses.
  void choose_part(RandomStream& chance) noexcept;
  [[nodiscard]] std::span<const float> beam(std::uint32_t beam) const noexcept;

 private:
  std::uint32_t beams_;
  std::uint32_t bins_;
  std::uint32_t width_;  // [cell] of a row of the field, along a beam
  std::uint32_t first_beam_ = 0;
  std::uint32_t first_bin_ = 0;
  bool mirrored_ = false;  // left is right: twice as many parts
  std::vector<float> field_;
};

}  // namespace lodesman
