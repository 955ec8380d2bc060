// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/devices/sim_sonar.h"

#include <algorithm>
#include <span>
#include <utility>

namespace lodesman {
namespace {

[[nodiscard]] std::optional<NoisyWater> water_of(const ScenarioSonar& sonar, std::uint64_t seed) {
  if (sonar.noise == SonarNoise::kNone || sonar.scene == SonarScene::kDetections) {
    return std::nullopt;
  }
  return std::optional<NoisyWater>{
      std::in_place, sonar.noise == SonarNoise::kTank ? kTankWater : kSeaWater,
      EchoGrid{sonar.beams, sonar.bins, sonar.range_m, sonar.sector_rad}, seed};
}

}  // namespace

SimSonar::SimSonar(const Scenario& scenario, SimLink& link)
    : feed_{link, link.sonar_due, from_seconds(1.0 / scenario.sonar.ping_hz),
            FaultSchedule{scenario.faults, FaultDevice::kSonar}},
      settings_{scenario.sonar},
      scene_{scenario.obstacles},
      detections_{scenario.obstacles.size(), scenario.sonar.detections, scenario.seed},
      water_{water_of(scenario.sonar, scenario.seed)},
      ping_fault_{scenario.seed} {}

ReadStatus SimSonar::poll(Time now, SonarPing& out) noexcept {
  const SampleFeed::Due due = feed_.poll(now);
  if (due.status == ReadStatus::kFresh || due.status == ReadStatus::kCorrupt) {
    ++pings_;  // a ping that was lost leaves a gap in the numbers
  }
  if (due.status == ReadStatus::kFresh) {
    if (water_ && water_->loses_ping()) {
      return ReadStatus::kNothingNew;
    }
    if (settings_.scene == SonarScene::kDetections) {
      detect(due.sample, out);
    } else {
      listen(due.sample, out);
      ping_fault_.alter(due.fault, due.sample.thrust_load, image_of(out));
    }
  }
  return due.status;
}

void SimSonar::listen(const WorldSample& world, SonarPing& out) noexcept {
  out.number = pings_;
  out.captured = world.stamp;
  out.range_m = settings_.range_m;
  out.make_image(settings_.beams, settings_.bins, settings_.sector_rad);
  scene_.observe(world.pose(), world.scenario_time_s);
  if (water_) {
    water_->draw(scene_, out);
    return;
  }
  std::fill_n(out.echo.begin(), out.echo_count, std::uint8_t{0});
  for (std::uint32_t beam = 0; beam < out.beams; ++beam) {
    draw_echo(scene_.range_m(out.bearing_rad(beam)), out.range_m,
              std::span{out.echo}.subspan(std::size_t{beam} * out.bins, out.bins));
  }
}

void SimSonar::detect(const WorldSample& world, SonarPing& out) noexcept {
  out.number = pings_;
  out.captured = world.stamp;
  out.range_m = settings_.range_m;
  out.make_profile(settings_.beams, settings_.sector_rad);
  scene_.observe(world.pose(), world.scenario_time_s);
  detections_.detect(scene_, out);
}

}  // namespace lodesman
