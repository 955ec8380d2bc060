// SPDX-License-Identifier: Apache-2.0
// A Maestro of few words for the tests of its driver, with constants of its own, and the bench that
// it stands on: a line in memory, time in steps, and everything that left the driver.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <vector>

#include "drivers/maestro/maestro.h"
#include "drivers/stream/memory_line.h"

namespace lodesman::testing {

inline constexpr ThrustCommand kAhead{191, 191};  // 63 of 127
inline constexpr int kAheadPulse = 6000 + 15 * 63;

struct MaestroBoxSettings {
  bool deaf = false;          // serial mode "UART, detect baud rate"
  int time_out_ms = 500;      // 0: none
  bool keeps_pulses = false;  // error action "Ignore"
  int home = 6000;            // [quarter us] error and start-up action "Go to"; 0: off
  bool crc = false;
};

class MaestroBox {
 public:
  explicit MaestroBox(MaestroBoxSettings chosen) : settings{chosen} { reset(); }

  void reset() {
    pulses.fill(settings.home);
    errors = 0;
    packet_.clear();
    heard_at_ = Time{};
  }
  void fail(unsigned bit) {
    errors |= 1U << bit;
    go_home();
  }

  void advance(Time now) {
    const bool armed = settings.time_out_ms > 0 && heard_at_ != Time{};
    if (armed && now - heard_at_ >= std::chrono::milliseconds{settings.time_out_ms}) {
      heard_at_ = Time{};
      fail(5);
    }
  }
  // What it answers to one more byte.
  std::vector<std::uint8_t> take(std::uint8_t byte, Time now) {
    if (settings.deaf) {
      return {};
    }
    if (byte >= 0x80) {
      if (!packet_.empty()) {
        fail(4);
      }
      packet_.clear();
    } else if (packet_.empty()) {
      fail(4);
      return {};
    }
    packet_.push_back(byte);
    if (packet_.size() < length()) {
      return {};
    }
    const std::vector<std::uint8_t> whole = packet_;
    packet_.clear();
    heard_at_ = now;
    ++commands;
    return obey(whole);
  }

  MaestroBoxSettings settings;
  std::array<int, 24> pulses{};  // [quarter us] put out
  unsigned errors = 0;
  int commands = 0;
  int refused_channel = -1;

 private:
  [[nodiscard]] std::size_t length() const {
    const std::size_t bare = packet_[0] == 0x84 ? 4 : packet_[0] == 0x90 ? 2 : 1;
    return bare + (settings.crc ? 1 : 0);
  }
  void go_home() {
    if (!settings.keeps_pulses) {
      pulses.fill(settings.home);
    }
  }
  std::vector<std::uint8_t> obey(const std::vector<std::uint8_t>& packet) {
    const auto word = [](unsigned value) {
      return std::vector<std::uint8_t>{static_cast<std::uint8_t>(value & 0xFFU),
                                       static_cast<std::uint8_t>(value >> 8U)};
    };
    switch (packet[0]) {
      case 0x84:
        if (packet[1] != refused_channel) {
          pulses.at(packet[1]) = packet[2] + packet[3] * 128;
        }
        return {};
      case 0x90: return word(static_cast<unsigned>(pulses.at(packet[1])));
      case 0xA1: return word(std::exchange(errors, 0U));
      default: fail(4); return {};
    }
  }

  std::vector<std::uint8_t> packet_;
  Time heard_at_{};  // last command; Time{}: not armed
};

class MaestroBench {
 public:
  explicit MaestroBench(MaestroBoxSettings settings = {}, MaestroOptions options = {},
                        ThrustShapeOptions shape = {})
      : box{settings},
        line{std::make_unique<MemoryLine>()},
        driver{line->near_end(), options, shape} {}

  // One call, and the 50 ms to the next.
  CommandStatus step(ThrustCommand command = kNeutralThrust, int ms = 50) {
    sent.clear();
    status = driver.command(command, now);
    pass(ms);
    return status;
  }
  void pass(int ms) {
    for (const Time end = now + std::chrono::milliseconds{ms}; now < end;) {
      now += std::chrono::milliseconds{1};
      box.advance(now);
      if (answers) {
        exchange();
      }
    }
  }
  // Neutral until it is taken, or so many steps.
  bool start(int most = 200) {
    for (int i = 0; i < most; ++i) {
      if (step() == CommandStatus::kTaken) {
        return true;
      }
    }
    return false;
  }
  [[nodiscard]] bool neutral() const {
    return box.pulses[0] == box.settings.home && box.pulses[1] == box.settings.home;
  }
  // Within a microsecond of it, as while the time-out is proved.
  [[nodiscard]] bool nearly_neutral() const {
    return std::abs(box.pulses[0] - 6000) <= 4 && std::abs(box.pulses[1] - 6000) <= 4;
  }

  MaestroBox box;
  std::unique_ptr<MemoryLine> line;
  Maestro driver;
  Time now{std::chrono::seconds{100}};
  CommandStatus status = CommandStatus::kTaken;
  std::vector<std::uint8_t> sent;  // since the last call began
  bool answers = true;             // false: it neither hears nor speaks
  // What becomes of an answer on its way; none: it arrives as it is.
  std::function<void(std::vector<std::uint8_t>&)> damage;
  int reply_delay_ms = 1;

 private:
  void exchange() {
    std::array<std::uint8_t, 64> bytes{};
    const std::size_t count = line->receive(bytes, now).count;
    for (std::size_t i = 0; i < count; ++i) {
      sent.push_back(bytes[i]);
      std::vector<std::uint8_t> reply = box.take(bytes[i], now);
      if (damage && !reply.empty()) {
        damage(reply);
      }
      for (const std::uint8_t byte : reply) {
        line->send(byte, now + std::chrono::milliseconds{reply_delay_ms});
      }
    }
  }
};

}  // namespace lodesman::testing
