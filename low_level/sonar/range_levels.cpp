// SPDX-License-Identifier: Apache-2.0
#include "low_level/sonar/range_levels.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace lodesman {
namespace {

// Ranges whose medians are looked for side by side: as many as the widest vectors hold, twice.
constexpr std::uint32_t kLanes = 32;
static_assert(EchoPlane::kMaxAlong % kLanes == 0);

// Cells side by side share two beams of three: every second one says all.
constexpr std::uint32_t kBeamStep = 2;
constexpr double kOneSigma = 0.16;            // of a normal distribution lies lower
constexpr std::uint32_t kCalmBins = 5;        // the background is the mean over so many ranges
constexpr std::uint32_t kVariationEvery = 4;  // one range in so many says what it varies by
// What the background may rise to from nearer ranges, which are so large a share of all. A wall
// that fills a narrow fan is brighter; in a wide one a bottom or a ring may be as bright as this,
// and a wall all round is brighter still.
constexpr double kNearerShare = 0.17;
constexpr double kMostRiseInNarrow = 1.2;
constexpr double kMostRiseInWide = 4.0;
// No background is believed to be darker than the step an echo is counted in, of 255, nor than a
// part of the ping's usual one: in the dark, single counts would be contrasts.
constexpr double kDarkest = 1.0;
constexpr double kDarkestShare = 0.5;
// Nor to be so bright that no echo could stand out from it: cells of this share of the brightest
// that can be are echoes whatever is beside them, so that a blinded ping is no free water.
constexpr double kBlindShare = 0.75;

std::int16_t level(double value) noexcept {
  return static_cast<std::int16_t>(
      std::min(value, static_cast<double>(std::numeric_limits<std::int16_t>::max())));
}

// Plain, and of two that are told apart, so that it is done many at once.
void take_greater(std::int16_t* __restrict greatest, const std::int16_t* __restrict cells,
                  std::uint32_t count) noexcept {
  for (std::uint32_t i = 0; i < count; ++i) {
    greatest[i] = std::max(greatest[i], cells[i]);
  }
}

using Lanes = std::array<std::int16_t, kLanes>;

// Of each of some ranges the largest value that no more than a share of the beams stay below, found
// bit by bit: always the same work, whatever the echoes are.
Lanes quantiles(const EchoPlane& plane, std::uint32_t first_bin, double share) noexcept {
  const PlaneLayout& layout = plane.layout();
  const std::uint32_t looked_at = (layout.beams + kBeamStep - 1) / kBeamStep;
  const auto below_it = static_cast<std::int16_t>(share * looked_at);
  const auto brightest = static_cast<std::uint32_t>(255.0 * layout.scale);
  Lanes value{};
  for (auto bit = static_cast<int>(std::bit_width(brightest)) - 1; bit >= 0; --bit) {
    Lanes trial{};
    Lanes below{};
    for (std::uint32_t i = 0; i < kLanes; ++i) {
      trial[i] = static_cast<std::int16_t>(value[i] | (1 << bit));
    }
    for (std::uint32_t beam = 0; beam < layout.beams; beam += kBeamStep) {
      const std::int16_t* const cells = plane.smooth(beam).data() + first_bin;
      for (std::uint32_t i = 0; i < kLanes; ++i) {
        below[i] = static_cast<std::int16_t>(below[i] + (cells[i] < trial[i] ? 1 : 0));
      }
    }
    for (std::uint32_t i = 0; i < kLanes; ++i) {
      value[i] = below[i] > below_it ? value[i] : trial[i];
    }
  }
  return value;
}

}  // namespace

void RangeLevels::take_medians(const EchoPlane& plane) noexcept {
  for (std::uint32_t first = 0; first < plane.layout().bins; first += kLanes) {
    const Lanes medians = quantiles(plane, first, 0.5);
    std::copy(medians.begin(), medians.end(), background.begin() + first);
  }
}

// By how much the darker beams of a range stay below its background, as a share of it: what echoes
// there are lie on the other side. The usual one of some ranges.
double RangeLevels::variation(const EchoPlane& plane, double least) noexcept {
  const std::uint32_t bins = plane.layout().bins;
  std::uint32_t count = 0;
  for (std::uint32_t first = 0; first < bins; first += kVariationEvery * kLanes) {
    const Lanes dark = quantiles(plane, first, kOneSigma);
    for (std::uint32_t i = 0; i < kLanes && first + i < bins; ++i) {
      const double median = background[first + i];
      if (median >= least) {
        calm_[count++] = static_cast<float>(1.0 - std::min<double>(dark[i], median) / median);
      }
    }
  }
  if (count == 0) {
    return 0.0;
  }
  std::nth_element(calm_.begin(), calm_.begin() + count / 2, calm_.begin() + count);
  return static_cast<double>(calm_[count / 2]);
}

void RangeLevels::take_brightest(const EchoPlane& plane) noexcept {
  const std::uint32_t bins = plane.layout().bins;
  std::fill_n(brightest_.begin(), bins, std::int16_t{0});
  for (std::uint32_t beam = 0; beam < plane.layout().beams; ++beam) {
    take_greater(brightest_.data(), plane.smooth(beam).data(), bins);
  }
}

void RangeLevels::calm(std::uint32_t bins, double most_rise, double least) noexcept {
  const double follow = 1.0 / std::max(1.0, kNearerShare * bins);
  double nearer = std::max(static_cast<double>(background[0]), least);
  for (std::uint32_t bin = 0; bin < bins; ++bin) {
    const std::uint32_t from = bin - std::min(bin, kCalmBins / 2);
    const std::uint32_t to = std::min(bin + kCalmBins / 2 + 1, bins);
    int sum = 0;
    for (std::uint32_t i = from; i < to; ++i) {
      sum += background[i];
    }
    const double mean = std::max(sum / static_cast<double>(to - from), least);
    const double here = std::min(mean, most_rise * nearer);
    nearer += follow * (here - nearer);
    calm_[bin] = static_cast<float>(here);
  }
}

void RangeLevels::learn(const EchoPlane& plane, const ContrastOptions& options,
                        double sector_rad) noexcept {
  const std::uint32_t bins = plane.layout().bins;
  take_medians(plane);
  take_brightest(plane);
  const bool wide = sector_rad > options.ring_sector_rad;
  std::copy_n(background.begin(), bins, weak.begin());
  std::nth_element(weak.begin(), weak.begin() + bins / 2, weak.begin() + bins);
  const double least = std::max(kDarkest * plane.layout().scale, (kDarkestShare)*weak[bins / 2]);
  needed_excess =
      std::clamp(options.sigmas * variation(plane, least), kLeastExcess, options.most_excess);
  calm(bins, wide ? kMostRiseInWide : kMostRiseInNarrow, least);
  const double most =
      kBlindShare * 255.0 * plane.layout().scale / (1.0 + options.seed * needed_excess);
  for (std::uint32_t bin = 0; bin < bins; ++bin) {
    const double here = std::min(static_cast<double>(calm_[bin]), most);
    const double lobes = here + options.side_lobe * std::max(brightest_[bin] - here, 0.0);
    background[bin] = level(here);
    weak[bin] = level(std::max((1.0 + needed_excess) * here, lobes));
    seed[bin] = level(std::max((1.0 + options.seed * needed_excess) * here, lobes));
  }
}

}  // namespace lodesman
