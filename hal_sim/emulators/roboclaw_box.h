// SPDX-License-Identifier: Apache-2.0
// A RoboClaw motor controller for two brushed motors to the byte: what it is sent, what it answers,
// and what it puts on its motors. One thread.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "hal_sim/emulators/faulty_device.h"

namespace lodesman {

struct RoboClawBoxOptions {
  std::uint8_t address = 0x80;             // [0x80, 0x87]
  std::uint8_t stored_time_out_100ms = 0;  // that it starts with; 0: it does not stop by itself
  std::size_t status_bytes = 4;            // 2 in older firmware
  std::string version = "USB Roboclaw 2x15a v4.1.34";
  double battery_volts = 25.2;  // without load
  double sag_volts = 1.5;       // less than that with both motors full
  double logic_volts = 5.0;
  double full_current_a = 10.0;  // of one motor
  double temperature_c = 25.0;
};

class RoboClawBox final : public FaultyDevice {
 public:
  static constexpr std::size_t kMotors = 2;

  RoboClawBox(const RoboClawBoxOptions& options, Time now);

  // [-32767, 32767] what a motor gets now.
  [[nodiscard]] int duty(std::size_t motor) const noexcept;
  [[nodiscard]] double battery_volts() const noexcept;

  void step(Time now, std::vector<Utterance>& said) override;
  void receive(std::span<const std::uint8_t> bytes, Time at, std::vector<Utterance>& said) override;
  void power_cycle(Time now) override;
  [[nodiscard]] int baud() const override { return 0; }
  [[nodiscard]] bool has_fault(FaultKind kind) const noexcept override;

 protected:
  void begun(const Fault& fault, Time now) override;

 private:
  using Bytes = std::vector<std::uint8_t>;

  void look(Time at, std::vector<Utterance>& said);
  // False for what is no order, or one that it does not take.
  [[nodiscard]] bool order(std::uint8_t command, std::span<const std::uint8_t> data) noexcept;
  [[nodiscard]] Bytes answer(std::uint8_t command) const;
  void watch_time_out(Time now) noexcept;

  RoboClawBoxOptions options_;
  std::array<int, kMotors> duty_{};
  std::uint8_t time_out_100ms_ = 0;
  Bytes held_;         // of the packet that is coming in
  bool deaf_ = false;  // to the rest of what it does not know, until a pause
  Time last_byte_{};
  Time heard_{};  // the last packet that was whole
};

}  // namespace lodesman
