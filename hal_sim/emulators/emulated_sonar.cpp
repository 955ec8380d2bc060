// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/emulators/emulated_sonar.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lodesman {
namespace {

// Longer ones are none of the program's.
constexpr std::size_t kReceived_max = 2048;

// The setting of a list that is nearest.
template <std::size_t kCount>
[[nodiscard]] std::uint16_t nearest(const std::array<int, kCount>& list, double wanted) noexcept {
  return static_cast<std::uint16_t>(*std::min_element(
      list.begin(), list.end(),
      [wanted](int a, int b) { return std::abs(a - wanted) < std::abs(b - wanted); }));
}

}  // namespace

EmulatedSonarOptions emulated_sonar_options(const Scenario& scenario) {
  static constexpr std::array<int, 4> kSectors_deg{30, 60, 90, 120};
  static constexpr std::array<int, 3> kBeams{120, 240, 480};
  EmulatedSonarOptions options;
  auto& settings = options.program.settings;
  settings.range_m = static_cast<std::uint16_t>(std::lround(std::max(scenario.sonar.range_m, 1.0)));
  settings.sector_deg = nearest(kSectors_deg, to_deg(scenario.sonar.sector_rad));
  settings.beams = nearest(kBeams, scenario.sonar.beams);
  options.program.samples = static_cast<std::uint16_t>(std::min(scenario.sonar.bins, 500U));
  options.program.period = from_seconds(1.0 / scenario.sonar.ping_hz);
  options.program.seed = options.seed = scenario.seed;
  options.obstacles = scenario.obstacles;
  options.origin = {scenario.environment.origin_latitude_deg,
                    scenario.environment.origin_longitude_deg};
  return options;
}

EmulatedSonar::EmulatedSonar(const EmulatedSonarOptions& options, const std::vector<Fault>& faults,
                             Time now)
    : program_{options.program, now},
      network_{"sonar", options.seed},
      faults_{faults, FaultDevice::kSonar},
      scene_{options.obstacles},
      frame_{options.origin},
      received_(kReceived_max) {}

void EmulatedSonar::feel(const WorldSample& world, Time now) {
  if (world.started != 0) {
    faults_.advance(world.scenario_time_s, now, program_, network_);
  }
  if (!program_.is_due(now)) {
    return;
  }
  scene_.observe(world.pose(), world.scenario_time_s);
  surfaces_m_.clear();
  for (std::size_t beam = 0; beam < program_.beams(); ++beam) {
    surfaces_m_.push_back(scene_.range_m(program_.bearing_rad(beam)));
  }
  PingSituation situation;
  const GeoPoint place = frame_.to_geo({{world.x_m, world.y_m}});
  situation.heading_true_rad = world.heading_rad;
  situation.latitude_deg = place.latitude_deg;
  situation.longitude_deg = place.longitude_deg;
  situation.speed_m_s = std::hypot(world.surge_m_s, world.sway_m_s);
  situation.course_rad =
      wrap_to_pi(world.heading_rad + std::atan2(world.sway_m_s, world.surge_m_s));
  situation.thrust_load = world.thrust_load;
  program_.ping(surfaces_m_, situation, now);
}

void EmulatedSonar::exchange(DatagramSocket& socket, Time now) {
  network_.advance(now);
  for (auto came = socket.receive(received_); came.any; came = socket.receive(received_)) {
    for (std::size_t i = network_.from_host(now); i > 0 && !came.truncated; --i) {
      program_.receive(std::span{received_}.first(came.size), now, said_);
    }
  }
  program_.step(now, said_);
  for (Utterance& datagram : said_) {
    network_.from_device(std::move(datagram));
  }
  said_.clear();
  network_.to_host(now, said_);
  for (const Utterance& datagram : said_) {
    sent_ += socket.reply(datagram.bytes) ? 1U : 0U;
  }
  said_.clear();
}

}  // namespace lodesman
