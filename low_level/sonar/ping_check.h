// SPDX-License-Identifier: Apache-2.0
// Whether a ping keeps its own ranges, as those that do not hold an index into its echoes may not
// be followed. Pure functions; any thread.
#pragma once

#include <cmath>

#include "mid_level/messages/sonar.h"

namespace lodesman {

[[nodiscard]] inline bool is_sound_image(const SonarPing& ping) noexcept {
  return ping.kind == PingKind::kImage && ping.beams >= 1 && ping.beams <= kMaxBeams &&
         ping.bins >= 1 && ping.bins <= kMaxBins && ping.echo_count == ping.beams * ping.bins &&
         std::isfinite(ping.range_m) && ping.range_m > 0.0 && std::isfinite(ping.sector_rad) &&
         ping.sector_rad <= kHalfTurn_rad && std::isfinite(ping.first_bearing_rad) &&
         ping.beam_step_rad > 0.0 && ping.beam_step_rad <= kHalfTurn_rad;
}

}  // namespace lodesman
