// SPDX-License-Identifier: Apache-2.0
// What the suite of the byte streams asks of each implementation: a line, and its far end in the
// test's hand. Time is handed to the line and passes as the test will have it; threads of a line's
// own are waited for beside that.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "drivers/stream/make_line.h"
#include "drivers/stream/memory_line.h"
#include "drivers/stream/reconnecting_line.h"
#include "drivers/stream/serial_port.h"
#include "drivers/stream/termios_port.h"
#include "drivers/stream/tty.h"
#include "tests/support/pty_device.h"

namespace lodesman::conformance {

using Bytes = std::vector<std::uint8_t>;

class BenchClock {
 public:
  [[nodiscard]] Time now() const { return now_; }
  void pass(Duration step) { now_ += step; }

 private:
  Time now_{std::chrono::seconds{1}};
};

class MemoryLineBench : public BenchClock {
 public:
  [[nodiscard]] ByteStream& line() { return line_->near_end(); }
  std::size_t device_sends(std::span<const std::uint8_t> bytes) {
    std::size_t sent = 0;
    while (sent < bytes.size() && line_->send(bytes[sent], now())) {
      ++sent;
    }
    return sent;
  }
  std::size_t device_receives(std::span<std::uint8_t> into) {
    return line_->receive(into, now()).count;
  }
  void unplug() { line_->unplug(); }
  void plug() { line_->plug(); }
  [[nodiscard]] bool settles(const std::function<bool()>& holds) {
    constexpr int kMaxSteps = 10000;
    for (int step = 0; step < kMaxSteps; ++step) {
      pass(std::chrono::milliseconds{1});
      if (holds()) {
        return true;
      }
    }
    return false;
  }

 private:
  std::unique_ptr<MemoryLine> line_ = std::make_unique<MemoryLine>();
};

// As the boat opens a pty.
struct OpensPty {
  static OpenedPort open(const std::string& path, int baud) { return open_port(path, baud); }
};
// libserialport over a pty, which interposed.h makes it take for a serial port.
struct OpensSerialPort {
  static OpenedPort open(const std::string& path, int baud) {
    TtyClaim claim = claim_tty(path);
    return claim.fault == DeviceFault::kNone ? SerialPort::open(std::move(claim), baud)
                                             : OpenedPort{nullptr, claim.fault};
  }
};

template <class Opens>
class PortBench : public BenchClock {
 public:
  static constexpr int kBaud = 57600;

  [[nodiscard]] testing::PtyDevice& device() { return device_; }
  [[nodiscard]] ByteStream& line() {
    if (!line_) {
      line_ = make(device_.path());
    }
    return *line_;
  }
  void drop_line() { line_.reset(); }
  [[nodiscard]] static std::unique_ptr<ByteStream> make(const std::string& path,
                                                        std::function<void()> on_bytes = {}) {
    return std::make_unique<ReconnectingLine>(path, kBaud, Opens::open, std::move(on_bytes));
  }

  std::size_t device_sends(std::span<const std::uint8_t> bytes) { return device_.send(bytes); }
  std::size_t device_receives(std::span<std::uint8_t> into) { return device_.receive(into); }
  void unplug() { device_.unplug(); }
  void plug() { device_.plug(); }
  [[nodiscard]] bool settles(const std::function<bool()>& holds) {
    return testing::eventually([&] {
      pass(std::chrono::milliseconds{1});
      return holds();
    });
  }

 private:
  testing::PtyDevice device_;
  std::unique_ptr<ByteStream> line_;
};

using PtyBench = PortBench<OpensPty>;
using SerialPortBench = PortBench<OpensSerialPort>;

// The number of the connection that there comes to be.
template <class Bench>
[[nodiscard]] std::uint64_t connect(Bench& bench) {
  std::uint64_t number = 0;
  REQUIRE(bench.settles([&] { return (number = bench.line().connection(bench.now())) != 0; }));
  return number;
}

// Reads until there are so many.
template <class Bench>
[[nodiscard]] Bytes read_bytes(Bench& bench, std::size_t count) {
  Bytes got;
  Bytes piece(257);
  const bool all = bench.settles([&] {
    const std::size_t some =
        bench.line()
            .read(std::span{piece}.first(std::min(piece.size(), count - got.size())), bench.now())
            .count;
    got.insert(got.end(), piece.begin(), piece.begin() + static_cast<std::ptrdiff_t>(some));
    return got.size() >= count;
  });
  CHECK(all);
  return got;
}

template <class Bench>
[[nodiscard]] Bytes receive_bytes(Bench& bench, std::size_t count) {
  Bytes got;
  Bytes piece(257);
  const bool all = bench.settles([&] {
    const std::size_t some = bench.device_receives(piece);
    got.insert(got.end(), piece.begin(), piece.begin() + static_cast<std::ptrdiff_t>(some));
    return got.size() >= count;
  });
  CHECK(all);
  return got;
}

// Every value, with steps that no smaller buffer has in common.
[[nodiscard]] inline Bytes pattern(std::size_t count, std::size_t from = 0) {
  Bytes bytes(count);
  for (std::size_t i = 0; i < count; ++i) {
    bytes[i] = static_cast<std::uint8_t>((from + i) * 7 + (from + i) / 256);
  }
  return bytes;
}

// Reads once; whether nothing is there.
template <class Bench>
[[nodiscard]] bool is_silent(Bench& bench) {
  Bytes piece(64);
  return bench.line().read(piece, bench.now()).count == 0;
}

// How many of this process's descriptors lead to such a device. A pty that was closed at its other
// end is gone from the file system, and the kernel says so behind its name.
[[nodiscard]] inline std::size_t descriptors_of(const std::string& node) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator{"/proc/self/fd"}) {
    std::error_code error;
    const std::string target = std::filesystem::read_symlink(entry.path(), error).string();
    count += target == node || target == node + " (deleted)" ? 1U : 0U;
  }
  return count;
}

template <class Bench>
[[nodiscard]] bool loses_its_connection(Bench& bench) {
  return bench.settles(
      [&] { return is_silent(bench) && bench.line().connection(bench.now()) == 0; });
}

}  // namespace lodesman::conformance
