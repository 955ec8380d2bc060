// SPDX-License-Identifier: Apache-2.0
#include "low_level/sonar/segmentation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mid_level/base/check.h"

namespace lodesman {
namespace {

// 2^8 pieces: a blob as long as the view's arc at 30 m (63 m) still comes out in quarter metres.
constexpr std::uint32_t kMaxSplits = 8;
// The usual level of a stripe's beam is what all but this part of its bins stay below.
constexpr double kStripeOutliers = 0.05;

bool is_valid(const SonarPing& ping) noexcept {
  return ping.beams >= 1 && ping.beams <= kMaxBeams && ping.bins >= 1 && ping.bins <= kMaxBins &&
         ping.echo_count == ping.beams * ping.bins && std::isfinite(ping.range_m) &&
         ping.range_m > 0.0 && std::isfinite(ping.sector_rad) && ping.sector_rad > 0.0 &&
         ping.sector_rad <= std::numbers::pi;
}

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
      echo_(kMaxBeams * kMaxBins),
      bright_(kMaxBeams * kMaxBins),
      cells_(kMaxBeams * kMaxBins) {
  LODESMAN_CHECK(options.threshold > 0.0 && options.threshold <= 255.0);
  LODESMAN_CHECK(options.min_range_m >= 0.0 && options.min_blob_bins >= 1);
  LODESMAN_CHECK(options.join_beams >= 1 && options.join_beams <= kMaxJoin);
  LODESMAN_CHECK(options.join_bins >= 1 && options.join_bins <= kMaxJoin);
  LODESMAN_CHECK(options.max_obstacle_length_m > 0.0 && options.protection_margin_m >= 0.0);
  LODESMAN_CHECK(options.enclosed_fraction >= 0.5 && options.enclosed_fraction <= 0.99);
}

void Segmenter::segment(const SonarPing& ping, SonarObstacles& out) noexcept {
  out.frame = ping.number;
  out.captured = ping.captured;
  out.range_m = ping.range_m;
  found_count_ = 0;
  dropped_ = 0;
  if (is_valid(ping)) {
    grid_.set(ping);
    copy_without_stripes(ping);
    mark_bright(ping);
    for (std::uint32_t cell = 0; cell < ping.echo_count; ++cell) {
      if (bright_[cell] != 0) {
        const std::size_t size = grow_blob(ping, cell);
        if (size >= options_.min_blob_bins) {
          add_blob(size);
        }
      }
    }
  }
  write(out);
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

bool Segmenter::must_split(const BlobEllipse& ellipse) const noexcept {
  const double length_m = 2.0 * ellipse.first_m;
  const double longest_m = options_.max_obstacle_length_m;
  return length_m > longest_m || (length_m > 0.5 * longest_m && ellipse.fill < options_.min_fill);
}

// One ellipse round a long or bent wall would cover free water, so the blob is halved across its
// longer axis until each piece is short: several ellipses along the wall, as in Fig. 9b.
void Segmenter::add_blob(std::size_t size) noexcept {
  struct Piece {
    std::span<std::uint32_t> cells;
    std::uint32_t splits;
  };
  std::array<Piece, kMaxSplits + 1> pieces{};  // each level leaves one sibling waiting
  std::size_t waiting = 0;
  pieces[waiting++] = {std::span{cells_}.first(size), 0};
  while (waiting > 0) {
    const Piece piece = pieces[--waiting];
    const BlobEllipse moments = moment_ellipse(grid_, piece.cells);
    const BlobEllipse ellipse = enclose(grid_, piece.cells, moments, options_.enclosed_fraction);
    if (piece.splits < kMaxSplits && must_split(ellipse)) {
      // One cell may be longer than the longest obstacle (few beams, far away): then no cut helps.
      const std::size_t behind = split_across(grid_, piece.cells, ellipse);
      if (behind > 0 && behind < piece.cells.size()) {
        pieces[waiting++] = {piece.cells.first(behind), piece.splits + 1};
        pieces[waiting++] = {piece.cells.subspan(behind), piece.splits + 1};
        continue;
      }
    }
    std::uint8_t peak = 0;
    for (const std::uint32_t cell : piece.cells) {
      peak = std::max(peak, echo_[cell]);
    }
    // A piece without an echo of its own is but the smoothing's fringe of the piece beside it.
    if (piece.splits == 0 || peak >= options_.threshold) {
      keep_nearest({ellipse, static_cast<double>(peak)});
    }
  }
}

void Segmenter::keep_nearest(const Found& found) noexcept {
  const auto nearer = [](const Found& a, const Found& b) {
    return a.ellipse.nearest_m < b.ellipse.nearest_m;
  };
  if (found_count_ == kMaxObstacles) {
    ++dropped_;
    if (!nearer(found, found_[0])) {
      return;
    }
    std::pop_heap(found_.begin(), found_.end(), nearer);
    --found_count_;
  }
  found_[found_count_++] = found;
  std::push_heap(found_.begin(), found_.begin() + found_count_, nearer);
}

void Segmenter::write(SonarObstacles& out) noexcept {
  std::sort(found_.begin(), found_.begin() + found_count_, [](const Found& a, const Found& b) {
    return a.ellipse.nearest_m < b.ellipse.nearest_m;
  });
  for (std::uint32_t i = 0; i < found_count_; ++i) {
    const BlobEllipse& e = found_[i].ellipse;
    Obstacle& obstacle = out.obstacles[i];
    obstacle = Obstacle{};
    obstacle.shape = ObstacleShape::kEllipse;
    obstacle.centre_x_m = e.centre_x_m;
    obstacle.centre_y_m = e.centre_y_m;
    obstacle.semi_axis_first_m = e.first_m;
    obstacle.semi_axis_second_m = e.second_m;
    obstacle.angle_rad = std::atan2(e.axis_x, e.axis_y);
    obstacle.protection_first_m = e.first_m + options_.protection_margin_m;
    obstacle.protection_second_m = e.second_m + options_.protection_margin_m;
    obstacle.peak = found_[i].peak;
  }
  out.count = found_count_;
  out.dropped = dropped_;
}

}  // namespace lodesman
