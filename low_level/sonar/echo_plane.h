// SPDX-License-Identifier: Apache-2.0
// An image ping in cells of about a degree, smoothed along and across its beams: what echoes are
// told from the background in. One thread; allocates when made and never after.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mid_level/messages/sonar.h"

namespace lodesman {

// Beams and bins are joined from twice so many on, so that cells number less than that.
inline constexpr std::uint32_t kPlaneBeams = 120;
inline constexpr std::uint32_t kPlaneBins = 480;
// Smoothing takes so many cells together: wide enough to calm speckle, no wider than a target.
inline constexpr std::uint32_t kSmoothBeams = 3;
inline constexpr std::uint32_t kSmoothBins = 7;

// Which beams and bins of a ping one cell is made of.
struct PlaneLayout {
  std::uint32_t beams = 0;          // [-] cells across
  std::uint32_t bins = 0;           // [-] cells along
  std::uint32_t beams_of_cell = 1;  // [-]
  std::uint32_t bins_of_cell = 1;   // [-]
  double scale = 1.0;  // a smoothed cell over the mean echo [0, 255] of what it is made of

  // Bins that do not fill a cell at the far edge are left out.
  void set(const SonarPing& ping) noexcept;
  // The last cell across is filled up with beams of the one before it.
  [[nodiscard]] std::uint32_t first_beam(std::uint32_t cell, std::uint32_t of_beams) const noexcept;
};

class EchoPlane {
 public:
  static constexpr std::size_t kMaxAcross = 2 * kPlaneBeams;
  static constexpr std::size_t kMaxAlong = 1024;

  EchoPlane();

  // An image ping whose numbers were checked.
  void set(const SonarPing& ping) noexcept;
  [[nodiscard]] const PlaneLayout& layout() const noexcept { return layout_; }

  // Smoothed along the beam only, and both ways.
  [[nodiscard]] std::span<const std::int16_t> along(std::uint32_t beam) const noexcept {
    return row(along_, beam);
  }
  [[nodiscard]] std::span<const std::int16_t> smooth(std::uint32_t beam) const noexcept {
    return row(smooth_, beam);
  }
  // For what is mended in one beam; ends with smooth_across().
  [[nodiscard]] std::span<std::int16_t> mend(std::uint32_t beam) noexcept {
    return {along_.data() + beam * kMaxAlong, layout_.bins};
  }
  void smooth_across() noexcept;

 private:
  [[nodiscard]] std::span<const std::int16_t> row(const std::vector<std::int16_t>& cells,
                                                  std::uint32_t beam) const noexcept {
    return {cells.data() + beam * kMaxAlong, layout_.bins};
  }
  void gather(const SonarPing& ping, std::uint32_t cell) noexcept;
  void smooth_along(std::uint32_t cell) noexcept;

  PlaneLayout layout_;
  std::uint32_t shift_ = 0;             // [bit] that a cell's sum is made smaller by, to fit
  std::vector<std::int16_t> gathered_;  // one beam of cells, with what lies beyond its ends
  std::vector<std::int16_t> along_;
  std::vector<std::int16_t> smooth_;
};

}  // namespace lodesman
