// SPDX-License-Identifier: Apache-2.0
// What comes back in one ping before it is speckled and rounded: what the water sends back at each
// range, and what else there is in each cell. Everything that is heard adds to it; made once and
// drawn anew each ping, by one thread. Levels are of 255, ranges in bins.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "hal_sim/sonar/water_kind.h"

namespace lodesman {

class EchoLevels {
 public:
  explicit EchoLevels(const EchoGrid& grid)
      : grid_{grid},
        cells_(std::size_t{grid.beams} * grid.bins),
        water_(grid.bins),
        ring_(grid.bins),
        shadows_(grid.beams) {}

  // Where in a beam something stands in the way, and what is left of the water behind it.
  struct Shadow {
    std::uint32_t from = 0;
    float left = 1.0F;
  };

  void silence() noexcept {
    std::fill(cells_.begin(), cells_.end(), 0.0F);
    std::fill(ring_.begin(), ring_.end(), 0.0F);
    std::fill(shadows_.begin(), shadows_.end(), Shadow{grid_.bins, 1.0F});
  }

  [[nodiscard]] const EchoGrid& grid() const noexcept { return grid_; }
  [[nodiscard]] std::span<float> beam(std::uint32_t beam) noexcept {
    return {cells_.data() + std::size_t{beam} * grid_.bins, grid_.bins};
  }
  [[nodiscard]] std::span<float> water() noexcept { return water_; }
  // Heard in all beams alike, of what is bright in one.
  [[nodiscard]] std::span<float> ring() noexcept { return ring_; }
  [[nodiscard]] Shadow& shadow(std::uint32_t beam) noexcept { return shadows_[beam]; }

 private:
  EchoGrid grid_;
  std::vector<float> cells_;
  std::vector<float> water_;
  std::vector<float> ring_;
  std::vector<Shadow> shadows_;
};

// Adds a soft patch round a cell, that is gone where it is so many beams or bins off; places may
// lie outside. `level` of a bin tells how bright its middle is there.
template <class Level>
void add_patch(EchoLevels& levels, double beam, double bin, double beams_off, double bins_off,
               Level level) noexcept {
  const EchoGrid& grid = levels.grid();
  const auto begin = [](double from, std::uint32_t count) noexcept {
    return static_cast<std::uint32_t>(std::clamp(from, 0.0, static_cast<double>(count)));
  };
  const auto weight = [](double off) noexcept {
    const double rest = std::max(1.0 - off * off, 0.0);
    return static_cast<float>(rest * rest);
  };
  const std::uint32_t bin_end = begin(bin + bins_off + 1.0, grid.bins);
  const std::uint32_t beam_end = begin(beam + beams_off + 1.0, grid.beams);
  for (std::uint32_t i = begin(beam - beams_off, grid.beams); i < beam_end; ++i) {
    const float of_beam = weight((i + 0.5 - beam) / beams_off);
    const std::span<float> cells = levels.beam(i);
    for (std::uint32_t k = begin(bin - bins_off, grid.bins); k < bin_end; ++k) {
      cells[k] += of_beam * weight((k + 0.5 - bin) / bins_off) * level(k);
    }
  }
}

}  // namespace lodesman
