// SPDX-License-Identifier: Apache-2.0
// What the echoes of image pings look like, in numbers: the same for simulated and for real ones.
// Bins and beams are cells of the ping. Pure functions that allocate; tests and measures only.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mid_level/messages/obstacle.h"
#include "mid_level/messages/sonar.h"

namespace lodesman::testing {

// The value that a share of all lie below; 0 of none.
[[nodiscard]] double quantile(std::vector<double> values, double share);
[[nodiscard]] inline double median(std::vector<double> values) {
  return quantile(std::move(values), 0.5);
}

// Over all beams, a bin.
[[nodiscard]] std::vector<double> range_medians(const SonarPing& ping);
// The median of those between two shares of the range.
[[nodiscard]] double background(const SonarPing& ping, double from, double to);

// Of cells without echoes, against the mean of 25 bins by 15 beams round them.
struct Speckle {
  double variation = 0.0;          // [-] coefficient
  std::array<double, 3> along{};   // correlation of cells 1, 2 and 4 bins apart
  std::array<double, 2> across{};  // and 1 and 2 beams apart
};
[[nodiscard]] Speckle speckle_of(const SonarPing& ping);

// Of each range at which something is brighter than 120: how much the median of the beams lies
// above the water of ranges near by, as a share of how much the brightest does.
[[nodiscard]] std::vector<double> ring_shares(const SonarPing& ping);

// A piece of a wall of about 1.5 m: its mean over 3 beams where it is brightest within 6 bins, in
// times the median of the ranges there.
struct WallPiece {
  double incidence_rad = 0.0;  // 0: a beam stands square on it
  double contrast = 0.0;
};
// In the vehicle frame. Pieces outside the fan, or near its edges, are left out.
[[nodiscard]] std::vector<WallPiece> wall_pieces(const SonarPing& ping,
                                                 const std::vector<Vertex>& wall);

// The echoes of the cells for which `is_inside(beam, bin)`.
template <class IsInside>
[[nodiscard]] std::vector<double> echoes_inside(const SonarPing& ping, IsInside is_inside) {
  std::vector<double> echoes;
  for (std::uint32_t beam = 0; beam < ping.beams; ++beam) {
    for (std::uint32_t bin = 0; bin < ping.bins; ++bin) {
      if (is_inside(beam, bin)) {
        echoes.push_back(ping.echo[std::size_t{beam} * ping.bins + bin]);
      }
    }
  }
  return echoes;
}

}  // namespace lodesman::testing
