// SPDX-License-Identifier: Apache-2.0
#include "low_level/sonar/interference.h"

#include <algorithm>
#include <array>
#include <span>

namespace lodesman {
namespace {

constexpr double kBright = 1.7;          // times the background
constexpr double kUsualOutliers = 0.05;  // of a stripe's cells are brighter than its usual level

using Cells = std::span<const std::int16_t>;

// How many cells are brighter than the levels. The loop is plain, so that it is done many at once.
std::uint32_t count_bright(const std::int16_t* __restrict cells,
                           const std::int16_t* __restrict levels, std::uint32_t count) noexcept {
  std::uint32_t bright = 0;
  for (std::uint32_t bin = 0; bin < count; ++bin) {
    bright += cells[bin] > levels[bin] ? 1U : 0U;
  }
  return bright;
}

// What all but the outliers stay below, bit by bit.
std::int16_t usual_level(Cells cells) noexcept {
  const double allowed = kUsualOutliers * static_cast<double>(cells.size());
  std::int16_t value = 0;
  for (int bit = 14; bit >= 0; --bit) {
    const auto trial = static_cast<std::int16_t>(value | (1 << bit));
    const auto above = std::count_if(cells.begin(), cells.end(),
                                     [trial](std::int16_t cell) { return cell >= trial; });
    value = static_cast<double>(above) > allowed ? trial : value;
  }
  return value;
}

void mend(EchoPlane& plane, std::uint32_t first, std::uint32_t end) noexcept {
  const bool left = first > 0;
  const bool right = end < plane.layout().beams;
  for (std::uint32_t beam = first; beam < end; ++beam) {
    const std::int16_t usual = usual_level(plane.along(beam));
    const std::span<std::int16_t> cells = plane.mend(beam);
    for (std::uint32_t bin = 0; bin < cells.size(); ++bin) {
      const int on_left = left ? plane.along(first - 1)[bin] : 0;
      const int on_right = right ? plane.along(end)[bin] : 0;
      const int beside = left && right ? (on_left + on_right) / 2 : on_left + on_right;
      cells[bin] = static_cast<std::int16_t>(std::max(beside, cells[bin] - usual));
    }
  }
}

}  // namespace

bool mend_stripes(EchoPlane& plane, const RangeLevels& levels, std::uint32_t nearest,
                  const StripeOptions& options) noexcept {
  const std::uint32_t beams = plane.layout().beams;
  const std::uint32_t bins = plane.layout().bins - nearest;
  RangeLevels::Levels bright;
  for (std::uint32_t bin = nearest; bin < nearest + bins; ++bin) {
    bright[bin] = static_cast<std::int16_t>(kBright / kSmoothBeams * levels.background[bin]);
  }
  std::array<bool, EchoPlane::kMaxAcross> stripes{};
  for (std::uint32_t beam = 0; beam < beams; ++beam) {
    stripes[beam] = count_bright(plane.along(beam).data() + nearest, bright.data() + nearest,
                                 bins) > options.fraction * bins;
  }
  bool any = false;
  for (std::uint32_t beam = 0; beam < beams;) {
    std::uint32_t end = beam;
    while (end < beams && stripes[end]) {
      ++end;
    }
    if (end > beam && end - beam <= options.max_beams) {
      mend(plane, beam, end);
      any = true;
    }
    beam = end + 1;
  }
  if (any) {
    plane.smooth_across();
  }
  return any;
}

}  // namespace lodesman
