// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/sonar/noisy_water.h"

#include <algorithm>

namespace lodesman {
namespace {

constexpr int kBrightest = 255;
constexpr float kToNearest = 0.5F;  // levels are rounded, and none is negative

// Plain, and into what is told apart from them, so that it is done many at once.
void speckle_part(std::span<const float> water, std::span<const float> ring,
                  std::span<const float> cells, std::span<const float> speckle, float left,
                  std::uint8_t* __restrict out) noexcept {
  const float* const w = water.data();
  const float* const r = ring.data();
  const float* const c = cells.data();
  const float* const s = speckle.data();
  const std::size_t count = cells.size();
  for (std::size_t i = 0; i < count; ++i) {
    const float level = (left * w[i] + r[i] + c[i]) * s[i];
    out[i] = static_cast<std::uint8_t>(std::min(static_cast<int>(level + kToNearest), kBrightest));
  }
}

}  // namespace

NoisyWater::NoisyWater(const WaterKind& kind, const EchoGrid& grid, std::uint64_t seed)
    : kind_{kind},
      chance_{"noisy water", seed},
      speckle_{grid.beams, grid.bins, chance_},
      water_{kind, grid, chance_},
      surfaces_{kind, grid, chance_},
      ghosts_{kind, grid},
      clutter_{kind, grid},
      stripes_{kind, grid},
      levels_{grid} {}

bool NoisyWater::loses_ping() noexcept { return chance_.uniform() < kind_.lost_pings; }

void NoisyWater::draw(const HeardScene& scene, SonarPing& ping) noexcept {
  const EchoGrid& grid = levels_.grid();
  if (ping.beams != grid.beams || ping.bins != grid.bins) {
    return;
  }
  levels_.silence();
  water_.draw(levels_.water(), chance_);
  surfaces_.draw(scene, levels_, chance_);
  ghosts_.draw(scene, surfaces_, levels_, chance_);
  clutter_.draw(scene.pose(), levels_, chance_);
  stripes_.draw(levels_, chance_);
  speckle_.choose_part(chance_);
  for (std::uint32_t beam = 0; beam < grid.beams; ++beam) {
    const EchoLevels::Shadow shadow = levels_.shadow(beam);
    std::uint8_t* const out = ping.echo.data() + std::size_t{beam} * grid.bins;
    const auto part = [&](std::size_t from, std::size_t count, float left) noexcept {
      speckle_part(levels_.water().subspan(from, count), levels_.ring().subspan(from, count),
                   levels_.beam(beam).subspan(from, count),
                   speckle_.beam(beam).subspan(from, count), left, out + from);
    };
    part(0, shadow.from, 1.0F);
    part(shadow.from, grid.bins - shadow.from, shadow.left);
  }
}

}  // namespace lodesman
