// SPDX-License-Identifier: Apache-2.0
// A RoboClaw of few words for the tests of its driver, with constants of its own, and the bench
// that it stands on: a line in memory, time in steps, and everything that left the driver.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "drivers/roboclaw/roboclaw.h"
#include "drivers/stream/memory_line.h"

namespace lodesman::testing {

struct RoboClawBoxSettings {
  int address = 0x80;
  int stored_time_out = 0;      // [0.1 s] after a reset
  bool keeps_time_out = false;  // takes no other than the stored one
  bool long_status = true;
  int drift = 0;  // duty of its first motor that nobody asked for
};

class RoboClawBox {
 public:
  using Bytes = std::vector<std::uint8_t>;

  explicit RoboClawBox(RoboClawBoxSettings chosen) : settings{chosen} { reset(); }

  void reset() {
    duties = {0, 0};
    time_out = settings.stored_time_out;
    packet_.clear();
  }
  void advance(Time now) {
    if (!packet_.empty() && now - byte_at_ > std::chrono::milliseconds{10}) {
      packet_.clear();
    }
    if (time_out > 0 && now - heard_at_ >= std::chrono::milliseconds{100 * time_out}) {
      duties = {0, 0};
    }
  }
  Bytes take(std::uint8_t byte, Time now) {
    byte_at_ = now;
    packet_.push_back(byte);
    if (packet_[0] != settings.address) {
      packet_.clear();
      return {};
    }
    const std::size_t writes = packet_.size() < 2 ? 99
                               : packet_[1] == 34 ? 8
                               : packet_[1] == 14 ? 5
                                                  : 2;
    if (packet_.size() < writes) {
      return {};
    }
    const Bytes whole = packet_;
    packet_.clear();
    if (writes > 2 && crc(whole) != 0) {
      ++refused;
      return {};
    }
    heard_at_ = now;
    return obey(whole);
  }

  RoboClawBoxSettings settings;
  std::array<int, 2> duties{};
  int time_out = 0;  // [0.1 s]
  double volts = 25.2;
  std::uint64_t accepted = 0;  // duties
  std::uint64_t refused = 0;   // packets

 private:
  // Of a packet with its check behind it: 0.
  [[nodiscard]] static unsigned crc(const Bytes& bytes) {
    unsigned value = 0;
    for (const std::uint8_t byte : bytes) {
      for (unsigned mask = 0x80; mask != 0; mask >>= 1U) {
        const bool carry = ((value & 0x8000U) != 0) != ((byte & mask) != 0);
        value = (value << 1U & 0xFFFFU) ^ (carry ? 0x1021U : 0U);
      }
    }
    return value;
  }
  [[nodiscard]] static Bytes replied(const Bytes& request, Bytes data) {
    Bytes all = request;
    all.insert(all.end(), data.begin(), data.end());
    const unsigned check = crc(all);
    data.push_back(static_cast<std::uint8_t>(check >> 8U));
    data.push_back(static_cast<std::uint8_t>(check & 0xFFU));
    return data;
  }
  [[nodiscard]] static Bytes word(int value) {
    return {static_cast<std::uint8_t>(value >> 8 & 0xFF), static_cast<std::uint8_t>(value & 0xFF)};
  }
  Bytes obey(const Bytes& packet) {
    const auto duty = [&](std::size_t at) {
      return static_cast<int>(static_cast<std::int16_t>(packet[at] << 8 | packet[at + 1]));
    };
    const std::string name = "USB Roboclaw 2x30a v4.1.34\n";
    Bytes data;
    switch (packet[1]) {
      case 34:
        duties = {duty(2), duty(4)};
        ++accepted;
        return {0xFF};
      case 14:
        time_out = settings.keeps_time_out ? settings.stored_time_out : packet[2];
        return {0xFF};
      case 15: return replied(packet, {static_cast<std::uint8_t>(time_out)});
      case 21:
        data.assign(name.begin(), name.end());
        data.push_back(0);
        return replied(packet, data);
      case 24: return replied(packet, word(static_cast<int>(volts * 10.0 + 0.5)));
      case 48: {
        data = word(duties[0] + settings.drift);
        const Bytes second = word(duties[1]);
        data.insert(data.end(), second.begin(), second.end());
        return replied(packet, data);
      }
      case 90:
        return replied(packet, settings.long_status ? Bytes{0, 0, 0x12, 0x34} : Bytes{0x12, 0x34});
      default: return {};
    }
  }

  Bytes packet_;
  Time byte_at_{};
  Time heard_at_{};
};

class RoboClawBench {
 public:
  using Bytes = std::vector<std::uint8_t>;

  explicit RoboClawBench(RoboClawBoxSettings settings = {}, RoboClawOptions options = {},
                         ThrustShapeOptions shape = {})
      : box{settings},
        line{std::make_unique<MemoryLine>()},
        driver{line->near_end(), options, shape} {}

  // One call, and the time to the next.
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
      deliver();
    }
  }
  bool start(int most = 200) {
    for (int i = 0; i < most; ++i) {
      if (step() == CommandStatus::kTaken) {
        return true;
      }
    }
    return false;
  }
  [[nodiscard]] bool stopped() const { return box.duties == std::array{0, 0}; }

  RoboClawBox box;
  std::unique_ptr<MemoryLine> line;
  RoboClaw driver;
  Time now{std::chrono::seconds{100}};
  CommandStatus status = CommandStatus::kTaken;
  Bytes sent;           // since the last call began
  bool answers = true;  // false: it neither hears nor speaks
  // What becomes of an answer on its way, and how many ms later than others it comes.
  std::function<int(Bytes&)> damage;
  // What becomes of a byte on its way to the box.
  std::function<std::uint8_t(std::uint8_t)> noise;

 private:
  struct Late {
    Time at{};
    Bytes bytes;
  };

  void exchange() {
    std::array<std::uint8_t, 64> bytes{};
    const std::size_t count = line->receive(bytes, now).count;
    for (std::size_t i = 0; i < count; ++i) {
      sent.push_back(bytes[i]);
      Bytes reply = box.take(noise ? noise(bytes[i]) : bytes[i], now);
      const int late_ms = damage && !reply.empty() ? damage(reply) : 0;
      if (!reply.empty()) {
        late_.push_back({now + std::chrono::milliseconds{1 + late_ms}, reply});
      }
    }
  }
  // A late one may be overtaken.
  void deliver() {
    for (Late& late : late_) {
      if (late.at <= now) {
        for (const std::uint8_t byte : late.bytes) {
          line->send(byte, now);
        }
        late.bytes.clear();
      }
    }
    std::erase_if(late_, [](const Late& late) { return late.bytes.empty(); });
  }

  std::vector<Late> late_;
};

}  // namespace lodesman::testing
