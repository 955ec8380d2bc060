// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "mid_level/base/heading.h"
#include "mid_level/base/startup_error.h"
#include "tests/support/allocations.h"
#include "tests/support/catch.h"
#include "tests/unit/nav440/scripted_unit.h"

namespace lodesman::testing {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

[[nodiscard]] Nav440Options without_speed() {
  Nav440Options options;
  options.line_has_speed = false;
  return options;
}

TEST_CASE("nav440: on a line without delay a stamp is the arrival, from the first on", "[nav440]") {
  UnitBench bench{without_speed()};
  bench.unit.has_speed = false;
  bench.unit.reply_delay = Duration::zero();
  bench.period = milliseconds{1};
  bench.unit.motion = [](Time at) { return turning(at, 20.0); };
  REQUIRE(bench.comes_up());
  bench.run(3.0);
  for (std::size_t i = 0; i < bench.samples.size(); ++i) {
    REQUIRE(bench.samples[i].measured == bench.given[i]);
  }
  CHECK(worst_error_deg(bench) < 0.006);
  CHECK(bench.line->baud() == 0);
}

TEST_CASE("nav440: what the line takes is no part of a stamp, at any speed and rate of polls",
          "[nav440]") {
  for (const int baud : {38400, 57600}) {
    for (const int period_ms : {1, 5, 20, 33}) {
      INFO(baud << " Bd, polled each " << period_ms << " ms");
      UnitBench bench;
      bench.options.baud = bench.unit.stored_baud = baud;
      bench.unit.power_cycle();
      bench.period = milliseconds{period_ms};
      bench.unit.motion = [](Time at) { return turning(at, 20.0); };
      REQUIRE(bench.comes_up());
      bench.run(1.0);
      for (const Attitude& sample : bench.samples) {
        const Duration off = (sample.measured - kUnitOn) % milliseconds{20};
        CHECK(std::min(off, milliseconds{20} - off) < microseconds{1});
      }
      CHECK(worst_error_deg(bench) < 0.006);
      CHECK(bench.samples.size() >= 48);
    }
  }
}

TEST_CASE("nav440: a known delay of the adapter is taken off", "[nav440]") {
  UnitBench bench{without_speed()};
  bench.options.latency = milliseconds{3};
  bench.unit.has_speed = false;
  bench.period = milliseconds{1};
  REQUIRE(bench.comes_up());
  CHECK(bench.samples.front().measured == bench.given.front() - milliseconds{3});
}

TEST_CASE("nav440: F6: batches of an adapter do not show in the stamps", "[nav440]") {
  for (const double clock_ppm : {-50.0, 0.0, 50.0}) {
    for (const int rate_hz : {50, 100}) {
      INFO(clock_ppm << " ppm, " << rate_hz << " Hz");
      UnitBench bench;
      bench.options.rate_hz = rate_hz;
      bench.unit.batch = milliseconds{16};
      bench.unit.clock_ppm = clock_ppm;
      bench.period = milliseconds{1};
      bench.unit.motion = [](Time at) { return turning(at, 30.0); };
      REQUIRE(bench.comes_up());
      bench.run(1.0);
      const std::size_t settled = bench.samples.size();
      const std::uint64_t sent = bench.unit.packets;
      bench.run(60.0);
      CHECK(bench.unit.packets - sent == 60U * static_cast<unsigned>(rate_hz));
      CHECK(bench.samples.size() - settled + 2 >= bench.unit.packets - sent);
      int uneven = 0;
      const Duration period = Duration{std::chrono::seconds{1}} / rate_hz;
      for (std::size_t i = settled; i < bench.samples.size(); ++i) {
        const Duration step = bench.samples[i].measured - bench.samples[i - 1].measured;
        uneven += std::chrono::abs(step - period) < milliseconds{2} ? 0 : 1;
        CHECK(std::chrono::abs(step - period) < microseconds{4100});
      }
      // Batches of 16 ms tell where packets of 20 ms lie to 4 ms, those of 10 ms to 2 ms; as clocks
      // drift apart at 50 ppm, that shows as a step each 80 s or 40 s.
      CHECK(uneven <= (clock_ppm < 0.0 ? 2 : 0));
      CHECK(worst_error_deg(bench, settled) < 0.13);  // 4 ms of the turn, and the resolution
    }
  }
}

TEST_CASE("nav440: F6: after a halt of the polls the packets that waited have their own stamps",
          "[nav440]") {
  UnitBench bench;
  bench.unit.motion = [](Time at) { return turning(at, 30.0); };
  REQUIRE(bench.comes_up());
  bench.run(1.0);
  const std::size_t before = bench.samples.size();
  bench.now += milliseconds{300};
  bench.step();
  CHECK(bench.samples.size() >= before + 14);
  CHECK(worst_error_deg(bench) < 0.006);
  CHECK(bench.corrupt == 0);
}

TEST_CASE("nav440: F8: a time that stands still is no frozen unit", "[nav440]") {
  UnitBench bench;
  bench.unit.time_stands = true;
  bench.unit.motion = [](Time at) { return turning(at, 30.0); };
  REQUIRE(bench.comes_up(1.0));
  const std::size_t first = bench.samples.size();
  bench.run(5.0);
  CHECK(bench.samples.size() >= first + 249);
  CHECK(bench.fault() == DeviceFault::kNone);
  CHECK(bench.corrupt == 0);
  CHECK(worst_error_deg(bench) < 0.006);
}

TEST_CASE("nav440: F8: where its time wraps or begins anew, no stamp jumps", "[nav440]") {
  const auto a_run = [](Nav440Packet packet, std::int64_t off_ms, std::int64_t then_off_ms) {
    UnitBench bench;
    bench.options.packet = packet;
    bench.unit.time_off_ms = off_ms;
    bench.unit.motion = [](Time at) { return turning(at, 30.0); };
    REQUIRE(bench.comes_up());
    bench.run(1.0);
    bench.unit.time_off_ms = then_off_ms;
    bench.run(3.0);
    CHECK(worst_error_deg(bench) < 0.006);
    CHECK(bench.driver->counts().streams == 1);
    CHECK(bench.fault() == DeviceFault::kNone);
    return std::pair{bench.corrupt, bench.samples.size()};
  };
  constexpr std::int64_t kWraps_ms = 604800000 - 2000;
  const auto [wrap_corrupt, wrap_samples] = a_run(Nav440Packet::kA1, kWraps_ms, kWraps_ms);
  CHECK(wrap_corrupt == 0);
  CHECK(wrap_samples >= 198);
  const auto [short_corrupt, short_samples] = a_run(Nav440Packet::kA0, 63000, 63000);
  CHECK(short_corrupt == 0);
  CHECK(short_samples >= 198);
  // Begun anew it follows from nothing, until three packets follow from each other.
  const auto [restart_corrupt, restart_samples] = a_run(Nav440Packet::kA1, 5000000, 0);
  CHECK(restart_corrupt == 2);
  CHECK(restart_samples >= 196);
}

TEST_CASE("nav440: H2: about south the heading neither leaves its range nor is it refused",
          "[nav440]") {
  for (const double declination_deg : {0.0, -7.6, 180.0, -180.0}) {
    UnitBench bench;
    bench.options.declination_rad = to_rad(declination_deg);
    bench.unit.declination_deg = declination_deg;
    bench.unit.motion = [](Time at) {
      const Time middle = at + milliseconds{10};
      return Motion{middle.time_since_epoch() / milliseconds{20} % 2 == 0 ? 179.99 : -179.99, 0.0};
    };
    REQUIRE(bench.comes_up());
    bench.run(2.0);
    CHECK(bench.samples.size() >= 98);
    CHECK(bench.corrupt == 0);
    CHECK(worst_error_deg(bench) < 0.006);
  }
}

TEST_CASE("nav440: H4: magnetic and true packets give the same true heading", "[nav440]") {
  constexpr double kDeclination_deg = -7.6;
  for (const Nav440Packet packet :
       {Nav440Packet::kA0, Nav440Packet::kA1, Nav440Packet::kN0, Nav440Packet::kN1}) {
    UnitBench bench;
    bench.options.packet = packet;
    bench.options.declination_rad = to_rad(kDeclination_deg);
    bench.unit.declination_deg = kDeclination_deg;
    bench.unit.motion = [](Time at) { return turning(at, 25.0); };
    REQUIRE(bench.comes_up());
    bench.run(16.0);
    CHECK(worst_error_deg(bench) < 0.02);
    CHECK(std::abs(to_deg(bench.samples.back().yaw_rate_rad_s) - 25.0) < 0.1);
  }
}

TEST_CASE("nav440: nothing is allocated once it is made", "[nav440]") {
  UnitBench bench;
  bench.step();
  std::uint64_t allocations = 0;
  int fresh = 0;
  for (int i = 0; i < 1000; ++i) {
    bench.now += milliseconds{5};
    bench.unit.bit = i > 600 && i < 620 ? 0x0001 : 0;
    bench.unit.is_dead = i > 700 && i < 710;
    bench.unit.go_on_to(bench.now);
    const AllocationScope scope;
    fresh += bench.driver->poll(bench.now).status == ReadStatus::kFresh ? 1 : 0;
    static_cast<void>(bench.driver->fault());
    static_cast<void>(bench.driver->counts());
    allocations += scope.count();
  }
  CHECK(fresh > 200);
  CHECK(allocations == 0);
}

TEST_CASE("nav440: options that do not fit each other make no driver", "[nav440]") {
  MemoryLine line;
  Nav440Options options;
  options.baud = 38400;
  options.rate_hz = 100;
  CHECK_THROWS_AS((Nav440{line.near_end(), options}), StartupError);
}

}  // namespace
}  // namespace lodesman::testing
