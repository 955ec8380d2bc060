// SPDX-License-Identifier: Apache-2.0
// Benches of the satellite receivers' drivers: each at the end of a line in memory, at whose far
// end what belongs to a fix is said five times a second. What a bench is says bench.h. One thread.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>

#include "drivers/gpsd/gpsd_receiver.h"
#include "drivers/nmea/nmea_receiver.h"
#include "drivers/stream/memory_line.h"
#include "tests/conformance/bench.h"

namespace lodesman::conformance {

// A boat that sails north from 35 N, 138.9 E; fix n is at 12:00:00 and n fifths of a second.
[[nodiscard]] inline std::string clock_of_fix(int n, const char* form) {
  return fmt::format(fmt::runtime(form), n / 300 % 60, n / 5 % 60, n % 5 * 2);
}

struct SpeaksNmea {
  [[nodiscard]] static std::string fix(int n) {
    const std::string time = clock_of_fix(n, "12{:02}{:02}.{}");
    const std::string place = fmt::format("3501.{:05},N,13854.00000,E", n % 100000);
    return closed("$GPGGA," + time + "," + place + ",1,08,0.9,12.4,M,39.7,M,,") +
           closed("$GPRMC," + time + ",A," + place + ",0.972,000.0,211126,,,A");
  }
  [[nodiscard]] static std::unique_ptr<PositionSensor> driver(ByteStream& line) {
    return std::make_unique<NmeaReceiver>(line, NmeaOptions{});
  }

 private:
  [[nodiscard]] static std::string closed(const std::string& sentence) {
    return fmt::format("{}*{:02X}\r\n", sentence, nmea_checksum(sentence.substr(1)));
  }
};

struct SpeaksGpsd {
  [[nodiscard]] static std::string fix(int n) {
    return R"({"class":"TPV","device":"/dev/pts/3","mode":3,"time":"2026-11-21T)" +
           clock_of_fix(n, "12:{:02}:{:02}.{}Z") +
           fmt::format(R"(","lat":35.01{:05},"lon":138.9,"speed":0.5,"track":0.0}})", n % 100000) +
           "\r\n";
  }
  [[nodiscard]] static std::unique_ptr<PositionSensor> driver(ByteStream& line) {
    return std::make_unique<GpsdReceiver>(line, GpsdOptions{});
  }
};

template <class Speaks>
class ReceiverBench {
 public:
  ReceiverBench() { static_cast<void>(driver_->poll(now_)); }

  [[nodiscard]] PositionSensor& device() noexcept { return *driver_; }
  [[nodiscard]] Time now() const noexcept { return now_; }
  [[nodiscard]] static Duration period() noexcept { return std::chrono::milliseconds{200}; }
  [[nodiscard]] static Duration recovery() noexcept { return 3 * period(); }

  void pass(Duration span) {
    for (const Time end = now_ + span; now_ < end;) {
      now_ = std::min(now_ + std::chrono::milliseconds{10}, end);
      for (; due_ <= now_; due_ += period()) {
        say();
      }
    }
  }
  void fail(BenchFault fault) {
    fault_ = fault;
    fails_ = true;
    if (fault == BenchFault::kDisconnect) {
      line_->unplug();
    }
  }
  void mend() {
    fails_ = false;
    line_->plug();
    due_ = now_ + period();
  }
  void come_up() { poll_until_fresh(*this); }

 private:
  // The commands of a driver are taken and not obeyed.
  void say() {
    std::array<std::uint8_t, 256> heard{};
    static_cast<void>(line_->receive(heard, now_));
    std::string text = Speaks::fix(++fix_);
    if (fails_ && fault_ == BenchFault::kStall) {
      return;
    }
    if (fails_ && fault_ == BenchFault::kCorrupt) {
      // So that no sum and no object is whole.
      std::replace(text.begin(), text.end(), '*', '0');
      std::replace(text.begin(), text.end(), ':', ';');
    }
    for (const char letter : text) {
      static_cast<void>(line_->send(static_cast<std::uint8_t>(letter), now_));
    }
  }

  Time now_{std::chrono::seconds{10}};
  Time due_{std::chrono::seconds{10}};
  std::unique_ptr<MemoryLine> line_ = std::make_unique<MemoryLine>();
  std::unique_ptr<PositionSensor> driver_ = Speaks::driver(line_->near_end());
  BenchFault fault_ = BenchFault::kStall;
  bool fails_ = false;
  int fix_ = 0;
};

using NmeaBench = ReceiverBench<SpeaksNmea>;
using GpsdBench = ReceiverBench<SpeaksGpsd>;

}  // namespace lodesman::conformance
