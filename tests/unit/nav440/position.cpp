// SPDX-License-Identifier: Apache-2.0
// The unit as a second contract's device: places of N0 and N1, through the relay.
#include "drivers/nav440/nav440_position.h"

#include <cmath>
#include <vector>

#include "tests/support/catch.h"
#include "tests/unit/nav440/scripted_unit.h"

namespace lodesman::testing {
namespace {

using std::chrono::milliseconds;

// Under way to the north-east, in the south-west of the earth.
[[nodiscard]] Whereabouts sailing(Time at) {
  const double passed_s = to_seconds(at - kUnitOn);
  return {-33.85 + 1e-5 * passed_s, -151.2 + 1e-5 * passed_s, 1.0, 1.0};
}

[[nodiscard]] std::vector<PositionFix> all_of(Nav440Position& position, Time now) {
  std::vector<PositionFix> fixes;
  for (auto reading = position.poll(now); reading.status == ReadStatus::kFresh;
       reading = position.poll(now)) {
    fixes.push_back(reading.sample);
  }
  return fixes;
}

struct PositionBench : UnitBench {
  explicit PositionBench(Nav440Packet packet, const char* type) {
    options.packet = packet;
    unit.stored_type = type;
    unit.power_cycle();
    unit.place = sailing;
  }
  Nav440Position position{fixes};

  // All fixes of so many seconds, taken as the position task does.
  [[nodiscard]] std::vector<PositionFix> fixes_of(double seconds) {
    std::vector<PositionFix> all;
    for (double passed = 0.0; passed < seconds; passed += 0.1) {
      run(0.1);
      for (const PositionFix& fix : all_of(position, now)) {
        all.push_back(fix);
      }
    }
    return all;
  }
};

TEST_CASE("nav440 position: one unit gives heading and position, five fixes a second", "[nav440]") {
  struct Row {
    Nav440Packet packet;
    const char* type;
  };
  for (const Row& row : {Row{Nav440Packet::kN1, "N1"}, Row{Nav440Packet::kN0, "N0"}}) {
    PositionBench bench{row.packet, row.type};
    REQUIRE(bench.comes_up());
    const std::size_t headings = bench.samples.size();
    const auto fixes = bench.fixes_of(4.0);
    CHECK(bench.samples.size() - headings > 180);
    REQUIRE(fixes.size() >= 19);
    CHECK(fixes.size() <= 22);
    Time last{};
    for (const PositionFix& fix : fixes) {
      const Whereabouts truth = sailing(fix.measured);
      CHECK(fix.measured > last);
      CHECK(fix.latitude_deg == Approx(truth.latitude_deg).margin(1e-6));
      CHECK(fix.longitude_deg == Approx(truth.longitude_deg).margin(1e-6));
      CHECK(fix.source == FixSource::kNav440);
      CHECK(fix.sigma_m == Approx(6.0));
      CHECK(fix.speed_m_s == Approx(std::sqrt(2.0)));
      CHECK(fix.course_rad == Approx(0.7853982));
      last = fix.measured;
    }
    CHECK(bench.position.fault() == DeviceFault::kNone);
  }
}

TEST_CASE("nav440 position: a unit without a fix gives none, and says so while its heading goes on",
          "[nav440]") {
  PositionBench bench{Nav440Packet::kN1, "N1"};
  REQUIRE(bench.comes_up());
  REQUIRE(!bench.fixes_of(1.0).empty());
  bench.unit.place = [](Time) { return Whereabouts{}; };
  static_cast<void>(bench.fixes_of(0.2));
  const std::size_t headings = bench.samples.size();
  CHECK(bench.fixes_of(2.0).empty());
  CHECK(bench.position.fault() == DeviceFault::kNoFix);
  CHECK(bench.fault() == DeviceFault::kNone);
  CHECK(bench.samples.size() - headings > 80);
  bench.unit.place = sailing;
  CHECK(!bench.fixes_of(1.0).empty());
  bench.unit.bit = 0x0300;  // masterStatus and hardwareStatus: no 3D fix, among others
  static_cast<void>(bench.fixes_of(0.2));
  CHECK(bench.fixes_of(1.0).empty());
  CHECK(bench.samples.size() > headings + 100);
}

TEST_CASE("nav440 position: C3: a place that stands still under way is frozen after 10 s",
          "[nav440]") {
  PositionBench bench{Nav440Packet::kN1, "N1"};
  REQUIRE(bench.comes_up());
  bench.unit.place = [](Time) { return Whereabouts{35.0, 139.0, 1.0, 0.0}; };
  CHECK(!bench.fixes_of(2.0).empty());
  static_cast<void>(bench.fixes_of(9.0));
  CHECK(bench.fixes_of(2.0).empty());
  CHECK(bench.position.fault() == DeviceFault::kFrozen);
}

TEST_CASE("nav440 position: a unit that is unplugged is gone for both", "[nav440]") {
  PositionBench bench{Nav440Packet::kN1, "N1"};
  REQUIRE(bench.comes_up());
  static_cast<void>(bench.fixes_of(1.0));
  bench.line->unplug();
  bench.run(0.1);
  static_cast<void>(all_of(bench.position, bench.now));
  CHECK(bench.position.poll(bench.now).status == ReadStatus::kDisconnected);
  CHECK(bench.position.fault() == DeviceFault::kUnplugged);
}

TEST_CASE("nav440 position: a relay that nobody empties keeps what it has and takes no more",
          "[nav440]") {
  Nav440FixRelay relay;
  PositionFix fix;
  for (int i = 0; i < 40; ++i) {
    fix.measured = Time{milliseconds{i + 1}};
    CHECK(relay.push(fix) == (i < static_cast<int>(Nav440FixRelay::kCapacity)));
  }
  Nav440Position position{relay};
  const auto kept = all_of(position, Time{});
  REQUIRE(kept.size() == Nav440FixRelay::kCapacity);
  CHECK(kept.front().measured == Time{milliseconds{1}});
  CHECK(relay.push(fix));
  CHECK(all_of(position, Time{}).size() == 1);
}

}  // namespace
}  // namespace lodesman::testing
