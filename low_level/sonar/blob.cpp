// SPDX-License-Identifier: Apache-2.0
#include "low_level/sonar/blob.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lodesman {
namespace {

constexpr std::size_t kBuckets = 1024;

struct Moments {
  double weight = 0.0;
  double mean_x = 0.0;
  double mean_y = 0.0;
  double xx = 0.0;  // [m^2] variances about the mean
  double xy = 0.0;
  double yy = 0.0;
};

Moments moments_of(const PolarGrid& grid, std::span<const std::uint32_t> cells) noexcept {
  Moments m;
  for (const std::uint32_t cell : cells) {
    const double weight = grid.range_m(cell);  // the area, but for a constant factor
    m.weight += weight;
    m.mean_x += weight * grid.x_m(cell);
    m.mean_y += weight * grid.y_m(cell);
  }
  m.mean_x /= m.weight;
  m.mean_y /= m.weight;
  const double depth_variance = grid.bin_depth_m * grid.bin_depth_m / 12.0;
  for (const std::uint32_t cell : cells) {
    const double weight = grid.range_m(cell);
    const double dx = grid.x_m(cell) - m.mean_x;
    const double dy = grid.y_m(cell) - m.mean_y;
    // The cell's own spread: uniform over its depth along the beam and its width across it.
    const double width_m = grid.range_m(cell) * grid.beam_width_rad;
    const double width_variance = width_m * width_m / 12.0;
    const double s = grid.sine[cell / grid.bins];
    const double c = grid.cosine[cell / grid.bins];
    m.xx += weight * (dx * dx + s * s * depth_variance + c * c * width_variance);
    m.yy += weight * (dy * dy + c * c * depth_variance + s * s * width_variance);
    m.xy += weight * (dx * dy + s * c * (depth_variance - width_variance));
  }
  m.xx /= m.weight;
  m.yy /= m.weight;
  m.xy /= m.weight;
  return m;
}

// The factor by which the ellipse of the moments must grow to enclose the fraction. It never
// shrinks, so an ellipse is at least 0.58 of a cell in each semi-axis.
double enclosing_scale(const PolarGrid& grid, std::span<const std::uint32_t> cells,
                       const BlobEllipse& e, double fraction) noexcept {
  // With the semi-axes at two standard deviations the mean of the squared normalised distance is
  // at most 0.5, so by Markov's inequality the wanted quantile is at most 0.5 / (1 - fraction).
  const double limit = 0.5 / (1.0 - fraction);
  std::array<double, kBuckets> histogram{};
  double total = 0.0;
  for (const std::uint32_t cell : cells) {
    const double dx = grid.x_m(cell) - e.centre_x_m;
    const double dy = grid.y_m(cell) - e.centre_y_m;
    const double along = (dx * e.axis_x + dy * e.axis_y) / e.first_m;
    const double across = (dx * e.axis_y - dy * e.axis_x) / e.second_m;
    const double part = std::min((along * along + across * across) / limit, 1.0);
    const auto bucket = static_cast<std::size_t>(part * static_cast<double>(kBuckets - 1));
    histogram[bucket] += grid.range_m(cell);
    total += grid.range_m(cell);
  }
  double enclosed = 0.0;
  std::size_t bucket = 0;
  while (bucket < kBuckets - 1) {
    enclosed += histogram[bucket];
    if (enclosed >= fraction * total) {
      break;
    }
    ++bucket;
  }
  const double quantile =
      limit * static_cast<double>(bucket + 1) / static_cast<double>(kBuckets - 1);
  return std::sqrt(std::max(1.0, quantile));
}

}  // namespace

void PolarGrid::set(const SonarPing& ping) noexcept {
  bins = ping.bins;
  bin_depth_m = ping.range_m / ping.bins;
  beam_width_rad = ping.sector_rad / ping.beams;
  for (std::uint32_t beam = 0; beam < ping.beams; ++beam) {
    sine[beam] = std::sin(ping.bearing_rad(beam));
    cosine[beam] = std::cos(ping.bearing_rad(beam));
  }
}

BlobEllipse fit_ellipse(const PolarGrid& grid, std::span<const std::uint32_t> cells,
                        double enclosed_fraction) noexcept {
  const Moments m = moments_of(grid, cells);
  BlobEllipse e;
  e.centre_x_m = m.mean_x;
  e.centre_y_m = m.mean_y;
  // The eigenvalues of a symmetric 2 x 2 matrix and the eigenvector of the larger one.
  const double middle = 0.5 * (m.xx + m.yy);
  const double spread = std::hypot(0.5 * (m.xx - m.yy), m.xy);
  const double turn = 0.5 * std::atan2(2.0 * m.xy, m.yy - m.xx);  // clockwise from +y
  e.axis_x = std::sin(turn);
  e.axis_y = std::cos(turn);
  // Rounding may bring the smaller one below what the cells' own spread guarantees.
  const double floor = std::min(grid.bin_depth_m, grid.range_m(cells[0]) * grid.beam_width_rad);
  e.first_m = std::max(2.0 * std::sqrt(middle + spread), 0.5 * floor);
  e.second_m = std::max(2.0 * std::sqrt(std::max(middle - spread, 0.0)), 0.5 * floor);

  const double scale = enclosing_scale(grid, cells, e, enclosed_fraction);
  e.first_m *= scale;
  e.second_m *= scale;
  const double blob_area = m.weight * grid.bin_depth_m * grid.beam_width_rad;
  e.fill = blob_area / (std::numbers::pi * e.first_m * e.second_m);
  e.nearest_m = grid.range_m(*std::min_element(
      cells.begin(), cells.end(),
      [&grid](std::uint32_t a, std::uint32_t b) { return a % grid.bins < b % grid.bins; }));
  return e;
}

std::size_t split_across(const PolarGrid& grid, std::span<std::uint32_t> cells,
                         const BlobEllipse& ellipse) noexcept {
  const auto along = [&](std::uint32_t cell) {
    return grid.x_m(cell) * ellipse.axis_x + grid.y_m(cell) * ellipse.axis_y;
  };
  double low = along(cells[0]);
  double high = low;
  for (const std::uint32_t cell : cells) {
    low = std::min(low, along(cell));
    high = std::max(high, along(cell));
  }
  const double middle = 0.5 * (low + high);
  const auto ahead = std::partition(cells.begin(), cells.end(),
                                    [&](std::uint32_t cell) { return along(cell) < middle; });
  return static_cast<std::size_t>(ahead - cells.begin());
}

}  // namespace lodesman
