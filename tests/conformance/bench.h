// SPDX-License-Identifier: Apache-2.0
// What a suite needs of an implementation: the device on a bench with a time of its own, and means
// to pull its plug. One thread.
//
// A bench for contract C is a default-constructible class with
//   C& device();                    the device under test
//   Time now();                     the bench's time
//   void pass(Duration);            lets time pass; what stands behind the device keeps working
//   static Duration period();       between two samples of a sensor
//   void fail(BenchFault);          from now on, until mend()
//   void mend();
//   void come_up();                 uses it as its task does until it serves: a sensor brings its
//                                   first sample, a box has taken neutral. What is real is found,
//                                   asked and tried first; what is simulated serves at once.
//   static Duration recovery();     from mend() to a sensor's first sample, at the longest
// and for thrusters
//   ThrustCommand applied();        what the propellers are told now
//   static Duration time_out();     after which the box stops them by itself
//   static int steps_to_apply();    a command given in so many steps in a row is applied
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>

#include "drivers/hal/devices.h"
#include "hal_sim/devices/sim_heading_sensor.h"
#include "hal_sim/devices/sim_position_sensor.h"
#include "hal_sim/devices/sim_sonar.h"
#include "hal_sim/devices/sim_thruster_pair.h"

namespace lodesman::conformance {

enum class BenchFault { kStall, kCorrupt, kDisconnect };

// How often its task uses a device. Far more steps than any needs to come up: a bench whose device
// does not fails in the suite.
inline constexpr Duration kTaskPeriod = std::chrono::milliseconds{50};
inline constexpr int kStepsToComeUp = 1000;

template <class Bench>
void poll_until_fresh(Bench& bench) {
  for (int i = 0; i < kStepsToComeUp; ++i) {
    bench.pass(Bench::period() / 4);
    if (bench.device().poll(bench.now()).status == ReadStatus::kFresh) {
      return;
    }
  }
}

template <class Bench>
void command_until_taken(Bench& bench) {
  for (int i = 0; i < kStepsToComeUp; ++i) {
    if (bench.device().command(kNeutralThrust, bench.now()) == CommandStatus::kTaken) {
      return;
    }
    bench.pass(kTaskPeriod);
  }
}

// A world that moves on by hand, and the simulated device D of contract C in it. The faults are
// those of a scenario: pulling the plug jumps to the scenario time at which it is pulled.
template <class C, class D, FaultDevice kDevice, SonarScene kScene = SonarScene::kBeams>
class SimBench {
 public:
  [[nodiscard]] C& device() noexcept { return *device_; }
  [[nodiscard]] Time now() const noexcept { return now_; }

  void pass(Duration span) {
    for (const Time end = now_ + span; now_ < end;) {
      now_ = std::min(now_ + kWorldPeriod, end);
      if (now_ - last_sample_ >= kWorldPeriod) {
        publish();
      }
    }
  }

  void fail(BenchFault fault) {
    scenario_time_s_ = 1000.0 * (1.0 + static_cast<double>(fault));
    publish_next();
  }
  void mend() {
    scenario_time_s_ = 0.0;
    publish_next();
  }

  void come_up() noexcept {}

  [[nodiscard]] ThrustCommand applied() noexcept { return thrust_at(box_, now_); }
  [[nodiscard]] static Duration time_out() noexcept { return kBoxTimeOut; }
  [[nodiscard]] static int steps_to_apply() noexcept { return 1; }

 private:
  static constexpr Duration kWorldPeriod = std::chrono::milliseconds{20};

  [[nodiscard]] static Scenario scenario() {
    Scenario scenario;
    scenario.seed = 1;
    scenario.sonar.scene = kScene;
    if (kScene == SonarScene::kDetections) {
      scenario.sonar.detections = {0.1, 0.1, 0.1, 0.5, 0.05};
    }
    MovingObstacle circle;
    circle.at_start.centre_y_m = 10.0;
    circle.at_start.semi_axis_first_m = circle.at_start.semi_axis_second_m = 0.5;
    scenario.obstacles = {circle};
    scenario.faults = {{kDevice, FaultKind::kStall, 1000.0, 500.0},
                       {kDevice, FaultKind::kCorrupt, 2000.0, 500.0},
                       {kDevice, FaultKind::kDisconnect, 3000.0, 500.0}};
    return scenario;
  }

  void publish_next() {
    now_ += kWorldPeriod;
    publish();
  }
  void publish() {
    last_sample_ = now_;
    WorldSample sample;
    sample.stamp = now_;
    sample.started = 1;
    sample.scenario_time_s = scenario_time_s_ += 0.02;
    sample.heading_rad = std::remainder(0.05 * scenario_time_s_, 6.28);
    sample.yaw_rate_rad_s = 0.05;
    sample.x_m = 0.1 * scenario_time_s_;
    world_.publish(sample, now_);
  }

  std::unique_ptr<SimLink> link_ = std::make_unique<SimLink>();
  Writer<WorldSample> world_{link_->world, Role::kLow, "world sample"};
  Reader<SimThrust> box_{link_->thrust};
  Time now_{std::chrono::seconds{10}};
  Time last_sample_{};
  double scenario_time_s_ = 0.0;
  std::unique_ptr<D> device_ = std::make_unique<D>(scenario(), *link_);
};

struct SimHeadingBench : SimBench<HeadingSensor, SimHeadingSensor, FaultDevice::kAhrs> {
  [[nodiscard]] static Duration period() noexcept { return std::chrono::milliseconds{20}; }
  [[nodiscard]] static Duration recovery() noexcept { return 2 * period(); }
};
struct SimPositionBench : SimBench<PositionSensor, SimPositionSensor, FaultDevice::kPosition> {
  [[nodiscard]] static Duration period() noexcept { return std::chrono::milliseconds{200}; }
  [[nodiscard]] static Duration recovery() noexcept { return 2 * period(); }
};
template <SonarScene kScene>
struct SimPingBench : SimBench<ImagingSonar, SimSonar, FaultDevice::kSonar, kScene> {
  [[nodiscard]] static Duration period() noexcept { return std::chrono::milliseconds{100}; }
  [[nodiscard]] static Duration recovery() noexcept { return 2 * period(); }
};
using SimSonarBench = SimPingBench<SonarScene::kBeams>;
using SimDetectionsBench = SimPingBench<SonarScene::kDetections>;
struct SimThrusterBench : SimBench<ThrusterPair, SimThrusterPair, FaultDevice::kThruster> {};

}  // namespace lodesman::conformance
