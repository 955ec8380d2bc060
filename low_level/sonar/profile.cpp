// SPDX-License-Identifier: Apache-2.0
#include "low_level/sonar/profile.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mid_level/base/check.h"

namespace lodesman {
namespace {

constexpr double kStandardDeviations = 3.0;
constexpr std::uint32_t kBrightest = 255;
// Into which a range is divided: 3 cm of 30 m.
constexpr std::uint32_t kBins = kMaxBins;
// The coarser of the two that a DeltaT's ranges have (bytes 85-86 and 122 of its header).
constexpr double kStepsOfRange = 500.0;
// Cells of one run: a return a beam, and more where a far side is filled in.
constexpr std::size_t kMostCells = std::size_t{16} * kMaxBeams;

[[nodiscard]] bool is_profile(const SonarPing& ping) noexcept {
  return ping.kind == PingKind::kProfile && ping.beams >= 1 && ping.beams <= kMaxBeams &&
         ping.point_count == ping.beams && std::isfinite(ping.range_m) && ping.range_m > 0.0 &&
         std::isfinite(ping.first_bearing_rad) && ping.beam_step_rad > 0.0 &&
         ping.beam_step_rad <= std::numbers::pi;
}

}  // namespace

ProfileDetector::ProfileDetector(const SegmentationOptions& options)
    : options_{options}, blobs_{options}, strength_(kMaxBeams) {
  const ProfileOptions& profile = options.profile;
  LODESMAN_CHECK(profile.min_points >= 1 && profile.range_noise_m > 0.0);
  LODESMAN_CHECK(profile.least_incidence_rad > 0.0 &&
                 profile.least_incidence_rad < std::numbers::pi / 2.0);
  cells_.reserve(kMostCells);
}

void ProfileDetector::detect(const SonarPing& ping, SonarObstacles& out) noexcept {
  out.frame = ping.number;
  out.captured = ping.captured;
  out.range_m = ping.range_m;
  blobs_.begin();
  if (is_profile(ping)) {
    grid_.set(ping, kBins);
    // As deep as gives an even spread the variance of the noise.
    grid_.echo_depth_m =
        std::max(ping.range_m / kStepsOfRange, std::sqrt(12.0) * options_.profile.range_noise_m);
    for (std::uint32_t beam = 0; beam < ping.beams; ++beam) {
      strength_[beam] =
          static_cast<std::uint8_t>(std::min(ping.points[beam].intensity, kBrightest));
    }
    take_runs(ping);
  }
  blobs_.write(out);
}

// Returns of beams as far apart as bright bins of an image may be to be joined.
void ProfileDetector::take_runs(const SonarPing& ping) noexcept {
  cells_.clear();
  std::uint32_t last = 0;
  for (std::uint32_t beam = 0; beam < ping.beams; ++beam) {
    if (!is_return(ping, beam)) {
      continue;
    }
    if (!cells_.empty() &&
        (beam - last > options_.join_beams || !is_one_surface(ping, last, beam))) {
      end_run();
    }
    const auto bin = static_cast<std::uint32_t>(ping.points[beam].range_m / ping.range_m * kBins);
    cells_.push_back(beam * kBins + std::min(bin, kBins - 1));
    last = beam;
  }
  end_run();
}

void ProfileDetector::end_run() noexcept {
  if (cells_.size() >= options_.profile.min_points) {
    if (options_.method == DetectionMethod::kContrast && is_long()) {
      add_line();
    } else {
      fill_far_side();
      blobs_.add(grid_, cells_, {strength_, kBins, 0.0});
    }
  }
  cells_.clear();
}

// As long in range or across as is no ellipse of an image either.
bool ProfileDetector::is_long() const noexcept {
  const auto [near, far] =
      std::minmax_element(cells_.begin(), cells_.end(),
                          [](std::uint32_t a, std::uint32_t b) { return a % kBins < b % kBins; });
  const double deep_m = (*far % kBins - *near % kBins) * grid_.bin_depth_m;
  const std::uint32_t beams = cells_.back() / kBins - cells_.front() / kBins;
  const double wide_m = grid_.place(*far).range_m * grid_.beam_width_rad * beams;
  return std::max(deep_m, wide_m) >= options_.max_obstacle_length_m;
}

// Its pieces would slide along a wall as the boat does, and be taken for what moves.
void ProfileDetector::add_line() noexcept {
  double nearest_m = grid_.place(cells_.front()).range_m;
  std::uint8_t peak = 0;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const PolarGrid::Place at = grid_.place(cells_[i]);
    line_[i] = {at.x_m(), at.y_m()};
    nearest_m = std::min(nearest_m, at.range_m);
    peak = std::max(peak, strength_[cells_[i] / kBins]);
  }
  const std::span<Vertex> line = std::span{line_}.first(cells_.size());
  Obstacle wall;
  wall.shape = ObstacleShape::kPolyline;
  wall.vertex_count = thin_out(line, grid_.echo_depth_m, kMaxVertices);
  std::copy_n(line_.begin(), wall.vertex_count, wall.vertices.begin());
  for (const Vertex& vertex : std::span{wall.vertices}.first(wall.vertex_count)) {
    wall.centre_x_m += vertex.x_m / wall.vertex_count;
    wall.centre_y_m += vertex.y_m / wall.vertex_count;
  }
  blobs_.add(wall, nearest_m, static_cast<double>(peak));
}

void ProfileDetector::fill_far_side() noexcept {
  const std::size_t returns = cells_.size();
  const PolarGrid::Place first = grid_.place(cells_.front());
  const PolarGrid::Place last = grid_.place(cells_.back());
  const double dx_m = last.x_m() - first.x_m();
  const double dy_m = last.y_m() - first.y_m();
  if (std::hypot(dx_m, dy_m) > options_.max_obstacle_length_m) {
    return;
  }
  const double cross_m2 = first.x_m() * dy_m - first.y_m() * dx_m;
  for (std::size_t i = 0; i < returns; ++i) {
    const PolarGrid::Place here = grid_.place(cells_[i]);
    const double chord_m = cross_m2 / (here.sine * dy_m - here.cosine * dx_m);
    if (!fill_beam(cells_[i], chord_m)) {
      cells_.resize(returns);
      return;
    }
  }
}

// From a return to its mirror image behind the chord, as densely as a return is deep. False where
// that is deeper than an obstacle is long, or finds no room.
bool ProfileDetector::fill_beam(std::uint32_t cell, double chord_m) noexcept {
  const double depth_m = 2.0 * (chord_m - grid_.place(cell).range_m);
  if (!(depth_m > grid_.echo_depth_m)) {
    return true;
  }
  if (depth_m > options_.max_obstacle_length_m) {
    return false;
  }
  const auto step =
      static_cast<std::uint32_t>(std::max(1.0, std::round(grid_.echo_depth_m / grid_.bin_depth_m)));
  const auto deep = static_cast<std::uint32_t>(depth_m / grid_.bin_depth_m);
  const std::uint32_t end = std::min(cell % kBins + deep, kBins - 1);
  for (std::uint32_t bin = cell % kBins + step; bin <= end; bin += step) {
    if (cells_.size() == kMostCells) {
      return false;
    }
    cells_.push_back(cell - cell % kBins + bin);
  }
  return true;
}

bool ProfileDetector::is_return(const SonarPing& ping, std::uint32_t beam) const noexcept {
  const double range_m = ping.points[beam].range_m;
  return range_m > 0.0 && range_m >= options_.min_range_m && std::isfinite(range_m);
}

bool ProfileDetector::is_one_surface(const SonarPing& ping, std::uint32_t beam,
                                     std::uint32_t next) const noexcept {
  const double here_m = ping.points[beam].range_m;
  const double there_m = ping.points[next].range_m;
  const double turn_rad = (next - beam) * ping.beam_step_rad;
  const double incidence_rad = options_.profile.least_incidence_rad;
  const double distance_m =
      std::sqrt(here_m * here_m + there_m * there_m - 2.0 * here_m * there_m * std::cos(turn_rad));
  // Beams as far apart as that incidence meet no surface together.
  const double of_surface_m =
      turn_rad < incidence_rad
          ? std::min(here_m, there_m) * std::sin(turn_rad) / std::sin(incidence_rad - turn_rad)
          : 0.0;
  return distance_m <= of_surface_m + kStandardDeviations * options_.profile.range_noise_m +
                           ping.range_m / kStepsOfRange;
}

}  // namespace lodesman
