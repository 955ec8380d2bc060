// SPDX-License-Identifier: Apache-2.0
// The world task with devices that are emulated to the byte on lines in memory: before each of its
// steps the thruster box gets what was written to it, after it AHRS, satellite receiver and sonar
// send what they feel. Made before any task runs; stepped by the world's thread.
#pragma once

#include <memory>
#include <optional>

#include "drivers/stream/memory_datagrams.h"
#include "hal_sim/emulators/emulated_ahrs.h"
#include "hal_sim/emulators/emulated_position.h"
#include "hal_sim/emulators/emulated_sonar.h"
#include "hal_sim/emulators/emulated_thrusters.h"
#include "mid_level/blackboard/blackboard.h"
#include "mid_level/runtime/task.h"

namespace lodesman {

class LoopedWorld final : public Task {
 public:
  // World, blackboard and link must outlive it.
  LoopedWorld(Task& world, Blackboard& board, SimLink& link, std::vector<Fault> faults);

  // The line to a device, for its driver; it lives as long as this. At most one of each.
  [[nodiscard]] MemoryLine& add_ahrs(const EmulatedAhrsOptions& options);
  [[nodiscard]] MemoryLine& add_position(const EmulatedPositionOptions& options);
  [[nodiscard]] MemoryDatagrams& add_sonar(const EmulatedSonarOptions& options);
  // Throws StartupError when the link has a box already.
  [[nodiscard]] MemoryLine& add_thrusters(const EmulatedThrustersOptions& options);
  [[nodiscard]] bool is_empty() const noexcept {
    return !ahrs_ && !position_ && !sonar_ && !thrusters_;
  }

  void step(Time now) noexcept override;

 private:
  // Devices are switched on at the first step: before it there is no time.
  template <class Device, class Options>
  struct Looped {
    explicit Looped(const Options& set) : options{set} {}

    Options options;
    MemoryLine line;
    std::optional<Device> device;
    std::optional<LineFeed> feed;

    void begin(const std::vector<Fault>& faults, Time now) {
      if (!device) {
        device.emplace(options, faults, now);
        feed.emplace(device->device(), device->wire(), line);
      }
    }
  };

  struct LoopedSonar {
    explicit LoopedSonar(const EmulatedSonarOptions& set) : options{set} {}

    EmulatedSonarOptions options;
    MemoryDatagrams datagrams;
    std::optional<EmulatedSonar> sonar;
  };

  void step_sensors(const WorldSample& sample, Time now);

  Task& world_;
  Bell<>& ahrs_bell_;
  Bell<>& position_bell_;
  Bell<>& sonar_bell_;
  SimLink& link_;
  std::vector<Fault> faults_;
  Reader<WorldSample> samples_;
  std::unique_ptr<Looped<EmulatedAhrs, EmulatedAhrsOptions>> ahrs_;
  std::unique_ptr<Looped<EmulatedPosition, EmulatedPositionOptions>> position_;
  std::unique_ptr<LoopedSonar> sonar_;
  std::unique_ptr<Looped<EmulatedThrusters, EmulatedThrustersOptions>> thrusters_;
  std::optional<Writer<SimThrust>> thrust_;
};

}  // namespace lodesman
