// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/scenario/fault.h"

#include <set>

#include "tests/support/catch.h"

namespace lodesman {
namespace {

[[nodiscard]] std::vector<Fault> faults_of(const std::string& text) {
  return read_faults(TomlDocument::from_text(text, "f.toml").root());
}

[[nodiscard]] FaultKind kind_at(std::size_t index) { return static_cast<FaultKind>(index); }

TEST_CASE("fault: every kind has a name of its own, and says whether it needs bytes",
          "[hal_sim][scenario]") {
  std::set<std::string_view> names;
  for (std::size_t i = 1; i < kFaultKindCount; ++i) {
    const std::string_view name = name_of(kind_at(i));
    CHECK(names.insert(name).second);
    const bool is_plain = name == "stall" || name == "corrupt" || name == "disconnect";
    const bool is_of_echoes = name == "frozen" || name == "interference" || name == "saturated" ||
                              name == "blinded" || name == "weed";
    CHECK(needs_bytes(FaultDevice::kAhrs, kind_at(i)) == !is_plain);
    CHECK(needs_bytes(FaultDevice::kSonar, kind_at(i)) == (!is_plain && !is_of_echoes));
    CHECK(alters_pings(FaultDevice::kSonar, kind_at(i)) == is_of_echoes);
    CHECK_FALSE(alters_pings(FaultDevice::kPosition, kind_at(i)));
    // Some device has it, under that name.
    bool is_had = false;
    for (const char* device : {"ahrs", "thruster", "sonar", "position"}) {
      const ParsedFault parsed = parse_fault(std::string{device} + " " + std::string{name});
      is_had = is_had || (parsed.fault && parsed.fault->kind == kind_at(i));
    }
    CHECK(is_had);
    CHECK(fault_kinds_help().find(std::string{name} + " (") != std::string::npos);
  }
  CHECK(name_of(FaultKind::kNone) == "none");
  CHECK(name_of(FaultDevice::kPosition) == "position");
}

TEST_CASE("fault: a table has the numbers of its kind, or what stands for them",
          "[hal_sim][scenario]") {
  const auto faults = faults_of(R"(
[[fault]]
device = "ahrs"
kind = "spike"
at_s = 1.0
duration_s = 2.0
rate = 0.25
value = -90.0
[[fault]]
device = "thruster"
kind = "late"
at_s = 3.0
duration_s = 4.0
)");
  REQUIRE(faults.size() == 2);
  CHECK(faults[0].kind == FaultKind::kSpike);
  CHECK(faults[0].rate == Approx(0.25));
  CHECK(faults[0].value == Approx(-90.0));
  CHECK(faults[1].device == FaultDevice::kThruster);
  CHECK(faults[1].kind == FaultKind::kLate);
  CHECK(faults[1].rate == Approx(0.05));
  CHECK(faults[1].value == Approx(0.1));
}

TEST_CASE("fault: one line of text is a fault", "[hal_sim][scenario]") {
  const ParsedFault flip = parse_fault("ahrs flip rate=0.01 for=5");
  REQUIRE(flip.fault);
  CHECK(flip.refusal.empty());
  CHECK(flip.fault->device == FaultDevice::kAhrs);
  CHECK(flip.fault->kind == FaultKind::kFlip);
  CHECK(flip.fault->rate == Approx(0.01));
  CHECK(flip.fault->at_s == Approx(0.0));
  CHECK(flip.fault->duration_s == Approx(5.0));
  const ParsedFault battery = parse_fault("  thruster\tbattery  at=12 value=20.5 ");
  REQUIRE(battery.fault);
  CHECK(battery.fault->value == Approx(20.5));
  CHECK(battery.fault->at_s == Approx(12.0));
  CHECK(battery.fault->duration_s >= 1e5);  // to the end
  const ParsedFault sonar = parse_fault("sonar stall for=1");
  REQUIRE(sonar.fault);
  CHECK(sonar.fault->kind == FaultKind::kStall);
}

TEST_CASE("fault: a line of text that is none is refused with the reason", "[hal_sim][scenario]") {
  const auto refusal = [](const char* text) {
    const ParsedFault parsed = parse_fault(text);
    CHECK_FALSE(parsed.fault);
    return parsed.refusal;
  };
  CHECK(refusal("") == "must be: DEVICE KIND [rate=...] [value=...] [at=...] [for=...]");
  CHECK(refusal("ahrs") == refusal(""));
  CHECK(refusal("gps stall") == "device: must be one of: ahrs, thruster, sonar, position");
  // Of datagrams no byte is spoilt: their sum would not come out.
  CHECK(
      refusal("sonar flip") ==
      "kind: must be one of: stall, corrupt, disconnect, hang, power, reorder, foreign, repeat, "
      "jump, range, output, average, centimetres, saturated, blinded, weed, drop, duplicate, cut, "
      "frozen, interference");
  CHECK(refusal("position late") ==
        "kind: must be one of: stall, corrupt, disconnect, flip, burst, drop, duplicate, insert, "
        "interference, cut, batch, hang, replug, power, frozen, void, week, bad_checksum, "
        "no_checksum, quality, step, drift, spike, invalid");
  CHECK(refusal("position step value=2e4") == "value: must be a number from -1e+04 to 1e+04");
  CHECK(refusal("ahrs step value=200") == "value: must be a number from -180 to 180");
  CHECK(refusal("ahrs flip rate=2") == "rate: must be a number from 0 to 1");
  CHECK(refusal("ahrs flip rate=-0.1") == "rate: must be a number from 0 to 1");
  CHECK(refusal("ahrs flip rate=nan") == "rate: must be a number from 0 to 1");
  CHECK(refusal("ahrs flip rate=0.1x") == "rate: must be a number from 0 to 1");
  CHECK(refusal("ahrs flip rate=") == "rate: must be a number from 0 to 1");
  CHECK(refusal("ahrs flip rate") == "rate: must be a number from 0 to 1");
  CHECK(refusal("ahrs flip for=0") == "for: must be a number from 0.001 to 1e+05");
  CHECK(refusal("ahrs flip at=1e9") == "at: must be a number from 0 to 1e+05");
  CHECK(refusal("ahrs flip value=1") == "value=1: flip has no such setting");
  CHECK(refusal("ahrs stall rate=1") == "rate=1: stall has no such setting");
  CHECK(refusal("sonar blinded value=0") == "value: must be a number from 1 to 360");
  CHECK(refusal("sonar interference rate=0.1") == "rate=0.1: interference has no such setting");
  CHECK(refusal("ahrs flip now") == "now: flip has no such setting");
}

TEST_CASE("fault: one kind has the numbers of the device that has it", "[hal_sim][scenario]") {
  const ParsedFault turned = parse_fault("ahrs step");
  const ParsedFault moved = parse_fault("position step");
  const ParsedFault lost = parse_fault("sonar drop");
  const ParsedFault lost_byte = parse_fault("position drop");
  REQUIRE(turned.fault);
  REQUIRE(moved.fault);
  REQUIRE(lost.fault);
  REQUIRE(lost_byte.fault);
  CHECK(turned.fault->kind == moved.fault->kind);
  CHECK(turned.fault->value == Approx(45.0));
  CHECK(moved.fault->value == Approx(5.0));
  CHECK(lost.fault->rate == Approx(0.01));
  CHECK(lost_byte.fault->rate == Approx(1e-4));
  CHECK(fault_kinds_help().find("sonar: drop (rate: chance of a datagram") != std::string::npos);
  CHECK(fault_kinds_help().find("ahrs, position: frozen (") != std::string::npos);
  CHECK(fault_kinds_help().find("sonar: frozen (the same echoes") != std::string::npos);
  const ParsedFault rays = parse_fault("sonar interference");
  const ParsedFault flips = parse_fault("ahrs interference");
  REQUIRE(rays.fault);
  REQUIRE(flips.fault);
  CHECK(rays.fault->value == Approx(120.0));
  CHECK(flips.fault->rate == Approx(1e-3));
}

TEST_CASE("fault schedule: what needs bytes is nothing to a device without",
          "[hal_sim][scenario]") {
  const FaultSchedule ahrs{{{FaultDevice::kAhrs, FaultKind::kFlip, 0.0, 9.0},
                            {FaultDevice::kAhrs, FaultKind::kStall, 1.0, 1.0}},
                           FaultDevice::kAhrs};
  CHECK(ahrs.at(0.5) == FaultKind::kNone);
  CHECK(ahrs.at(1.5) == FaultKind::kStall);
  const FaultSchedule sonar{{{FaultDevice::kSonar, FaultKind::kDrop, 0.0, 9.0},
                             {FaultDevice::kSonar, FaultKind::kBlinded, 1.0, 1.0, 0.0, 60.0}},
                            FaultDevice::kSonar};
  CHECK(sonar.at(0.5) == FaultKind::kNone);
  CHECK(sonar.running(1.5).kind == FaultKind::kBlinded);
  CHECK(sonar.running(1.5).value == Approx(60.0));
}

}  // namespace
}  // namespace lodesman
