// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/sonar/stripes.h"

#include <algorithm>

namespace lodesman {
namespace {

constexpr std::uint32_t kLeastRayPings = 30;
constexpr std::uint32_t kMostRayPings = 300;
constexpr double kLeastRayHalfBeams = 1.0;
constexpr double kMostRayHalfBeams = 3.0;
constexpr double kLeastRay = 0.3;  // times the water, above it
constexpr double kMostRay = 1.5;

constexpr std::uint32_t kLeastDashedPings = 1;
constexpr std::uint32_t kMostDashedPings = 12;
constexpr std::uint32_t kLeastDashedBeams = 3;
constexpr std::uint32_t kMostDashedBeams = 5;
constexpr double kLeastDashed = 40.0;  // [-] of 255
constexpr double kMostDashed_level = 160.0;
// Bins of a dash and of what is dark before it; each ping has others.
constexpr std::uint32_t kLeastDash = 1;
constexpr std::uint32_t kMostDash = 8;

}  // namespace

void Stripes::begin_some(RandomStream& chance) noexcept {
  if (chance.uniform() < kind_.rays) {
    Ray ray;
    ray.beam = grid_.beams * chance.uniform();
    ray.half_beams = uniform_between(chance, kLeastRayHalfBeams, kMostRayHalfBeams);
    ray.times_water = static_cast<float>(uniform_between(chance, kLeastRay, kMostRay));
    ray.pings_left = pings_between(chance, kLeastRayPings, kMostRayPings);
    rays_.begin(ray);
  }
  if (chance.uniform() < kind_.dashed_stripes) {
    Dashed stripe;
    stripe.first_beam = static_cast<std::uint32_t>(grid_.beams * chance.uniform());
    stripe.beams = pings_between(chance, kLeastDashedBeams, kMostDashedBeams);
    stripe.level = static_cast<float>(uniform_between(chance, kLeastDashed, kMostDashed_level));
    stripe.pings_left = pings_between(chance, kLeastDashedPings, kMostDashedPings);
    dashed_.begin(stripe);
  }
}

void Stripes::draw_ray(const Ray& ray, EchoLevels& levels) const noexcept {
  const std::span<const float> water = levels.water();
  const auto first = static_cast<std::uint32_t>(std::max(ray.beam - ray.half_beams, 0.0));
  const auto end =
      std::min(static_cast<std::uint32_t>(ray.beam + ray.half_beams + 1.0), grid_.beams);
  for (std::uint32_t beam = first; beam < end; ++beam) {
    const double off = (beam + 0.5 - ray.beam) / ray.half_beams;
    const float times = ray.times_water * static_cast<float>(std::max(1.0 - off * off, 0.0));
    const std::span<float> cells = levels.beam(beam);
    for (std::uint32_t bin = 0; bin < grid_.bins; ++bin) {
      cells[bin] += times * water[bin];
    }
  }
}

void Stripes::draw_dashes(const Dashed& stripe, EchoLevels& levels,
                          RandomStream& chance) const noexcept {
  const std::uint32_t end = std::min(stripe.first_beam + stripe.beams, grid_.beams);
  for (std::uint32_t bin = 0; bin < grid_.bins;) {
    bin += pings_between(chance, kLeastDash, kMostDash);
    const std::uint32_t dash_end =
        std::min(bin + pings_between(chance, kLeastDash, kMostDash), grid_.bins);
    for (; bin < dash_end; ++bin) {
      for (std::uint32_t beam = stripe.first_beam; beam < end; ++beam) {
        levels.beam(beam)[bin] += stripe.level;
      }
    }
  }
}

void Stripes::draw(EchoLevels& levels, RandomStream& chance) noexcept {
  begin_some(chance);
  for (const Ray& ray : rays_.now()) {
    draw_ray(ray, levels);
  }
  for (const Dashed& stripe : dashed_.now()) {
    draw_dashes(stripe, levels, chance);
  }
  rays_.age();
  dashed_.age();
}

}  // namespace lodesman
