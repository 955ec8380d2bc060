// SPDX-License-Identifier: Apache-2.0
// Benches of the real drivers: each over the emulated device that belongs to it, on a line in
// memory whose bytes take their time. What a bench is says bench.h. One thread.
#pragma once

#include <memory>

#include "drivers/maestro/maestro.h"
#include "drivers/nav440/nav440.h"
#include "drivers/roboclaw/roboclaw.h"
#include "hal_sim/emulators/emulated_ahrs.h"
#include "hal_sim/emulators/emulated_thrusters.h"
#include "tests/conformance/bench.h"

namespace lodesman::conformance {

// An emulated device E (an EmulatedAhrs, say) on a line, and time that passes for both.
template <class E, class Options>
class LoopBench {
 public:
  explicit LoopBench(const Options& options)
      : emulated_{options, {}, now_}, feed_{emulated_.device(), emulated_.wire(), *line_} {}
  LoopBench(const LoopBench&) = delete;
  LoopBench& operator=(const LoopBench&) = delete;
  virtual ~LoopBench() = default;

  [[nodiscard]] Time now() const noexcept { return now_; }

  void pass(Duration span) {
    for (const Time end = now_ + span; now_ < end;) {
      now_ = std::min(now_ + kStep, end);
      step();
    }
  }

  // A silent line, a wrong byte in all that the device says, a plug that is out: whole from the
  // first step on and until it is mended.
  void fail(BenchFault fault) {
    fault_.kind = fault == BenchFault::kStall     ? FaultKind::kStall
                  : fault == BenchFault::kCorrupt ? FaultKind::kCorrupt
                                                  : FaultKind::kDisconnect;
    emulated_.wire().begin_fault(fault_, now_);
    step();
  }
  void mend() {
    emulated_.wire().end_fault(fault_);
    step();
  }

 protected:
  [[nodiscard]] ByteStream& line() noexcept { return line_->near_end(); }
  [[nodiscard]] E& emulated() noexcept { return emulated_; }

  virtual void step() { feed_.pump(now_); }

 private:
  static constexpr Duration kStep = std::chrono::milliseconds{1};

  Time now_{std::chrono::seconds{10}};
  std::unique_ptr<MemoryLine> line_ = std::make_unique<MemoryLine>();
  E emulated_;
  LineFeed feed_;
  Fault fault_;
};

class Nav440Bench : public LoopBench<EmulatedAhrs, EmulatedAhrsOptions> {
 public:
  Nav440Bench() : LoopBench{{}} {}

  [[nodiscard]] HeadingSensor& device() noexcept { return driver_; }
  [[nodiscard]] static Duration period() noexcept { return std::chrono::milliseconds{20}; }
  // A start-up, twice over.
  [[nodiscard]] static Duration recovery() noexcept { return std::chrono::milliseconds{600}; }

  void come_up() { poll_until_fresh(*this); }

 private:
  void step() override {
    WorldSample sample;
    sample.stamp = now();
    sample.yaw_rate_rad_s = 0.05;
    sample.heading_rad = std::remainder(0.05 * to_seconds(now() - Time{}), 6.28);
    emulated().feel(sample, 0.0, now());
    LoopBench::step();
  }

  Nav440 driver_{line(), Nav440Options{}};
};

template <class Driver, class DriverOptions, ThrusterBoxKind kKind>
class BoxBench : public LoopBench<EmulatedThrusters, EmulatedThrustersOptions> {
 public:
  BoxBench() : LoopBench{as_asked()} {}

  [[nodiscard]] ThrusterPair& device() noexcept { return driver_; }
  [[nodiscard]] ThrustCommand applied() {
    const SimThrust output = emulated().output(now());
    return {output.left, output.right};
  }
  [[nodiscard]] static Duration time_out() { return DriverOptions{}.time_out; }
  // Neutral is commanded until it is taken: the box has been seen to stop by itself then.
  void come_up() { command_until_taken(*this); }
  // From time to time something is asked in place of a command.
  [[nodiscard]] static int steps_to_apply() noexcept { return 2; }

 private:
  [[nodiscard]] static EmulatedThrustersOptions as_asked() {
    EmulatedThrustersOptions options;
    options.kind = kKind;
    options.time_out = time_out();
    return options;
  }

  Driver driver_{line(), DriverOptions{}, ThrustShapeOptions{}};
};

using MaestroBench = BoxBench<Maestro, MaestroOptions, ThrusterBoxKind::kMaestro>;
using RoboClawBench = BoxBench<RoboClaw, RoboClawOptions, ThrusterBoxKind::kRoboClaw>;

}  // namespace lodesman::conformance
