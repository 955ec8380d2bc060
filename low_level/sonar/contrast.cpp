// SPDX-License-Identifier: Apache-2.0
#include "low_level/sonar/contrast.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "low_level/sonar/interference.h"
#include "low_level/sonar/ping_check.h"

namespace lodesman {

ContrastDetector::ContrastDetector(const SegmentationOptions& options)
    : options_{options}, outline_{options.max_obstacle_length_m} {}

void ContrastDetector::detect(const SonarPing& ping, SonarObstacles& out) noexcept {
  out.frame = ping.number;
  out.captured = ping.captured;
  out.range_m = ping.range_m;
  out.dropped = 0;
  out.count = 0;
  if (!is_sound_image(ping)) {
    return;
  }
  plane_.set(ping);
  set_grid(ping);
  const double nearest =
      std::ceil(heard_from_m(options_.min_range_m, ping.range_m) / grid_.bin_depth_m - 0.5);
  const auto from = static_cast<std::uint32_t>(
      std::clamp(nearest, 0.0, static_cast<double>(plane_.layout().bins)));
  levels_.learn(plane_, options_.contrast, ping.sector_rad);
  if (mend_stripes(plane_, levels_, from, {options_.stripe_fraction, options_.stripe_max_beams})) {
    levels_.learn(plane_, options_.contrast, ping.sector_rad);
  }
  runs_.find(plane_, levels_, from);
  runs_.join(plane_, levels_, options_.contrast, kMaxObstacles);
  write(ping, out);
}

void ContrastDetector::set_grid(const SonarPing& ping) noexcept {
  const PlaneLayout& layout = plane_.layout();
  grid_.bins = layout.bins;
  grid_.bin_depth_m = grid_.echo_depth_m = layout.bins_of_cell * ping.range_m / ping.bins;
  grid_.beam_width_rad = layout.beams_of_cell * ping.beam_step_rad;
  for (std::uint32_t beam = 0; beam < layout.beams; ++beam) {
    const double bearing_rad = ping.bearing_rad(layout.first_beam(beam, ping.beams)) +
                               0.5 * (layout.beams_of_cell - 1.0) * ping.beam_step_rad;
    grid_.sine[beam] = std::sin(bearing_rad);
    grid_.cosine[beam] = std::cos(bearing_rad);
  }
}

double ContrastDetector::peak_of(const SonarPing& ping, const EchoSum& echo) const noexcept {
  const PlaneLayout& layout = plane_.layout();
  std::uint8_t peak = 0;
  for (const BrightRun& run : runs_.runs_of(echo)) {
    const std::uint32_t first = layout.first_beam(run.beam, ping.beams);
    for (std::uint32_t beam = first; beam < first + layout.beams_of_cell; ++beam) {
      const std::uint8_t* const bins = ping.echo.data() + std::size_t{beam} * ping.bins;
      peak = std::max(peak, *std::max_element(bins + run.begin * layout.bins_of_cell,
                                              bins + run.end * layout.bins_of_cell));
    }
  }
  return peak;
}

void ContrastDetector::write(const SonarPing& ping, SonarObstacles& out) noexcept {
  std::array<double, kMaxObstacles> nearest_m{};
  std::array<std::uint32_t, kMaxObstacles> order{};
  const auto count = static_cast<std::uint32_t>(runs_.echoes().size());
  for (std::uint32_t i = 0; i < count; ++i) {
    const EchoSum& echo = runs_.echoes()[i];
    outline_.trace(grid_, runs_.runs_of(echo), found_[i]);
    found_[i].peak = peak_of(ping, echo);
    nearest_m[i] = outline_.nearest_m();
  }
  std::iota(order.begin(), order.begin() + count, 0U);
  std::sort(order.begin(), order.begin() + count, [&](std::uint32_t a, std::uint32_t b) {
    return std::pair{nearest_m[a], a} < std::pair{nearest_m[b], b};
  });
  for (std::uint32_t i = 0; i < count; ++i) {
    Obstacle& obstacle = out.obstacles[i];
    obstacle = found_[order[i]];
    obstacle.protection_first_m = obstacle.semi_axis_first_m + options_.protection_margin_m;
    obstacle.protection_second_m = obstacle.semi_axis_second_m + options_.protection_margin_m;
  }
  out.count = count;
}

}  // namespace lodesman
