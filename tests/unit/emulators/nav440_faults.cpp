// SPDX-License-Identifier: Apache-2.0
// A NAV440 whose values are wrong while its packets are whole.
#include <cmath>

#include "hal_sim/emulators/nav440_unit.h"
#include "mid_level/base/heading.h"
#include "tests/support/catch.h"
#include "tests/unit/emulators/support.h"

namespace lodesman {
namespace {

using namespace lodesman::testing;

// Turning, and long switched on.
struct FaultyUnit {
  Nav440Unit unit;
  explicit FaultyUnit(Nav440UnitOptions options = {})
      : unit{of(std::move(options)), at_ms(0), std::chrono::minutes{1}} {
    motion(to_rad(10.0));
  }
  [[nodiscard]] static Nav440UnitOptions of(Nav440UnitOptions options) {
    options.packet_type = 0x4131;
    return options;
  }
  void motion(double heading_rad) {
    EmulatedMotion motion;
    motion.heading_true_rad = heading_rad;
    unit.set_motion(motion);
  }
  [[nodiscard]] std::vector<Bytes> frames_until(std::int64_t ms) {
    std::vector<Bytes> frames;
    for (const Utterance& utterance : said_until(unit, at_ms(ms))) {
      frames.push_back(utterance.bytes);
    }
    return frames;
  }
  [[nodiscard]] static double yaw_deg(const Bytes& frame) {
    return static_cast<std::int16_t>((frame[9] << 8) | frame[10]) * 360.0 / 65536.0;
  }
};

TEST_CASE("nav440 faults: frozen, all but time and check stay to the last bit",
          "[hal_sim][emulators]") {
  FaultyUnit faulty;
  faulty.unit.begin_fault(ahrs_fault(FaultKind::kFrozen), at_ms(0));
  const auto frozen = faulty.frames_until(100);
  REQUIRE(frozen.size() == 5);
  faulty.motion(to_rad(90.0));
  for (const Bytes& frame : faulty.frames_until(200)) {
    CHECK(std::equal(frame.begin(), frame.begin() + 31, frozen[0].begin()));
    CHECK(!std::equal(frame.begin() + 31, frame.begin() + 35, frozen[0].begin() + 31));
  }
  CHECK(faulty.unit.injections().of(FaultKind::kFrozen).count == 1);
  faulty.unit.end_fault(ahrs_fault(FaultKind::kFrozen), at_ms(200));
  CHECK(FaultyUnit::yaw_deg(faulty.frames_until(220).at(0)) == Approx(90.0).margin(0.01));
}

TEST_CASE("nav440 faults: a step, a drift and the thrusters' field turn the heading",
          "[hal_sim][emulators]") {
  FaultyUnit faulty;
  faulty.unit.begin_fault(ahrs_fault(FaultKind::kStep, 0.0, -45.0), at_ms(0));
  CHECK(FaultyUnit::yaw_deg(faulty.frames_until(20).at(0)) == Approx(-35.0).margin(0.01));
  faulty.unit.end_fault(ahrs_fault(FaultKind::kStep), at_ms(20));
  faulty.unit.begin_fault(ahrs_fault(FaultKind::kDrift, 0.0, 2.0), at_ms(1000));
  CHECK(FaultyUnit::yaw_deg(faulty.frames_until(3000).back()) == Approx(14.0).margin(0.05));
  faulty.unit.end_fault(ahrs_fault(FaultKind::kDrift), at_ms(3000));
  faulty.unit.begin_fault(ahrs_fault(FaultKind::kMagnetic, 0.0, 15.0), at_ms(3000));
  CHECK(FaultyUnit::yaw_deg(faulty.frames_until(3020).back()) == Approx(10.0).margin(0.01));
  faulty.unit.set_thrust_share(0.5);
  CHECK(FaultyUnit::yaw_deg(faulty.frames_until(3040).back()) == Approx(17.5).margin(0.01));
}

TEST_CASE("nav440 faults: spikes are single packets, and counted", "[hal_sim][emulators]") {
  FaultyUnit faulty;
  faulty.unit.begin_fault(ahrs_fault(FaultKind::kSpike, 0.05, 60.0), at_ms(0));
  std::uint64_t spikes = 0;
  for (const Bytes& frame : faulty.frames_until(40'000)) {
    spikes += FaultyUnit::yaw_deg(frame) > 40.0 ? 1U : 0U;
  }
  CHECK(spikes > 60);  // 100 of 2000
  CHECK(spikes < 150);
  const Injection& counted = faulty.unit.injections().of(FaultKind::kSpike);
  CHECK(counted.count == spikes);
  CHECK(counted.last > at_ms(30'000));
}

TEST_CASE("nav440 faults: invalid values, a failed test and no power", "[hal_sim][emulators]") {
  FaultyUnit faulty;
  faulty.unit.begin_fault(ahrs_fault(FaultKind::kInvalid), at_ms(0));
  const Bytes invalid = faulty.frames_until(20).at(0);
  for (std::size_t at = 5; at < 23; at += 2) {
    CHECK(invalid[at] == 0x80);
    CHECK(invalid[at + 1] == 0x00);
  }
  faulty.unit.end_fault(ahrs_fault(FaultKind::kInvalid), at_ms(20));
  faulty.unit.begin_fault(ahrs_fault(FaultKind::kBit, 0.0, 256.0), at_ms(20));
  const Bytes warned = faulty.frames_until(40).at(0);
  CHECK(warned[35] == 0x01);
  CHECK(warned[36] == 0x00);
  faulty.unit.end_fault(ahrs_fault(FaultKind::kBit), at_ms(40));
  faulty.unit.begin_fault(ahrs_fault(FaultKind::kPower), at_ms(40));
  CHECK(faulty.frames_until(1040).empty());
  CHECK(answer(faulty.unit, hex("55 55 50 4B 00 9E F4"), at_ms(1050)).empty());
  faulty.unit.end_fault(ahrs_fault(FaultKind::kPower), at_ms(1061));
  const auto said = said_until(faulty.unit, at_ms(1081));
  REQUIRE(said.size() == 1);
  CHECK(said[0].begins == at_ms(1081));
  CHECK(said[0].bytes[35] == 0x09);
}

TEST_CASE("nav440 faults: one that it cannot have is passed over", "[hal_sim][emulators]") {
  FaultyUnit faulty;
  CHECK_FALSE(faulty.unit.has_fault(FaultKind::kError));
  CHECK_FALSE(faulty.unit.has_fault(FaultKind::kFlip));
  faulty.unit.begin_fault(ahrs_fault(FaultKind::kError, 100.0), at_ms(0));
  CHECK(faulty.unit.injections().of(FaultKind::kError).count == 0);
}

}  // namespace
}  // namespace lodesman
