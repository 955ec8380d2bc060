// SPDX-License-Identifier: Apache-2.0
// Water as a sonar hears it, for tests: a background that grows with range, under speckle that is
// anew in each ping. Seeded; one thread.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>

#include "mid_level/messages/sonar.h"

namespace lodesman::testing {

class SpeckledWater {
 public:
  explicit SpeckledWater(std::uint32_t seed = 1) : random_{seed} {
    std::uniform_real_distribution<double> chance{1e-6, 1.0};
    for (double& speckle : speckles_) {
      speckle = std::pow(-std::log(chance(random_)), 1.0 / kShape) / kMean;
    }
  }

  double near_level = 3.0;  // of 255, at the head
  double far_level = 9.0;   // of 255, at the end of the range
  // Times the background, of a beam.
  std::array<double, kMaxBeams> gain = all_ones();

  // Every cell of an image.
  void fill(SonarPing& ping) {
    for (std::uint32_t beam = 0; beam < ping.beams; ++beam) {
      for (std::uint32_t bin = 0; bin < ping.bins; ++bin) {
        const double share = (bin + 0.5) / ping.bins;
        const double level = gain[beam] * (near_level + share * (far_level - near_level));
        ping.echo[std::size_t{beam} * ping.bins + bin] = speckled(level);
      }
    }
  }
  [[nodiscard]] std::uint8_t speckled(double level) {
    const double speckle = speckles_[random_() % speckles_.size()];
    return static_cast<std::uint8_t>(std::min(std::round(level * speckle), 255.0));
  }
  [[nodiscard]] std::mt19937& random() noexcept { return random_; }

 private:
  // Measured on real frames: Weibull of this shape, whose mean is that.
  static constexpr double kShape = 3.6;
  static constexpr double kMean = 0.90;

  [[nodiscard]] static std::array<double, kMaxBeams> all_ones() noexcept {
    std::array<double, kMaxBeams> ones{};
    ones.fill(1.0);
    return ones;
  }

  std::mt19937 random_;
  std::array<double, 4096> speckles_{};
};

// One beam's cells in a part of the range.
template <class Change>
void for_cells(SonarPing& ping, std::uint32_t beam, double from_m, double to_m, Change change) {
  for (std::uint32_t bin = 0; bin < ping.bins; ++bin) {
    if (const double range_m = ping.bin_range_m(bin); range_m >= from_m && range_m < to_m) {
      change(ping.echo[std::size_t{beam} * ping.bins + bin]);
    }
  }
}

}  // namespace lodesman::testing
