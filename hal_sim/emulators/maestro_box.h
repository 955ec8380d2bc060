// SPDX-License-Identifier: Apache-2.0
// A Pololu Maestro servo controller to the byte, with the settings that its owner gives it: what it
// is sent over USB, what it answers, and which pulses it puts out. One thread.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "hal_sim/emulators/chance.h"
#include "hal_sim/emulators/faulty_device.h"

namespace lodesman {

enum class MaestroMode : std::uint8_t {
  kUartDetect,   // as it leaves the factory: what comes over USB is ignored
  kUsbDualPort,  // the first of its two ports takes commands
};

// What a channel does when the box starts, and after an error.
enum class MaestroHome : std::uint8_t {
  kOff,     // no pulses
  kIgnore,  // no pulses at the start; after an error it goes on
  kGoTo,    // pulses of a length of its own
};

struct MaestroChannel {
  MaestroHome home = MaestroHome::kOff;
  std::uint16_t home_quarter_us = 6000;
  std::uint16_t least_quarter_us = 3968;  // 992 us
  std::uint16_t most_quarter_us = 8000;   // 2000 us
  // Of targets of eight bits: 127 is neutral, 0 and 254 are a range away.
  std::uint16_t neutral_quarter_us = 6000;
  std::uint16_t range_quarter_us = 1905;
};

struct MaestroBoxOptions {
  static constexpr std::size_t kMaxChannels = 24;

  MaestroMode mode = MaestroMode::kUsbDualPort;
  bool crc = false;
  std::uint8_t device_number = 12;
  std::uint8_t mini_ssc_offset = 0;
  std::uint16_t time_out_10ms = 0;  // 0: it does not stop by itself
  // 6: a Micro Maestro; 12, 18, 24: a Mini, which knows targets for several channels at once.
  std::size_t channels = 6;
  std::array<MaestroChannel, kMaxChannels> channel{};
  std::uint64_t seed = 0;
};

class MaestroBox final : public FaultyDevice {
 public:
  // The bits of its error register.
  enum class Error : std::uint16_t {
    kSignal = 0x0001,
    kOverrun = 0x0002,
    kBufferFull = 0x0004,
    kCrc = 0x0008,
    kProtocol = 0x0010,
    kTimeOut = 0x0020,
  };

  MaestroBox(const MaestroBoxOptions& options, Time now);

  // What goes out now, in quarters of a microsecond; 0: no pulses.
  [[nodiscard]] std::uint16_t pulse_quarter_us(std::size_t channel) const noexcept;
  [[nodiscard]] std::uint16_t errors() const noexcept { return errors_; }
  // Its supply dips: no pulses anywhere, and the error register is clear.
  void brown_out(Time now) noexcept;
  // Owner's settings, changed while it runs.
  [[nodiscard]] MaestroBoxOptions& options() noexcept { return options_; }

  void step(Time now, std::vector<Utterance>& said) override;
  void receive(std::span<const std::uint8_t> bytes, Time at, std::vector<Utterance>& said) override;
  void power_cycle(Time now) override;
  [[nodiscard]] int baud() const override { return 0; }
  [[nodiscard]] bool has_fault(FaultKind kind) const noexcept override;

 protected:
  void begun(const Fault& fault, Time now) override;

 private:
  struct Command {
    std::uint8_t number = 0;  // as the compact protocol has it: 0x84
    std::size_t data = 0;     // so many bytes follow
  };

  void take(std::uint8_t byte, Time at, std::vector<Utterance>& said);
  void take_target_of_mini_ssc(Time at);
  [[nodiscard]] std::optional<Command> command_at(std::size_t head) const noexcept;
  void look(Time at, std::vector<Utterance>& said);
  void obey(std::uint8_t number, std::span<const std::uint8_t> data, Time at,
            std::vector<Utterance>& said);
  void set_target(std::size_t channel, std::uint16_t quarter_us) noexcept;
  void go_home() noexcept;
  void raise(Error error) noexcept;
  void rearm(Time at) noexcept;
  void watch_time_out(Time now) noexcept;
  void err_at_random(Time now) noexcept;

  MaestroBoxOptions options_;
  RandomStream random_errors_;
  emulated::Recurrence errors_due_;
  std::array<std::uint16_t, MaestroBoxOptions::kMaxChannels>
      pulses_{};  // quarters of a microsecond
  std::uint16_t errors_ = 0;
  std::vector<std::uint8_t> held_;  // of the command that is coming in
  Time heard_{};                    // the last valid command
  bool timed_out_ = false;          // since then
  Time stepped_{};
};

}  // namespace lodesman
