// SPDX-License-Identifier: Apache-2.0
// A blob's ellipse from its area-weighted moments: the shape that section 5 of the paper gives an
// obstacle. Pure functions on caller-owned memory, which allocate nothing; any thread.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "mid_level/messages/sonar.h"

namespace lodesman {

// Where the bins of one ping lie in the vehicle frame. Filled once a ping, so that no bin needs a
// sine of its own.
struct PolarGrid {
  std::uint32_t bins = 0;                  // [-] of a beam: cell = beam * bins + bin
  double bin_depth_m = 0.0;                // [m] of one bin along its beam
  double echo_depth_m = 0.0;               // [m] over which what a bin stands for is spread
  double beam_width_rad = 0.0;             // [rad] from one beam to the next
  std::array<double, kMaxBeams> sine{};    // [-] of each beam's bearing
  std::array<double, kMaxBeams> cosine{};  // [-]

  // With so many bins of range, whatever the ping itself has.
  void set(const SonarPing& ping, std::uint32_t bins_of_range) noexcept;
  struct Place {
    double range_m;  // [m]
    double sine;     // [-] of the bearing
    double cosine;   // [-]
    [[nodiscard]] double x_m() const noexcept { return range_m * sine; }
    [[nodiscard]] double y_m() const noexcept { return range_m * cosine; }
  };
  [[nodiscard]] Place place(std::uint32_t cell) const noexcept {
    const std::uint32_t beam = cell / bins;
    return {(cell - beam * bins + 0.5) * bin_depth_m, sine[beam], cosine[beam]};
  }
};

struct BlobEllipse {
  double centre_x_m = 0.0;  // [m] [vehicle]
  double centre_y_m = 0.0;  // [m] [vehicle]
  double first_m = 0.0;     // [m] the longer semi-axis
  double second_m = 0.0;    // [m] the shorter one
  double axis_x = 0.0;      // [-] unit vector along the longer one
  double axis_y = 1.0;      // [-]
  double nearest_m = 0.0;   // [m] range of the blob's nearest bin
  double fill = 0.0;        // [-] the blob's area over the ellipse's
};

// The ellipse with the cells' centroid and area-weighted variances; its semi-axes are two standard
// deviations, which is exact for a filled ellipse. A cell weighs its area, which grows with range,
// and has its own width and depth, so that one cell gives an ellipse of its own size. `cells`
// holds at least one. Leaves `fill` and `nearest_m` for enclose().
[[nodiscard]] BlobEllipse moment_ellipse(const PolarGrid& grid,
                                         std::span<const std::uint32_t> cells) noexcept;

// The same ellipse, grown (never shrunk) until it holds `fraction` in [0.5, 0.99] of the cells'
// area.
[[nodiscard]] BlobEllipse enclose(const PolarGrid& grid, std::span<const std::uint32_t> cells,
                                  const BlobEllipse& moments, double fraction) noexcept;

// Makes an obstacle of it: neither zone nor peak.
void put_ellipse(const BlobEllipse& ellipse, Obstacle& out) noexcept;

// Reorders the cells into those behind and those ahead of the middle of the blob's extent along
// the ellipse's longer axis, and gives the number of the first kind.
[[nodiscard]] std::size_t split_across(const PolarGrid& grid, std::span<std::uint32_t> cells,
                                       const BlobEllipse& ellipse) noexcept;

}  // namespace lodesman
