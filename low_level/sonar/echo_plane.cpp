// SPDX-License-Identifier: Apache-2.0
#include "low_level/sonar/echo_plane.h"

#include <algorithm>

namespace lodesman {
namespace {

constexpr std::uint32_t kBeyond = kSmoothBins / 2;  // cells that smoothing takes from either side
static_assert(kSmoothBins == 7 && kSmoothBeams == 3, "the sums below are written out");
static_assert(kMaxBins < EchoPlane::kMaxAlong);

// The compiler is told that what is written is not what is read: only then it takes many at once.
using Out = std::int16_t* __restrict;
using In = const std::int16_t* __restrict;
using Echoes = const std::uint8_t* __restrict;

void add_echoes(Out out, Echoes echo, std::uint32_t bins) noexcept {
  for (std::uint32_t bin = 0; bin < bins; ++bin) {
    out[bin] = static_cast<std::int16_t>(out[bin] + echo[bin]);
  }
}

void add_pairs(Out out, Echoes echo, std::size_t bins) noexcept {
  for (std::size_t bin = 0; bin < bins; ++bin) {
    out[bin] = static_cast<std::int16_t>(out[bin] + echo[2 * bin] + echo[2 * bin + 1]);
  }
}

void add_seven(Out out, In in, std::size_t bins) noexcept {
  for (std::size_t bin = 0; bin < bins; ++bin) {
    out[bin] = static_cast<std::int16_t>(in[bin] + in[bin + 1] + in[bin + 2] + in[bin + 3] +
                                         in[bin + 4] + in[bin + 5] + in[bin + 6]);
  }
}

}  // namespace

void PlaneLayout::set(const SonarPing& ping) noexcept {
  beams_of_cell = std::max(1U, ping.beams / kPlaneBeams);
  bins_of_cell = std::max(1U, ping.bins / kPlaneBins);
  beams = (ping.beams + beams_of_cell - 1) / beams_of_cell;
  bins = ping.bins / bins_of_cell;
}

std::uint32_t PlaneLayout::first_beam(std::uint32_t cell, std::uint32_t of_beams) const noexcept {
  return std::min(cell * beams_of_cell, of_beams - beams_of_cell);
}

EchoPlane::EchoPlane()
    : gathered_(kMaxAlong + 2 * kBeyond),
      along_(kMaxAcross * kMaxAlong),
      smooth_(kMaxAcross * kMaxAlong) {}

void EchoPlane::set(const SonarPing& ping) noexcept {
  layout_.set(ping);
  const std::uint32_t echoes = layout_.beams_of_cell * layout_.bins_of_cell;
  shift_ = 0;
  while (((255U * echoes) >> shift_) * kSmoothBeams * kSmoothBins > 0x7fffU) {
    ++shift_;
  }
  layout_.scale = kSmoothBeams * kSmoothBins * echoes / static_cast<double>(1U << shift_);
  for (std::uint32_t cell = 0; cell < layout_.beams; ++cell) {
    gather(ping, cell);
    smooth_along(cell);
  }
  smooth_across();
}

void EchoPlane::gather(const SonarPing& ping, std::uint32_t cell) noexcept {
  std::int16_t* const out = gathered_.data() + kBeyond;
  const std::uint32_t bins = layout_.bins;
  const std::uint32_t first = layout_.first_beam(cell, ping.beams);
  std::fill_n(out, bins, std::int16_t{0});
  for (std::uint32_t beam = first; beam < first + layout_.beams_of_cell; ++beam) {
    const std::uint8_t* const echo = ping.echo.data() + std::size_t{beam} * ping.bins;
    if (layout_.bins_of_cell == 1) {
      add_echoes(out, echo, bins);
    } else {  // two, as kMaxBins is less than three times kPlaneBins
      add_pairs(out, echo, bins);
    }
  }
  if (shift_ > 0) {
    for (std::uint32_t bin = 0; bin < bins; ++bin) {
      out[bin] = static_cast<std::int16_t>(out[bin] >> shift_);
    }
  }
  std::fill_n(out - kBeyond, kBeyond, out[0]);
  std::fill_n(out + bins, kBeyond, out[bins - 1]);
}

void EchoPlane::smooth_along(std::uint32_t cell) noexcept {
  add_seven(along_.data() + cell * kMaxAlong, gathered_.data(), layout_.bins);
}

void EchoPlane::smooth_across() noexcept {
  for (std::uint32_t beam = 0; beam < layout_.beams; ++beam) {
    const std::uint32_t before = beam > 0 ? beam - 1 : beam;
    const std::uint32_t after = std::min(beam + 1, layout_.beams - 1);
    const std::int16_t* const a = along_.data() + before * kMaxAlong;
    const std::int16_t* const b = along_.data() + beam * kMaxAlong;
    const std::int16_t* const c = along_.data() + after * kMaxAlong;
    std::int16_t* const out = smooth_.data() + beam * kMaxAlong;
    for (std::uint32_t bin = 0; bin < layout_.bins; ++bin) {
      out[bin] = static_cast<std::int16_t>(a[bin] + b[bin] + c[bin]);
    }
  }
}

}  // namespace lodesman
