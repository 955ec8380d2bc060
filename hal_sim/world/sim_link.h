// SPDX-License-Identifier: Apache-2.0
// The wire between the world and the simulated devices, inside one process: what the sensors can
// sense, and what the thruster box was last told. Each end is held by one thread, through a Reader
// or a Writer of its own.
#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>

#include "drivers/hal/devices.h"
#include "mid_level/base/frames.h"
#include "mid_level/blackboard/channel.h"
#include "mid_level/messages/fields.h"

namespace lodesman {

// Written by the world task at every step (50 Hz); read by each simulated device.
struct WorldSample {
  Time stamp{};                  // [ns] the time this state belongs to
  std::uint8_t started = 0;      // [-] 1 once a mission has started: faults act from then on
  double scenario_time_s = 0.0;  // [s] since the mission's start; 0 before it
  double x_m = 0.0;              // [m] [world]
  double y_m = 0.0;              // [m] [world]
  double heading_rad = 0.0;      // [rad] [-pi, pi]
  double surge_m_s = 0.0;        // [m/s] over ground, along the heading
  double sway_m_s = 0.0;         // [m/s] over ground, to starboard
  double yaw_rate_rad_s = 0.0;   // [rad/s] clockwise positive
  double thrust_load = 0.0;      // [-] [0, 1] of the simulated thrusters, as thrust_load() has it

  [[nodiscard]] VehiclePose pose() const noexcept {
    return {{{x_m, y_m}}, Heading::clockwise_from_y_rad(heading_rad)};
  }

  static constexpr auto fields() noexcept {
    using W = WorldSample;
    return field_list(field("stamp", &W::stamp), field("started", &W::started),
                      field("scenario_time_s", &W::scenario_time_s), field("x_m", &W::x_m),
                      field("y_m", &W::y_m), field("heading_rad", &W::heading_rad),
                      field("surge_m_s", &W::surge_m_s), field("sway_m_s", &W::sway_m_s),
                      field("yaw_rate_rad_s", &W::yaw_rate_rad_s),
                      field("thrust_load", &W::thrust_load));
  }
};

// Written by the simulated thruster box at each command that it took; read by the world task.
struct SimThrust {
  std::uint8_t left = 128;   // [-] [0, 255] 127 and 128 stop
  std::uint8_t right = 128;  // [-] [0, 255]

  static constexpr auto fields() noexcept {
    return field_list(field("left", &SimThrust::left), field("right", &SimThrust::right));
  }
};

// When a simulated sensor has its next sample: said by its own thread, so that the world rings for
// it then. What is said too late costs one ring more.
class SampleDue {
 public:
  // The world's steps come with the jitter of its thread: a sample so early is due.
  static constexpr Duration kEarly_max = std::chrono::milliseconds{5};

  void next_at(Time at) noexcept {
    at_ns_.store(at.time_since_epoch().count(), std::memory_order_relaxed);
  }
  [[nodiscard]] bool has_come(Time now) const noexcept {
    const Time next{Duration{at_ns_.load(std::memory_order_relaxed)}};
    return now + kEarly_max >= next;
  }

 private:
  std::atomic<std::int64_t> at_ns_{0};
};

struct SimLink {
  Channel<WorldSample, 64> world;
  Channel<SimThrust, 8> thrust;
  SampleDue heading_due;
  SampleDue position_due;
  SampleDue sonar_due;
};

// The box stops both thrusters by itself when no command came for longer than this (ours: the
// longest that is sensible for the boxes the drivers know).
inline constexpr Duration kBoxTimeOut = std::chrono::milliseconds{1000};

// What the thrusters do at `now`: the last command taken, or neutral after the box's time-out.
[[nodiscard]] inline ThrustCommand thrust_at(Reader<SimThrust>& box, Time now) noexcept {
  const Stamped<SimThrust>* taken = box.fresh(now, kBoxTimeOut);
  return taken == nullptr ? kNeutralThrust : ThrustCommand{taken->value.left, taken->value.right};
}

// [-] [0, 1] What the thrusters disturb others by: the mean of both commands' squares, of full
// ones.
[[nodiscard]] inline double thrust_load(ThrustCommand command) noexcept {
  static constexpr double kFullOffset = 127.0;
  const auto load_of = [](std::uint8_t one) {
    const double offset = std::min(std::abs(static_cast<double>(one) - 128.0), kFullOffset);
    return offset * offset / (kFullOffset * kFullOffset);
  };
  return (load_of(command.left) + load_of(command.right)) / 2.0;
}

}  // namespace lodesman
