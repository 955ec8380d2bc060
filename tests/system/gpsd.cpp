// SPDX-License-Identifier: Apache-2.0
// The driver on the gpsd that Debian ships, which reads a receiver at the end of a pty. Without
// gpsd these tests are skipped.
#include <ctime>

#include "drivers/gpsd/gpsd_receiver.h"
#include "drivers/stream/make_line.h"
#include "mid_level/base/clock.h"
#include "tests/support/pty_device.h"
#include "tests/system/gpsd_program.h"
#include "tests/system/program.h"
#include "tests/unit/nmea/sentence_lines.h"

namespace lodesman::testing {
namespace {

using std::chrono::milliseconds;

// gpsd, its receiver, and the driver, on the machine's own time: a gpsd hands it to time daemons.
class Bench {
 public:
  explicit Bench(fs::path program) : program_{std::move(program)} { start(); }

  void start() {
    gpsd_.emplace(program_, std::vector<std::string>{"-N", "-n", "-b", "-S", port_, pty_.node()});
  }
  void kill_gpsd() {
    kill(gpsd_->pid(), SIGKILL);
    REQUIRE(gpsd_->status() == 128 + SIGKILL);
  }
  void unplug() { pty_.hang_up(); }

  // The receiver speaks, or is silent, and the driver is polled, until it holds.
  [[nodiscard]] bool comes_to(bool speaks, const std::function<bool()>& holds) {
    const Time until = SteadyClock{}.now() + std::chrono::seconds{30};
    for (Time now = SteadyClock{}.now(); now < until; now = SteadyClock{}.now()) {
      if (speaks && now - spoke_ >= milliseconds{200}) {
        spoke_ = now;
        speak();
      }
      poll(now);
      if (holds()) {
        return true;
      }
      std::this_thread::sleep_for(milliseconds{2});
    }
    return false;
  }
  [[nodiscard]] DeviceFault fault() const { return driver_.fault(); }

  ReadStatus status = ReadStatus::kNothingNew;
  PositionFix fix;
  Time newest{};
  int fixes = 0;

 private:
  void poll(Time now) {
    const auto reading = driver_.poll(now);
    status = reading.status;
    if (status == ReadStatus::kFresh) {
      CHECK(reading.sample.measured > newest);
      fix = reading.sample;
      newest = fix.measured;
      ++fixes;
    }
  }
  void speak() {
    timespec now{};
    clock_gettime(CLOCK_REALTIME, &now);
    tm utc{};
    gmtime_r(&now.tv_sec, &utc);
    Fixed said;
    said.second_of_day = utc.tm_hour * 3600 + utc.tm_min * 60 + utc.tm_sec +
                         static_cast<double>(now.tv_nsec / 200'000'000) * 0.2;
    said.date = fmt::format("{:02}{:02}{:02}", utc.tm_mday, utc.tm_mon + 1, utc.tm_year % 100);
    said.latitude_minutes += 1e-4 * ++spoken_;
    const std::string text = gga_line(said) + rmc_line(said);
    const std::vector<std::uint8_t> bytes{text.begin(), text.end()};
    static_cast<void>(pty_.send(bytes));
    std::array<std::uint8_t, 256> ignored{};
    static_cast<void>(pty_.receive(ignored));
  }

  fs::path program_;
  std::string port_ = free_tcp_port();
  PtyDevice pty_;
  std::optional<Program> gpsd_;
  std::unique_ptr<ByteStream> line_ = make_tcp_line("127.0.0.1:" + port_);
  GpsdReceiver driver_{*line_, GpsdOptions{}};
  Time spoke_{};
  int spoken_ = 0;
};

TEST_CASE("gpsd system: a receiver on a pty gives fixes through it, unplugged none", "[system]") {
  const auto program = gpsd_program();
  if (!program) {
    return;
  }
  Bench bench{*program};
  REQUIRE(bench.comes_to(true, [&] { return bench.fixes >= 10; }));
  CHECK(bench.fix.latitude_deg == Approx(35.0272).margin(0.01));
  CHECK(bench.fix.longitude_deg == Approx(138.9).margin(1e-6));
  CHECK(bench.fix.utc_ns > 0);
  CHECK(bench.fix.has_speed);
  CHECK(bench.fix.sigma_m == Approx(6.0));  // without GSA gpsd tells no HDOP
  CHECK(bench.fault() == DeviceFault::kNone);
  bench.unplug();
  const int before = bench.fixes;
  REQUIRE(bench.comes_to(false, [&] {
    return bench.fault() == DeviceFault::kNoAnswer || bench.fault() == DeviceFault::kUnplugged;
  }));
  CHECK(SteadyClock{}.now() - bench.newest >= GpsdReceiver::kSilence);
  CHECK(bench.fixes - before <= 2);
}

TEST_CASE("gpsd system: killed and started anew it gives fixes again, each later than the last",
          "[system]") {
  const auto program = gpsd_program();
  if (!program) {
    return;
  }
  Bench bench{*program};
  REQUIRE(bench.comes_to(true, [&] { return bench.fixes >= 5; }));
  bench.kill_gpsd();
  REQUIRE(bench.comes_to(true, [&] { return bench.status == ReadStatus::kDisconnected; }));
  REQUIRE(bench.comes_to(true, [&] { return bench.fault() == DeviceFault::kNoService; }));
  const int before = bench.fixes;
  bench.start();
  REQUIRE(bench.comes_to(true, [&] { return bench.fixes >= before + 5; }));
  CHECK(bench.fault() == DeviceFault::kNone);
}

}  // namespace
}  // namespace lodesman::testing
