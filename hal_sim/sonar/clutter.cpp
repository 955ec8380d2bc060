// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/sonar/clutter.h"

#include <algorithm>
#include <cmath>

namespace lodesman {
namespace {

// Clouds: reverberation in patches, some too faint to be told from the water.
constexpr std::uint32_t kLeastCloudPings = 20;
constexpr std::uint32_t kMostCloudPings = 150;
constexpr double kLeastCloud_rad = to_rad(2.0);  // half its width
constexpr double kMostCloud_rad = to_rad(12.0);
constexpr double kLeastCloud_m = 0.5;  // nominal, half its depth
constexpr double kMostCloud_m = 4.0;
constexpr double kLeastCloud = 0.3;  // times the water, above it
constexpr double kMostCloud = 1.55;

// Particles: 1 to 3 cells each way.
constexpr std::uint32_t kLeastParticlePings = 1;
constexpr std::uint32_t kMostParticlePings = 5;
constexpr double kLeastHalfCell = 0.7;
constexpr double kMostHalfCell = 1.8;
constexpr double kLeastParticle = 15.0;  // [-] of 255
constexpr double kMostParticle = 90.0;

constexpr double kLeastOutlier = 30.0;
constexpr double kMostOutlier = 200.0;

constexpr double kNearestShare = 0.05;  // of the range, from which on there are any

}  // namespace

// As many near by as far off: a sonar hears them where they are few in a beam.
WorldPoint Clutter::somewhere(const VehiclePose& pose, RandomStream& chance) const noexcept {
  const double range_m = grid_.range_m * uniform_between(chance, kNearestShare, 1.0);
  const double bearing_rad = grid_.sector_rad * (chance.uniform() - 0.5);
  return pose.to_world({{range_m * std::sin(bearing_rad), range_m * std::cos(bearing_rad)}});
}

void Clutter::begin_some(const VehiclePose& pose, RandomStream& chance) noexcept {
  for (std::uint32_t i = how_many(chance, kind_.clouds); i > 0; --i) {
    Speck cloud;
    cloud.at_W = somewhere(pose, chance);
    cloud.beams =
        uniform_between(chance, kLeastCloud_rad, kMostCloud_rad) / grid_.sector_rad * grid_.beams;
    cloud.bins = grid_.bins_of_nominal(uniform_between(chance, kLeastCloud_m, kMostCloud_m));
    cloud.times_water = uniform_between(chance, kLeastCloud, kMostCloud);
    cloud.pings_left = pings_between(chance, kLeastCloudPings, kMostCloudPings);
    specks_.begin(cloud);
  }
  for (std::uint32_t i = how_many(chance, kind_.particles); i > 0; --i) {
    Speck particle;
    particle.at_W = somewhere(pose, chance);
    particle.beams = uniform_between(chance, kLeastHalfCell, kMostHalfCell);
    particle.bins = uniform_between(chance, kLeastHalfCell, kMostHalfCell);
    particle.level = uniform_between(chance, kLeastParticle, kMostParticle);
    particle.pings_left = pings_between(chance, kLeastParticlePings, kMostParticlePings);
    specks_.begin(particle);
  }
}

void Clutter::draw_one(const Speck& speck, const VehiclePose& pose,
                       EchoLevels& levels) const noexcept {
  const Eigen::Vector2d at = pose.to_vehicle(speck.at_W).xy_m;
  const auto level = static_cast<float>(speck.level);
  const auto times_water = static_cast<float>(speck.times_water);
  const std::span<const float> water = levels.water();
  add_patch(levels, grid_.beam_at(std::atan2(at.x(), at.y())), grid_.bin_at(at.norm()),
            std::max(speck.beams, kLeastHalfCell), std::max(speck.bins, kLeastHalfCell),
            [=](std::uint32_t bin) noexcept { return level + times_water * water[bin]; });
}

void Clutter::draw(const VehiclePose& pose, EchoLevels& levels, RandomStream& chance) noexcept {
  begin_some(pose, chance);
  for (const Speck& speck : specks_.now()) {
    draw_one(speck, pose, levels);
  }
  specks_.age();
  for (std::uint32_t i = how_many(chance, kind_.outliers); i > 0; --i) {
    const auto beam = static_cast<std::uint32_t>(chance.uniform() * grid_.beams);
    const auto bin = static_cast<std::uint32_t>(chance.uniform() * grid_.bins);
    levels.beam(beam)[bin] +=
        static_cast<float>(uniform_between(chance, kLeastOutlier, kMostOutlier));
  }
}

}  // namespace lodesman
