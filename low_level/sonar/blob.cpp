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
    const PolarGrid::Place p = grid.place(cell);
    m.weight += p.range_m;  // the cell's area, but for a constant factor
    m.mean_x += p.range_m * p.x_m();
    m.mean_y += p.range_m * p.y_m();
  }
  m.mean_x /= m.weight;
  m.mean_y /= m.weight;
  const double depth_variance = grid.echo_depth_m * grid.echo_depth_m / 12.0;
  for (const std::uint32_t cell : cells) {
    const PolarGrid::Place p = grid.place(cell);
    const double weight = p.range_m;
    const double dx = p.x_m() - m.mean_x;
    const double dy = p.y_m() - m.mean_y;
    // The cell's own spread: uniform over its depth along the beam and its width across it.
    const double width_m = p.range_m * grid.beam_width_rad;
    const double width_variance = width_m * width_m / 12.0;
    const double s = p.sine;
    const double c = p.cosine;
    m.xx += weight * (dx * dx + s * s * depth_variance + c * c * width_variance);
    m.yy += weight * (dy * dy + c * c * depth_variance + s * s * width_variance);
    m.xy += weight * (dx * dy + s * c * (depth_variance - width_variance));
  }
  m.xx /= m.weight;
  m.yy /= m.weight;
  m.xy /= m.weight;
  return m;
}

}  // namespace

void PolarGrid::set(const SonarPing& ping, std::uint32_t bins_of_range) noexcept {
  bins = bins_of_range;
  bin_depth_m = echo_depth_m = ping.range_m / bins;
  beam_width_rad = ping.beam_step_rad;
  for (std::uint32_t beam = 0; beam < ping.beams; ++beam) {
    sine[beam] = std::sin(ping.bearing_rad(beam));
    cosine[beam] = std::cos(ping.bearing_rad(beam));
  }
}

BlobEllipse moment_ellipse(const PolarGrid& grid, std::span<const std::uint32_t> cells) noexcept {
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
  // Half a cell at the least, whatever rounding does to the smaller eigenvalue.
  const double width_m = grid.place(cells[0]).range_m * grid.beam_width_rad;
  const double least_m = 0.5 * std::min(grid.echo_depth_m, width_m);
  e.first_m = std::max(2.0 * std::sqrt(middle + spread), least_m);
  e.second_m = std::max(2.0 * std::sqrt(std::max(middle - spread, 0.0)), least_m);
  return e;
}

BlobEllipse enclose(const PolarGrid& grid, std::span<const std::uint32_t> cells,
                    const BlobEllipse& moments, double fraction) noexcept {
  // With the semi-axes at two standard deviations the mean of the squared normalised distance is
  // at most 0.5, so by Markov's inequality the wanted quantile is at most 0.5 / (1 - fraction).
  const double limit = 0.5 / (1.0 - fraction);
  std::array<double, kBuckets> histogram{};
  double total = 0.0;
  double nearest_m = grid.place(cells[0]).range_m;
  for (const std::uint32_t cell : cells) {
    const PolarGrid::Place p = grid.place(cell);
    const double dx = p.x_m() - moments.centre_x_m;
    const double dy = p.y_m() - moments.centre_y_m;
    const double along = (dx * moments.axis_x + dy * moments.axis_y) / moments.first_m;
    const double across = (dx * moments.axis_y - dy * moments.axis_x) / moments.second_m;
    const double part = std::min((along * along + across * across) / limit, 1.0);
    histogram[static_cast<std::size_t>(part * (kBuckets - 1.0))] += p.range_m;
    total += p.range_m;
    nearest_m = std::min(nearest_m, p.range_m);
  }
  std::size_t bucket = 0;
  double enclosed = histogram[0];
  while (bucket + 1 < kBuckets && enclosed < fraction * total) {
    enclosed += histogram[++bucket];
  }
  const double quantile = limit * static_cast<double>(bucket + 1) / (kBuckets - 1.0);
  const double scale = std::sqrt(std::max(1.0, quantile));
  BlobEllipse e = moments;
  e.first_m *= scale;
  e.second_m *= scale;
  e.nearest_m = nearest_m;
  const double blob_area = total * grid.echo_depth_m * grid.beam_width_rad;
  e.fill = blob_area / (std::numbers::pi * e.first_m * e.second_m);
  return e;
}

void put_ellipse(const BlobEllipse& ellipse, Obstacle& out) noexcept {
  out.shape = ObstacleShape::kEllipse;
  out.centre_x_m = ellipse.centre_x_m;
  out.centre_y_m = ellipse.centre_y_m;
  out.semi_axis_first_m = ellipse.first_m;
  out.semi_axis_second_m = ellipse.second_m;
  out.angle_rad = std::atan2(ellipse.axis_x, ellipse.axis_y);
}

std::size_t split_across(const PolarGrid& grid, std::span<std::uint32_t> cells,
                         const BlobEllipse& ellipse) noexcept {
  const auto along = [&](std::uint32_t cell) {
    const PolarGrid::Place p = grid.place(cell);
    return p.x_m() * ellipse.axis_x + p.y_m() * ellipse.axis_y;
  };
  double low = along(cells[0]);
  double high = low;
  for (const std::uint32_t cell : cells) {
    const double here = along(cell);
    low = std::min(low, here);
    high = std::max(high, here);
  }
  const double middle = 0.5 * (low + high);
  const auto ahead = std::partition(cells.begin(), cells.end(),
                                    [&](std::uint32_t cell) { return along(cell) < middle; });
  return static_cast<std::size_t>(ahead - cells.begin());
}

}  // namespace lodesman
