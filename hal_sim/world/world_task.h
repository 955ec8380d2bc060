// SPDX-License-Identifier: Apache-2.0
// The task that moves the simulated world: from the thrust that the simulated box applies to the
// truth on the blackboard and the sample that the simulated devices sense. One thread steps it.
#pragma once

#include <array>
#include <optional>

#include "hal_sim/world/sim_link.h"
#include "hal_sim/world/world.h"
#include "mid_level/blackboard/blackboard.h"
#include "mid_level/runtime/task.h"

namespace lodesman {

// Until the mission starts the scenario's time stands at 0, and until then or the first thrust, by
// hand, the boat lies at its start; from then on both go on for good, through other missions too.
// On a blackboard that holds the truth of a world that died, the boat lies where that left it, at
// rest.
//
// Where the boat itself is real, the vessel lies where the estimate has it: what is simulated is
// simulated round that, and there is no truth to be published.
class WorldTask final : public Task {
 public:
  enum class MovedBy : std::uint8_t { kThrust, kEstimate };

  // Blackboard and link must outlive the task. Throws StartupError when either has a world already.
  WorldTask(const Scenario& scenario, const VesselParameters& vessel, Blackboard& blackboard,
            SimLink& link, MovedBy moved_by = MovedBy::kThrust);

  void step(Time now) noexcept override;

  [[nodiscard]] const WorldTruth& truth() const noexcept { return world_.truth(); }

 private:
  // After a gap (the machine slept) no more than this is caught up with.
  static constexpr Duration kLongestStep = std::chrono::seconds{1};

  void publish_truth(Time now, ThrustCommand thrust) noexcept;
  void publish_estimate(Time now) noexcept;
  // Wakes the tasks whose simulated device has a sample to be polled.
  void ring_for_samples(Time now) noexcept;

  struct Rung {
    const SampleDue& due;
    Bell<>& bell;
  };

  MovedBy moved_by_;
  World world_;
  Reader<VehicleState> vehicle_state_;
  Reader<MissionStatus> mission_status_;
  Reader<SimThrust> box_;
  std::optional<Writer<WorldTruth>> truth_out_;
  Writer<WorldSample> sample_out_;
  std::array<Rung, 3> sensors_;
  bool cast_off_ = false;
  Time stepped_to_{};
  Time mission_started_{};  // the first one; 0 before it
};

}  // namespace lodesman
