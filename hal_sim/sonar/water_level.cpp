// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/sonar/water_level.h"

#include <algorithm>
#include <cmath>

namespace lodesman {
namespace {

// The ring-down is gone within a metre, and with a short range setting within a quarter of that.
constexpr double kRingDownLevel = 60.0;
constexpr double kRingDown_m = 0.18;  // it falls to 1/e over so much
constexpr double kRingDownShare = kRingDown_m / 4.0;
constexpr double kRise = 0.3;  // of the range, over which the noise gets near to what it is far off
constexpr double kHazeNominal_m = 1.2;  // falls to 1/e
// Before the bottom is heard the water is dark for a few bins: what follows a strong pulse in a
// head's filter has a counterpart before it.
constexpr double kDarkBins = 4.0;
constexpr double kDark = 0.4;         // [-] of the water, there
constexpr double kStepBins = 3.0;     // the bottom's edge, of a pulse's length
constexpr double kSurfaceBins = 4.0;  // half as wide as the surface's ring is
constexpr double kSurfaceRing = 0.7;  // [-] of the water, above it, in the middle of the ring
// Where the surface is heard: nearer than the bottom.
constexpr double kSurfaceLeast = 0.3;
constexpr double kSurfaceMost = 0.8;
// Of the range, in a ping: the boat heaves, and the bottom is not level.
constexpr double kDrift = 0.0005;

}  // namespace

WaterLevel::WaterLevel(const WaterKind& kind, const EchoGrid& grid, RandomStream& chance)
    : kind_{kind},
      grid_{grid},
      bottom_{kind.bottom_from + (kind.bottom_to - kind.bottom_from) * chance.uniform()},
      surface_{bottom_ * (kSurfaceLeast + (kSurfaceMost - kSurfaceLeast) * chance.uniform())},
      still_(grid.bins) {
  const double ring_down_m = std::min(kRingDown_m, kRingDownShare * grid.range_m);
  for (std::uint32_t bin = 0; bin < grid.bins; ++bin) {
    const double share = (bin + 0.5) / grid.bins;
    const double risen = 1.0 - std::exp(-share / kRise);
    const double level = kind.near_level + (kind.far_level - kind.near_level) * risen +
                         kind.haze_level * std::exp(-share * kNominalRange_m / kHazeNominal_m) +
                         kRingDownLevel * std::exp(-share * grid.range_m / ring_down_m);
    still_[bin] = static_cast<float>(level);
  }
}

void WaterLevel::draw(std::span<float> water, RandomStream& chance) noexcept {
  bottom_ = std::clamp(bottom_ + kDrift * chance.gaussian(), kind_.bottom_from, kind_.bottom_to);
  const double bottom = bottom_ * grid_.bins;
  const double surface = surface_ * grid_.bins;
  for (std::uint32_t bin = 0; bin < grid_.bins; ++bin) {
    const double behind = bin + 0.5 - bottom;
    const double from_surface = (bin + 0.5 - surface) / kSurfaceBins;
    const double risen = std::clamp(behind / kStepBins, 0.0, 1.0);
    const double dark = behind < 0.0 && behind >= -kDarkBins ? kDark : 1.0;
    const double ring = kSurfaceRing * std::max(1.0 - from_surface * from_surface, 0.0);
    const double times = dark * (1.0 + (kind_.bottom_step - 1.0) * risen) * (1.0 + ring);
    water[bin] = still_[bin] * static_cast<float>(times);
  }
}

}  // namespace lodesman
