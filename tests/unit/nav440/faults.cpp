// SPDX-License-Identifier: Apache-2.0
// What the driver makes of a unit that says what it should not.
#include <algorithm>
#include <cmath>

#include "mid_level/base/heading.h"
#include "tests/support/catch.h"
#include "tests/unit/nav440/scripted_unit.h"

namespace lodesman::testing {
namespace {

using std::chrono::milliseconds;

TEST_CASE("nav440: F9: a unit that flickered and repeats itself to the bit is frozen", "[nav440]") {
  UnitBench bench;
  REQUIRE(bench.comes_up());
  bench.run(3.0);
  CHECK(bench.fault() == DeviceFault::kNone);  // moored: its heading stands still
  bench.unit.is_frozen = true;
  bench.run(1.0);
  CHECK(bench.fault() == DeviceFault::kFrozen);
  const std::size_t samples = bench.samples.size();
  bench.run(2.0);
  CHECK(bench.samples.size() == samples);
  CHECK(bench.corrupt > 90);
  CHECK(bench.driver->streaming());
  bench.unit.is_frozen = false;
  bench.run(0.2);
  CHECK(bench.fault() == DeviceFault::kNone);
  CHECK(bench.samples.size() > samples + 7);
}

TEST_CASE("nav440: F9: one without any flicker that lies or comes to rest is not frozen",
          "[nav440]") {
  UnitBench bench;
  bench.unit.flickers = false;
  REQUIRE(bench.comes_up());
  bench.run(3.0);
  CHECK(bench.fault() == DeviceFault::kNone);
  // A turn that water brakes: e to the -t within two seconds.
  const Time begins = bench.now;
  bench.unit.motion = [begins](Time at) {
    const double t_s = to_seconds(at - begins);
    return Motion{60.0 * (1.0 - std::exp(-t_s / 2.0)), 30.0 * std::exp(-t_s / 2.0)};
  };
  bench.run(60.0);
  CHECK(bench.driver->counts().frozen == 0);
  CHECK(bench.fault() == DeviceFault::kNone);
}

TEST_CASE("nav440: F10: a unit that fails its own test is not used from that packet on",
          "[nav440]") {
  UnitBench bench;
  REQUIRE(bench.comes_up());
  bench.run(1.0);
  bench.unit.bit = 0x0001;
  const std::size_t samples = bench.samples.size();
  bench.run(0.04);
  CHECK(bench.fault() == DeviceFault::kSelfTestFailed);
  CHECK(bench.samples.size() <= samples + 1);  // one was on its way
  bench.run(2.0);
  CHECK(bench.samples.size() <= samples + 1);
  CHECK(bench.driver->counts().self_test_failed > 90);
  CHECK(bench.driver->streaming());
  bench.unit.bit = 0;
  bench.run(0.2);
  CHECK(bench.fault() == DeviceFault::kNone);
  CHECK(bench.samples.size() > samples + 5);
}

TEST_CASE("nav440: F10: a warning of its own test stops nothing", "[nav440]") {
  UnitBench bench;
  bench.unit.bit = 0x0100;
  REQUIRE(bench.comes_up());
  bench.run(1.0);
  CHECK(bench.samples.size() >= 49);
  CHECK(bench.fault() == DeviceFault::kSelfTestWarning);
  bench.unit.bit = 0;
  bench.run(0.1);
  CHECK(bench.fault() == DeviceFault::kNone);
}

TEST_CASE("nav440: packets that go missing cost no other, in a turn too", "[nav440]") {
  UnitBench bench;
  bench.unit.motion = [](Time at) {
    const double t_s = to_seconds(at - kUnitOn);
    return Motion{std::remainder(60.0 * std::sin(0.5 * t_s), 360.0), 30.0 * std::cos(0.5 * t_s)};
  };
  REQUIRE(bench.comes_up());
  bench.run(1.0);
  int n = 0;
  bench.unit.damage = [&n](ByteList& frame) {
    // Runs of one to fourteen missing, and one that comes through between them.
    const int run = 1 + n / 150 % 14;
    if (n++ % (run + 1) != 0) {
      frame.clear();
    }
  };
  const std::size_t before = bench.samples.size();
  bench.run(30.0);
  CHECK(bench.driver->counts().implausible == 0);
  CHECK(bench.driver->counts().streams == 1);
  CHECK(bench.samples.size() > before + 100);
  CHECK(worst_error_deg(bench) < 0.006);
}

TEST_CASE("nav440: after a gap a heading is given once three packets follow from each other",
          "[nav440]") {
  UnitBench bench;
  bench.unit.motion = [](Time at) { return turning(at, 30.0); };
  REQUIRE(bench.comes_up());
  bench.run(1.0);
  for (const double gap_s : {0.2, 0.4, 0.9}) {
    INFO(gap_s << " s");
    const std::size_t before = bench.samples.size();
    const Time begins = bench.now;
    bench.unit.damage = [&](ByteList& frame) { frame.clear(); };
    bench.run(gap_s);
    bench.unit.damage = [](ByteList&) {};
    bench.run(0.5);
    const std::size_t expected = gap_s < 0.3 ? 25U : 23U;
    CHECK(bench.samples.size() - before >= expected);
    CHECK(bench.samples.size() - before <= expected + 1);
    CHECK(bench.samples[before + 1].measured > begins + from_seconds(gap_s - 0.02));
  }
  CHECK(bench.driver->counts().implausible == 0);
  CHECK(bench.corrupt == 0);
  CHECK(worst_error_deg(bench) < 0.006);
}

TEST_CASE("nav440: a spike of one packet is not given, a step that stays is", "[nav440]") {
  for (const double step_deg : {5.0, -30.0, 180.0}) {
    INFO(step_deg);
    UnitBench bench;
    REQUIRE(bench.comes_up());
    bench.run(1.0);
    const Time spike = bench.now;
    bench.unit.motion = [&](Time at) {
      return Motion{at < spike + milliseconds{20} ? step_deg : 0.0, 0.0};
    };
    bench.run(1.0);
    CHECK(bench.driver->counts().implausible == 1);
    for (const Attitude& sample : bench.samples) {
      CHECK(std::abs(sample.heading_rad) < 1e-9);
    }
    bench.unit.motion = [&](Time) { return Motion{step_deg, 0.0}; };
    bench.run(1.0);
    CHECK(bench.driver->counts().implausible == 3);
    CHECK(std::abs(to_deg(wrap_to_pi(bench.samples.back().heading_rad - to_rad(step_deg)))) <
          0.006);
    CHECK(bench.fault() == DeviceFault::kNone);
  }
}

TEST_CASE("nav440: headings that jump about are implausible, and say so", "[nav440]") {
  UnitBench bench;
  REQUIRE(bench.comes_up());
  bench.run(0.5);
  const std::size_t before = bench.samples.size();
  int n = 0;
  bench.unit.motion = [&n](Time) { return Motion{std::remainder(53.0 * ++n, 360.0), 0.0}; };
  bench.run(0.5);
  CHECK(bench.driver->counts().implausible >= 24);
  CHECK(bench.fault() == DeviceFault::kImplausible);
  CHECK(bench.samples.size() <= before + 1);
  bench.unit.motion = [](Time) { return Motion{}; };
  bench.run(4.0);
  CHECK(bench.fault() == DeviceFault::kNone);
}

TEST_CASE("nav440: a step within a step is no fault, a fifth packet that follows from nothing is",
          "[nav440]") {
  UnitBench bench;
  REQUIRE(bench.comes_up());
  bench.run(0.5);
  int n = 0;
  // Two packets are too few to be believed, so that four in a row are not.
  bench.unit.motion = [&n](Time) { return Motion{++n <= 2 ? 60.0 : 120.0, 0.0}; };
  for (int i = 0; i < 100; ++i) {
    bench.step();
    CHECK(bench.fault() == DeviceFault::kNone);
  }
  const std::uint64_t before = bench.driver->counts().implausible;
  CHECK(before == 4);
  bench.unit.motion = [&n](Time) { return Motion{std::remainder(53.0 * ++n, 360.0), 0.0}; };
  for (int i = 0; i < 60; ++i) {
    bench.step();
    const std::uint64_t refused = bench.driver->counts().implausible - before;
    CHECK(bench.fault() == (refused < 5 ? DeviceFault::kNone : DeviceFault::kImplausible));
  }
  CHECK(bench.fault() == DeviceFault::kImplausible);
}

TEST_CASE(
    "nav440: of two packets a second two in a row may go missing, after a third it begins again",
    "[nav440]") {
  UnitBench bench;
  bench.options.rate_hz = 2;
  REQUIRE(bench.comes_up(8.0));
  bench.run(3.0);
  int missing = 2;
  bench.unit.damage = [&missing](ByteList& frame) {
    if (missing > 0) {
      --missing;
      frame.clear();
    }
  };
  const std::size_t before = bench.samples.size();
  bench.run(2.0);
  CHECK(bench.driver->streaming());
  CHECK(bench.driver->counts().streams == 1);
  CHECK(bench.samples.size() == before + 2);
  CHECK(bench.corrupt == 0);
  missing = 100;
  bench.run(1.4);
  CHECK(bench.driver->streaming());
  bench.run(0.2);
  CHECK_FALSE(bench.driver->streaming());
}

TEST_CASE("nav440: H7: bytes that are damaged cost packets and bring no wrong heading",
          "[nav440]") {
  UnitBench bench;
  bench.unit.motion = [](Time at) { return turning(at, 30.0); };
  REQUIRE(bench.comes_up());
  unsigned chance = 7;
  bench.unit.damage = [&chance](ByteList& frame) {
    for (std::uint8_t& byte : frame) {
      chance = chance * 1103515245U + 12345U;
      if ((chance >> 16U) % 100U == 0) {
        byte ^= static_cast<std::uint8_t>(1U + (chance >> 8U) % 255U);
      }
    }
  };
  const std::size_t before = bench.samples.size();
  bench.run(120.0);
  CHECK(bench.samples.size() > before + 3600);  // 67.6 of 100 are whole
  CHECK(bench.corrupt > 1000);
  CHECK(worst_error_deg(bench) < 0.006);
  CHECK(bench.driver->counts().framing.crc_failures > 1000);
}

}  // namespace
}  // namespace lodesman::testing
