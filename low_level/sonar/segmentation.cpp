// SPDX-License-Identifier: Apache-2.0
#include "low_level/sonar/segmentation.h"

#include <algorithm>
#include <cmath>

#include "low_level/sonar/ping_check.h"
#include "mid_level/base/check.h"

namespace lodesman {
namespace {

// The usual level of a stripe's beam is what all but this part of its bins stay below.
constexpr double kStripeOutliers = 0.05;

std::uint32_t first_used_bin(const SonarPing& ping, double min_range_m) noexcept {
  const double bin = std::ceil(min_range_m * ping.bins / ping.range_m - 0.5);
  return static_cast<std::uint32_t>(std::clamp(bin, 0.0, static_cast<double>(ping.bins)));
}

std::span<const std::uint8_t> beam_of(const SonarPing& ping, std::uint32_t beam) noexcept {
  return std::span{ping.echo}.subspan(std::size_t{beam} * ping.bins, ping.bins);
}

std::uint8_t usual_level(std::span<const std::uint8_t> beam) noexcept {
  std::array<std::uint32_t, 256> histogram{};
  for (const std::uint8_t echo : beam) {
    ++histogram[echo];
  }
  const double allowed = kStripeOutliers * static_cast<double>(beam.size());
  std::uint32_t above = 0;
  std::size_t level = 255;
  while (level > 0 && above + histogram[level] <= allowed) {
    above += histogram[level];
    --level;
  }
  return static_cast<std::uint8_t>(level);
}

}  // namespace

Segmenter::Segmenter(const SegmentationOptions& options)
    : options_{options},
      blobs_{options},
      echo_(kMaxBeams * kMaxBins),
      bright_(kMaxBeams * kMaxBins),
      cells_(kMaxBeams * kMaxBins) {
  LODESMAN_CHECK(options.threshold > 0.0 && options.threshold <= 255.0);
  LODESMAN_CHECK(options.min_range_m >= 0.0 && options.min_blob_bins >= 1);
  LODESMAN_CHECK(options.join_beams >= 1 && options.join_beams <= kMaxJoin);
  LODESMAN_CHECK(options.join_bins >= 1 && options.join_bins <= kMaxJoin);
}

void Segmenter::segment(const SonarPing& ping, SonarObstacles& out) noexcept {
  out.frame = ping.number;
  out.captured = ping.captured;
  out.range_m = ping.range_m;
  blobs_.begin();
  if (is_sound_image(ping)) {
    grid_.set(ping, ping.bins);
    copy_without_stripes(ping);
    mark_bright(ping);
    for (std::uint32_t cell = 0; cell < ping.echo_count; ++cell) {
      if (bright_[cell] != 0) {
        const std::size_t size = grow_blob(ping, cell);
        if (size >= options_.min_blob_bins) {
          blobs_.add(grid_, std::span{cells_}.first(size), {echo_, 1, options_.threshold});
        }
      }
    }
  }
  blobs_.write(out);
}

void Segmenter::copy_without_stripes(const SonarPing& ping) noexcept {
  std::copy_n(ping.echo.begin(), ping.echo_count, echo_.begin());
  const std::uint32_t first_bin = first_used_bin(ping, options_.min_range_m);
  const double most = options_.stripe_fraction * (ping.bins - first_bin);
  const auto is_stripe = [&](std::uint32_t beam) {
    const auto echoes = beam_of(ping, beam).subspan(first_bin);
    const auto bright = std::count_if(echoes.begin(), echoes.end(), [&](std::uint8_t echo) {
      return echo >= options_.threshold;
    });
    return static_cast<double>(bright) > most;
  };
  std::uint32_t beam = 0;
  while (beam < ping.beams) {
    std::uint32_t end = beam;
    while (end < ping.beams && is_stripe(end)) {
      ++end;
    }
    if (end > beam && end - beam <= options_.stripe_max_beams) {
      replace_stripe(ping, beam, end);
    }
    beam = end + 1;
  }
}

void Segmenter::replace_stripe(const SonarPing& ping, std::uint32_t first,
                               std::uint32_t end) noexcept {
  const bool left = first > 0;
  const bool right = end < ping.beams;
  const std::uint32_t bins = ping.bins;
  for (std::uint32_t beam = first; beam < end; ++beam) {
    const std::uint8_t usual = usual_level(beam_of(ping, beam));
    for (std::uint32_t bin = 0; bin < bins; ++bin) {
      const std::uint32_t on_left = left ? ping.echo[(first - 1) * bins + bin] : 0;
      const std::uint32_t on_right = right ? ping.echo[end * bins + bin] : 0;
      const std::uint32_t beside = left && right ? (on_left + on_right) / 2 : on_left + on_right;
      const std::uint8_t own = ping.echo[beam * bins + bin];
      const std::uint32_t excess = own > usual ? static_cast<std::uint32_t>(own - usual) : 0;
      echo_[beam * bins + bin] = static_cast<std::uint8_t>(std::max(beside, excess));
    }
  }
}

void Segmenter::mark_bright(const SonarPing& ping) noexcept {
  const std::uint32_t first_bin = first_used_bin(ping, options_.min_range_m);
  for (std::uint32_t beam = 0; beam < ping.beams; ++beam) {
    const std::uint32_t beam_begin = beam > 0 ? beam - 1 : 0;
    const std::uint32_t beam_end = std::min(beam + 2, ping.beams);
    for (std::uint32_t bin = 0; bin < ping.bins; ++bin) {
      std::uint32_t sum = 0;
      const std::uint32_t bin_begin = bin > 0 ? bin - 1 : 0;
      const std::uint32_t bin_end = std::min(bin + 2, ping.bins);
      for (std::uint32_t b = beam_begin; b < beam_end; ++b) {
        for (std::uint32_t j = bin_begin; j < bin_end; ++j) {
          sum += echo_[b * ping.bins + j];
        }
      }
      const std::uint32_t cells = (beam_end - beam_begin) * (bin_end - bin_begin);
      const bool bright = bin >= first_bin && sum >= options_.threshold * cells;
      bright_[beam * ping.bins + bin] = bright ? 1 : 0;
    }
  }
}

// Breadth first; a bin enters the queue at most once, because it stops being bright as it does.
std::size_t Segmenter::grow_blob(const SonarPing& ping, std::uint32_t seed) noexcept {
  std::size_t size = 0;
  cells_[size++] = seed;
  bright_[seed] = 0;
  for (std::size_t next = 0; next < size; ++next) {
    const std::uint32_t beam = cells_[next] / ping.bins;
    const std::uint32_t bin = cells_[next] % ping.bins;
    const std::uint32_t beam_begin = beam - std::min(beam, options_.join_beams);
    const std::uint32_t beam_end = std::min(beam + options_.join_beams + 1, ping.beams);
    const std::uint32_t bin_begin = bin - std::min(bin, options_.join_bins);
    const std::uint32_t bin_end = std::min(bin + options_.join_bins + 1, ping.bins);
    for (std::uint32_t b = beam_begin; b < beam_end; ++b) {
      for (std::uint32_t j = bin_begin; j < bin_end; ++j) {
        const std::uint32_t cell = b * ping.bins + j;
        if (bright_[cell] != 0) {
          bright_[cell] = 0;
          cells_[size++] = cell;
        }
      }
    }
  }
  return size;
}

}  // namespace lodesman
