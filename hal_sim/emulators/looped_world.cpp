// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/emulators/looped_world.h"

#include <utility>

#include "mid_level/base/startup_error.h"

namespace lodesman {

LoopedWorld::LoopedWorld(Task& world, Blackboard& board, SimLink& link, std::vector<Fault> faults)
    : world_{world},
      ahrs_bell_{board.bell_of(TaskId::kAhrs)},
      position_bell_{board.bell_of(TaskId::kPosition)},
      sonar_bell_{board.bell_of(TaskId::kDeltaT)},
      link_{link},
      faults_{std::move(faults)},
      samples_{link.world} {}

MemoryLine& LoopedWorld::add_ahrs(const EmulatedAhrsOptions& options) {
  ahrs_ = std::make_unique<Looped<EmulatedAhrs, EmulatedAhrsOptions>>(options);
  return ahrs_->line;
}

MemoryLine& LoopedWorld::add_position(const EmulatedPositionOptions& options) {
  position_ = std::make_unique<Looped<EmulatedPosition, EmulatedPositionOptions>>(options);
  return position_->line;
}

MemoryDatagrams& LoopedWorld::add_sonar(const EmulatedSonarOptions& options) {
  sonar_ = std::make_unique<LoopedSonar>(options);
  return sonar_->datagrams;
}

MemoryLine& LoopedWorld::add_thrusters(const EmulatedThrustersOptions& options) {
  thrusters_ = std::make_unique<Looped<EmulatedThrusters, EmulatedThrustersOptions>>(options);
  thrust_.emplace(link_.thrust, Role::kLow, "emulated thrust");
  return thrusters_->line;
}

void LoopedWorld::step(Time now) noexcept {
  if (thrusters_) {
    thrusters_->begin(faults_, now);
    if (const auto* before = samples_.latest(); before != nullptr) {
      thrusters_->device->feel(before->value, now);
    }
    thrusters_->feed->pump(now);
    thrust_->publish(thrusters_->device->output(now), now);
  }
  world_.step(now);
  if (const auto* sample = samples_.latest(); sample != nullptr) {
    step_sensors(sample->value, now);
  }
}

void LoopedWorld::step_sensors(const WorldSample& sample, Time now) {
  const double share = thrusters_ ? thrusters_->device->share() : 0.0;
  if (ahrs_) {
    ahrs_->begin(faults_, now);
    ahrs_->device->feel(sample, share, now);
    ahrs_->feed->pump(now);
    ring(ahrs_bell_);
  }
  if (position_) {
    position_->begin(faults_, now);
    position_->device->feel(sample, share, now);
    position_->feed->pump(now);
    ring(position_bell_);
  }
  if (sonar_) {
    if (!sonar_->sonar) {
      sonar_->sonar.emplace(sonar_->options, faults_, now);
    }
    sonar_->sonar->feel(sample, now);
    sonar_->sonar->exchange(sonar_->datagrams.far_end(), now);
    ring(sonar_bell_);
  }
}

}  // namespace lodesman
