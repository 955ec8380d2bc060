// SPDX-License-Identifier: Apache-2.0
// A simulated multibeam sonar at the vehicle's origin, looking ahead: in each beam a clean echo of
// the nearest surface and nothing behind it, or what real water makes of that; or, where the scene
// is `detections`, a profile of what its own detection makes of the clean ones. Polled by the one
// thread that owns it.
#pragma once

#include <optional>

#include "drivers/hal/devices.h"
#include "hal_sim/devices/sample_feed.h"
#include "hal_sim/scenario/scenario.h"
#include "hal_sim/sonar/detections.h"
#include "hal_sim/sonar/heard_scene.h"
#include "hal_sim/sonar/noisy_water.h"
#include "hal_sim/sonar/ping_fault.h"

namespace lodesman {

// Without noise each beam is the ray along its centre.
class SimSonar final : public ImagingSonar {
 public:
  // The link must outlive the sonar.
  SimSonar(const Scenario& scenario, SimLink& link);
  [[nodiscard]] ReadStatus poll(Time now, SonarPing& out) noexcept override;

 private:
  void listen(const WorldSample& world, SonarPing& out) noexcept;
  void detect(const WorldSample& world, SonarPing& out) noexcept;

  SampleFeed feed_;
  ScenarioSonar settings_;
  HeardScene scene_;
  Detections detections_;
  std::optional<NoisyWater> water_;  // where there is noise
  PingFault ping_fault_;
  std::uint64_t pings_ = 0;
};

}  // namespace lodesman
