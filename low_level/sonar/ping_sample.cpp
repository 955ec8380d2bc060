// SPDX-License-Identifier: Apache-2.0
#include "low_level/sonar/ping_sample.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "low_level/sonar/ping_check.h"

namespace lodesman {
namespace {

// Weed on the head is as thick as this, and behind it begins what tells whether a beam hears. With
// a short range setting each is a part of that.
constexpr double kHaze_m = 1.5;
constexpr double kBehindHaze_m = 2.0;
constexpr double kMostHaze = 0.25;        // of the range setting
constexpr double kMostNear = 0.33;        // of the range setting
constexpr std::uint32_t kNearCells = 32;  // are enough of the nearest
// A receiver at its limit gives the greatest value and what its own noise takes off it.
constexpr std::uint8_t kAllButWhite = 230;
constexpr double kSpeckledShare = 0.25;

// Plain loops over as many as are known beforehand: so they are done many at once.
template <std::size_t kCount>
[[nodiscard]] std::uint32_t sum_of(const std::uint8_t* cells) noexcept {
  std::uint32_t sum = 0;
  for (std::size_t i = 0; i < kCount; ++i) {
    sum += cells[i];
  }
  return sum;
}

template <std::size_t kCount>
[[nodiscard]] std::uint32_t count_from(const std::uint8_t* cells, std::uint8_t least) noexcept {
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < kCount; ++i) {
    count += cells[i] >= least ? 1U : 0U;
  }
  return count;
}

}  // namespace

PingSample::PingSample() : cells_(kMaxBeams * kCellsOfBeam), before_(kMaxBeams * kCellsOfBeam) {}

bool PingSample::take(const SonarPing& ping) noexcept {
  if (!is_sound_image(ping) || ping.beams < kLeastBeams) {
    return false;
  }
  const double bins_of_metre = ping.bins / ping.range_m;
  const auto bins_of = [&](double most_m, double most_share) {
    return static_cast<std::uint32_t>(
        std::ceil(std::min(most_m, most_share * ping.range_m) * bins_of_metre));
  };
  Fan fan{ping.beams,
          ping.bins,
          bins_of(kHaze_m, kMostHaze),
          bins_of(kBehindHaze_m, kMostNear),
          static_cast<float>(ping.range_m),
          static_cast<float>(ping.first_bearing_rad)};
  if (fan.far_begin + kBlocks > ping.bins) {
    return false;
  }
  is_another_fan_ = !(fan == fan_);
  fan_ = fan;
  cells_of_block_ = std::min(kCells, (fan.bins - fan.far_begin) / kBlocks);
  gather(ping);
  add_up(ping);
  return true;
}

// Where a block has fewer cells than its room, the rest of that stays 0.
void PingSample::gather(const SonarPing& ping) noexcept {
  cells_.swap(before_);
  if (is_another_fan_) {
    std::fill(cells_.begin(), cells_.end(), std::uint8_t{0});
    std::fill(before_.begin(), before_.end(), std::uint8_t{0});
  }
  const std::uint32_t depth = fan_.bins - fan_.far_begin;
  for (std::uint32_t beam = 0; beam < fan_.beams; ++beam) {
    const std::uint8_t* const echo = ping.echo.data() + std::size_t{beam} * fan_.bins;
    std::uint8_t* out = cells_.data() + beam * kCellsOfBeam;
    for (std::uint32_t block = 0; block < kBlocks; ++block, out += kCells) {
      std::copy_n(echo + fan_.far_begin + block * depth / kBlocks, cells_of_block_, out);
    }
  }
}

void PingSample::add_up(const SonarPing& ping) noexcept {
  const std::uint32_t near_step = std::max(1U, fan_.near_end / kNearCells);
  const float cells_of_beam = static_cast<float>(kBlocks * cells_of_block_);
  std::uint32_t white = 0;
  for (std::uint32_t beam = 0; beam < fan_.beams; ++beam) {
    const std::uint8_t* const cells = cells_.data() + beam * kCellsOfBeam;
    float sum = 0.0F;
    for (std::uint32_t block = 0; block < kBlocks; ++block) {
      const auto of_block = static_cast<float>(sum_of<kCells>(cells + block * kCells));
      levels_[beam][block] = of_block / static_cast<float>(cells_of_block_);
      sum += levels_[beam][block];
    }
    far_[beam] = sum / static_cast<float>(kBlocks);
    lit_[beam] = static_cast<float>(count_from<kCellsOfBeam>(cells, 1)) / cells_of_beam;
    white += count_from<kCellsOfBeam>(cells, kAllButWhite);
    const std::uint8_t* const echo = ping.echo.data() + std::size_t{beam} * fan_.bins;
    std::uint32_t near = 0;
    std::uint32_t count = 0;
    for (std::uint32_t bin = 0; bin < fan_.near_end; bin += near_step, ++count) {
      near += echo[bin];
    }
    near_[beam] = static_cast<float>(near) / static_cast<float>(std::max(count, 1U));
  }
  white_share_ = white / static_cast<double>(cells_of_beam * static_cast<float>(fan_.beams));
}

bool PingSample::repeats() const noexcept {
  const auto used = static_cast<std::ptrdiff_t>(fan_.beams * kCellsOfBeam);
  return !is_another_fan_ && std::equal(cells_.begin(), cells_.begin() + used, before_.begin());
}

bool PingSample::is_speckled() const noexcept {
  std::size_t lit = 0;
  std::size_t unlike = 0;
  const std::size_t used = fan_.beams * kCellsOfBeam;
  for (std::size_t i = 1; i < used; ++i) {
    lit += cells_[i] != 0 ? 1U : 0U;
    unlike += cells_[i] != 0 && cells_[i] != cells_[i - 1] ? 1U : 0U;
  }
  return static_cast<double>(unlike) > kSpeckledShare * static_cast<double>(lit);
}

}  // namespace lodesman
