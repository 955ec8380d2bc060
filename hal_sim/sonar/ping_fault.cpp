// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/sonar/ping_fault.h"

#include <algorithm>
#include <cmath>

#include "mid_level/base/heading.h"

namespace lodesman {
namespace {

// Ours, all of them: no such image was published.
constexpr double kWhite = 255.0;
constexpr double kSaturatedSpread = 15.0;  // below white
constexpr double kWeedShare = 1.0 / 3.0;   // of the beams
constexpr double kHaze_m = 1.5;
constexpr double kHazeLeast = 100.0;
constexpr double kHazeSpread = 120.0;
constexpr int kRays = 12;
constexpr double kRayWidth_rad = to_rad(1.5);
constexpr double kRayGaps = 0.3;  // of a ray's cells: it is dashed
constexpr double kNoise = 0.1;    // of a ray's brightness, everywhere

[[nodiscard]] std::span<std::uint8_t> beam_of(const EchoImage& image, std::uint32_t beam) noexcept {
  return image.echo.subspan(std::size_t{beam} * image.bins, image.bins);
}

[[nodiscard]] std::uint8_t brighter(std::uint8_t echo, double by) noexcept {
  return static_cast<std::uint8_t>(std::min(echo + by, kWhite));
}

void silence(std::span<std::uint8_t> cells) noexcept {
  std::fill(cells.begin(), cells.end(), std::uint8_t{0});
}

void blind(double width_deg, const EchoImage& image) noexcept {
  for (std::uint32_t beam = 0; beam < image.beams; ++beam) {
    const double bearing_rad = image.first_bearing_rad + beam * image.beam_step_rad;
    if (std::abs(bearing_rad) <= to_rad(width_deg) / 2.0) {
      silence(beam_of(image, beam));
    }
  }
}

}  // namespace

EchoImage image_of(SonarPing& ping) noexcept {
  const std::size_t cells =
      ping.kind == PingKind::kImage ? std::min<std::size_t>(ping.echo_count, ping.echo.size()) : 0;
  return {std::span{ping.echo}.first(cells),
          ping.beams,
          ping.bins,
          ping.range_m,
          ping.first_bearing_rad,
          ping.beam_step_rad};
}

PingFault::PingFault(std::uint64_t seed)
    : saturated_{"sonar saturated", seed},
      haze_{"sonar weed", seed},
      rays_{"sonar interference", seed},
      weed_begins_{(1.0 - kWeedShare) * haze_.uniform()},
      frozen_(kMaxBeams * kMaxBins) {}

void PingFault::alter(const Fault& fault, double thrust_load, const EchoImage& image) noexcept {
  if (fault.kind != FaultKind::kFrozen) {
    frozen_cells_ = 0;
  }
  if (image.echo.size() != std::size_t{image.beams} * image.bins ||
      image.echo.size() > frozen_.size()) {
    return;
  }
  switch (fault.kind) {
    case FaultKind::kSaturated: saturate(image); break;
    case FaultKind::kFrozen: freeze(image); break;
    case FaultKind::kBlinded: blind(fault.value, image); break;
    case FaultKind::kWeed: cover_with_weed(image); break;
    case FaultKind::kInterference: interfere(fault.value * thrust_load, image); break;
    default: break;
  }
}

void PingFault::saturate(const EchoImage& image) noexcept {
  for (std::uint8_t& echo : image.echo) {
    echo = static_cast<std::uint8_t>(kWhite - kSaturatedSpread * saturated_.uniform());
  }
}

// The first image of the fault, or of another size, is the one that comes again.
void PingFault::freeze(const EchoImage& image) noexcept {
  if (frozen_cells_ != image.echo.size()) {
    frozen_cells_ = image.echo.size();
    std::copy(image.echo.begin(), image.echo.end(), frozen_.begin());
    return;
  }
  std::copy_n(frozen_.begin(), frozen_cells_, image.echo.begin());
}

void PingFault::cover_with_weed(const EchoImage& image) noexcept {
  const auto first = static_cast<std::uint32_t>(weed_begins_ * image.beams);
  const auto count = static_cast<std::uint32_t>(std::ceil(kWeedShare * image.beams));
  const auto haze_end =
      static_cast<std::uint32_t>(std::clamp(kHaze_m / image.range_m, 0.0, 1.0) * image.bins);
  for (std::uint32_t beam = first; beam < std::min(first + count, image.beams); ++beam) {
    const std::span<std::uint8_t> cells = beam_of(image, beam);
    for (std::uint8_t& echo : cells.first(haze_end)) {
      echo = static_cast<std::uint8_t>(kHazeLeast + kHazeSpread * haze_.uniform());
    }
    silence(cells.subspan(haze_end));
  }
}

void PingFault::interfere(double strength, const EchoImage& image) noexcept {
  const auto width =
      static_cast<std::uint32_t>(std::max(std::round(kRayWidth_rad / image.beam_step_rad), 1.0));
  for (int ray = 0; ray < kRays; ++ray) {
    const auto first = static_cast<std::uint32_t>(rays_.uniform() * image.beams);
    for (std::uint32_t beam = first; beam < std::min(first + width, image.beams); ++beam) {
      for (std::uint8_t& echo : beam_of(image, beam)) {
        const double shine = rays_.uniform();
        echo = shine < kRayGaps ? echo : brighter(echo, strength * shine);
      }
    }
  }
  for (std::uint8_t& echo : image.echo) {
    echo = brighter(echo, kNoise * strength * rays_.uniform());
  }
}

}  // namespace lodesman
