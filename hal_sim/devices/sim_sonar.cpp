// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/devices/sim_sonar.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "hal_sim/devices/echo.h"

namespace lodesman {
namespace {

// Ours: a hard surface is bright, and its echo dies away over a few bins.
constexpr std::array<std::uint8_t, 4> kEcho = {200, 150, 100, 50};

}  // namespace

SimSonar::SimSonar(const Scenario& scenario, SimLink& link)
    : feed_{link, link.sonar_due, from_seconds(1.0 / scenario.sonar.ping_hz),
            FaultSchedule{scenario.faults, FaultDevice::kSonar}},
      settings_{scenario.sonar},
      obstacles_{scenario.obstacles} {
  scene_.reserve(obstacles_.size());
}

ReadStatus SimSonar::poll(Time now, SonarPing& out) noexcept {
  const SampleFeed::Due due = feed_.poll(now);
  if (due.status == ReadStatus::kFresh || due.status == ReadStatus::kCorrupt) {
    ++pings_;  // a ping that was lost leaves a gap in the numbers
  }
  if (due.status == ReadStatus::kFresh) {
    listen(due.sample, out);
  }
  return due.status;
}

void SimSonar::listen(const WorldSample& world, SonarPing& out) noexcept {
  out.number = pings_;
  out.captured = world.stamp;
  out.range_m = settings_.range_m;
  out.make_image(settings_.beams, settings_.bins, settings_.sector_rad);
  std::fill_n(out.echo.begin(), out.echo_count, std::uint8_t{0});
  scene_.clear();
  for (const MovingObstacle& mover : obstacles_) {
    if (mover.exists(world.scenario_time_s)) {
      scene_.push_back(mover.at(world.scenario_time_s));
    }
  }
  const VehiclePose pose = world.pose();
  for (std::uint32_t beam = 0; beam < out.beams; ++beam) {
    const double bearing_rad = pose.angle_to_world_rad(out.bearing_rad(beam));
    const Eigen::Vector2d direction_W{std::sin(bearing_rad), std::cos(bearing_rad)};
    double range_m = std::numeric_limits<double>::infinity();
    for (const Obstacle& obstacle : scene_) {
      range_m = std::min(range_m, ray_range_m(obstacle, pose.p_WV, direction_W));
    }
    if (range_m >= out.range_m) {
      continue;
    }
    const auto first = static_cast<std::uint32_t>(range_m / out.range_m * out.bins);
    for (std::uint32_t i = 0; i < kEcho.size() && first + i < out.bins; ++i) {
      out.echo[beam * out.bins + first + i] = kEcho[i];
    }
  }
}

}  // namespace lodesman
