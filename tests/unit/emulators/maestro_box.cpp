// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/emulators/maestro_box.h"

#include "tests/support/catch.h"
#include "tests/unit/emulators/support.h"

namespace lodesman {
namespace {

using namespace lodesman::testing;

// As its owner is told to set it: neutral pulses at home, a time-out of half a second.
[[nodiscard]] MaestroBoxOptions set_up() {
  MaestroBoxOptions options;
  options.time_out_10ms = 50;
  options.channel[0].home = MaestroHome::kGoTo;
  options.channel[1].home = MaestroHome::kGoTo;
  return options;
}

struct Box {
  MaestroBox box;
  explicit Box(const MaestroBoxOptions& options = set_up()) : box{options, at_ms(0)} {}
  [[nodiscard]] Bytes says(const char* sent, std::int64_t ms = 1) {
    return answer(box, hex(sent), at_ms(ms));
  }
  [[nodiscard]] int pulse(std::size_t channel) const { return box.pulse_quarter_us(channel); }
};

TEST_CASE("maestro: targets in each of its protocols", "[hal_sim][emulators]") {
  Box b;
  CHECK(b.pulse(0) == 6000);
  CHECK(b.says("84 00 14 32").empty());
  CHECK(b.says("84 01 2A 24").empty());
  CHECK(b.pulse(0) == 6420);
  CHECK(b.pulse(1) == 4650);
  CHECK(b.says("84 00 70 2E").empty());
  CHECK(b.pulse(0) == 6000);
  CHECK(b.says("AA 0C 04 01 70 2E").empty());
  CHECK(b.pulse(1) == 6000);
  CHECK(b.says("FF 00 9B").empty());
  CHECK(b.pulse(0) == 6420);
  CHECK(b.says("FF 00 7F").empty());
  CHECK(b.pulse(0) == 6000);
  CHECK(b.says("FF 01 00 FF 00 FE").empty());
  CHECK(b.pulse(1) == 4095);
  CHECK(b.pulse(0) == 7905);
  CHECK(b.says("AA 0D 04 00 70 2E").empty());  // of another box
  CHECK(b.pulse(0) == 7905);
  CHECK(b.says("FF 17 00").empty());
  CHECK(b.box.errors() == 0);
}

TEST_CASE("maestro: pulses are held within its limits, and none is none", "[hal_sim][emulators]") {
  Box b;
  CHECK(b.says("84 00 01 00 84 01 7F 7F").empty());
  CHECK(b.pulse(0) == 3968);  // 992 us
  CHECK(b.pulse(1) == 8000);  // 2000 us
  CHECK(b.says("84 00 00 00").empty());
  CHECK(b.pulse(0) == 0);
  CHECK(b.pulse(9) == 0);
}

TEST_CASE("maestro: tells position, movement, errors and script", "[hal_sim][emulators]") {
  Box b;
  CHECK(b.says("90 00") == hex("70 17"));
  CHECK(b.says("AA 0C 10 00") == hex("70 17"));
  CHECK(b.says("93") == hex("00"));
  CHECK(b.says("A1") == hex("00 00"));
  CHECK(b.says("AE") == hex("01"));
  CHECK(b.says("87 00 10 00 89 00 10 00 A4 A7 01 A8 01 00 00 A2").empty());
  CHECK(b.says("A1") == hex("00 00"));
}

TEST_CASE("maestro: an error sends the outputs home until the next target, and is told once",
          "[hal_sim][emulators]") {
  MaestroBoxOptions options = set_up();
  options.channel[2].home = MaestroHome::kOff;
  options.channel[3].home = MaestroHome::kIgnore;
  Box b{options};
  const char* all = "84 00 14 32 84 01 14 32 84 02 14 32 84 03 14 32";
  CHECK(b.says(all).empty());
  CHECK(b.says("84 00 84").empty());  // a command within a command
  CHECK(b.box.errors() == 0x0010);
  CHECK(b.pulse(0) == 6000);
  CHECK(b.pulse(1) == 6000);
  CHECK(b.pulse(2) == 0);
  CHECK(b.pulse(3) == 6420);
  CHECK(b.says("00 14 32 A1") == hex("10 00"));
  CHECK(b.pulse(0) == 6420);
  CHECK(b.pulse(1) == 6000);
  CHECK(b.says("A1") == hex("00 00"));
  for (const char* wrong : {"B0", "84 06 70 2E", "90 18", "AA 0C 30", "9F 02 00", "8A"}) {
    INFO(wrong);
    CHECK(b.says(wrong).empty());
    CHECK(b.says("A1") == hex("10 00"));
  }
  CHECK(b.says("00 12 7F").empty());  // data of no command
  CHECK(b.says("A1") == hex("00 00"));
}

TEST_CASE("maestro: a larger box takes targets for several channels and a PWM",
          "[hal_sim][emulators]") {
  MaestroBoxOptions options = set_up();
  options.channels = 12;
  Box b{options};
  CHECK(b.says("9F 02 00 14 32 2A 24 8A 00 01 00 10 A1") == hex("00 00"));
  CHECK(b.pulse(0) == 6420);
  CHECK(b.pulse(1) == 4650);
  CHECK(b.says("9F 02 0B 14 32 2A 24 A1") == hex("10 00"));
}

TEST_CASE("maestro: with a check on, what fails it is an error", "[hal_sim][emulators]") {
  MaestroBoxOptions options = set_up();
  options.crc = true;
  Box b{options};
  CHECK(b.says("84 00 14 32 00").empty());
  CHECK(b.box.errors() == 0x0008);
  CHECK(b.pulse(0) == 6000);
  CHECK(b.says("A1 1B") == hex("08 00"));
  CHECK(b.says("84 00 70 2E 2B").empty());
  CHECK(b.says("90 00 65") == hex("70 17"));
  CHECK(b.says("84 00 14 32 00 84 00 A1 1B") == hex("18 00"));
  CHECK(b.says("FF 00 FE").empty());  // has none
  CHECK(b.pulse(0) == 7905);
}

TEST_CASE("maestro: the check of a packet with a device number", "[hal_sim][emulators]") {
  MaestroBoxOptions options = set_up();
  options.crc = true;
  options.device_number = 1;
  Box b{options};
  CHECK(b.says("AA 01 10 00 6B") == hex("70 17"));
}

TEST_CASE("maestro: stops by itself when nobody speaks to it", "[hal_sim][emulators]") {
  Box b;
  CHECK(b.says("84 00 14 32", 100).empty());
  CHECK(said_until(b.box, at_ms(599)).empty());
  CHECK(b.pulse(0) == 6420);
  CHECK(said_until(b.box, at_ms(600)).empty());
  CHECK(b.pulse(0) == 6000);
  CHECK(b.says("A1", 700) == hex("20 00"));
  CHECK(b.says("90 00", 710) == hex("70 17"));
  CHECK(b.says("84 00 14 32", 720).empty());
  CHECK(b.pulse(0) == 6420);
}

TEST_CASE("maestro: any valid command keeps it going, whatever it asks", "[hal_sim][emulators]") {
  Box b;
  CHECK(b.says("84 00 14 32", 0).empty());
  for (std::int64_t ms = 400; ms <= 4000; ms += 400) {
    CHECK(b.says(ms % 800 == 0 ? "A1" : "90 00", ms).size() == 2);
    CHECK(b.pulse(0) == 6420);
  }
  // What is no command of its own does not.
  CHECK(b.says("AA 0D 21", 4400).empty());
  CHECK(b.says("A1", 4500) == hex("20 00"));
  CHECK(b.pulse(0) == 6000);
}

TEST_CASE("maestro: without a time-out it runs on", "[hal_sim][emulators]") {
  MaestroBoxOptions options = set_up();
  options.time_out_10ms = 0;
  Box b{options};
  CHECK(b.says("84 00 14 32", 0).empty());
  CHECK(b.says("A1", 1'000'000) == hex("00 00"));
  CHECK(b.pulse(0) == 6420);
}

TEST_CASE("maestro: as it leaves the factory it ignores what comes over USB",
          "[hal_sim][emulators]") {
  MaestroBoxOptions options;
  options.mode = MaestroMode::kUartDetect;
  Box b{options};
  CHECK(b.says("AA A1").empty());
  CHECK(b.says("84 00 14 32").empty());
  CHECK(b.pulse(0) == 0);
}

TEST_CASE("maestro: started, and reset by a dip of its supply", "[hal_sim][emulators]") {
  Box b;
  CHECK(b.pulse(0) == 6000);
  CHECK(b.pulse(2) == 0);  // off, as it leaves the factory
  CHECK(b.says("84 00 14 32 84 02 14 32 84 00 84").empty());
  b.box.power_cycle(at_ms(10));
  CHECK(b.box.errors() == 0);
  CHECK(b.pulse(0) == 6000);
  CHECK(b.pulse(2) == 0);
  CHECK(b.says("84 00 14 32 84 00 84").empty());
  b.box.begin_fault(box_fault(FaultKind::kReset), at_ms(20));
  CHECK(b.pulse(0) == 0);
  CHECK(b.says("90 00", 30) == hex("00 00"));
  CHECK(b.says("A1", 30) == hex("00 00"));
}

TEST_CASE("maestro: faults of the box", "[hal_sim][emulators]") {
  Box b;
  b.box.begin_fault(box_fault(FaultKind::kRefuse, 0.0, 1.0), at_ms(0));
  CHECK(b.says("84 00 14 32 84 01 14 32").empty());
  CHECK(b.pulse(0) == 6420);
  CHECK(b.pulse(1) == 6000);
  b.box.begin_fault(box_fault(FaultKind::kNoTimeOut), at_ms(10));
  CHECK(b.says("A1", 5000) == hex("00 00"));
  b.box.begin_fault(box_fault(FaultKind::kWrongMode), at_ms(5000));
  CHECK(b.says("A1", 5010).empty());
  b.box.end_fault(box_fault(FaultKind::kWrongMode), at_ms(5020));
  CHECK(b.says("A1", 5030) == hex("00 00"));
  b.box.begin_fault(box_fault(FaultKind::kPower), at_ms(5040));
  CHECK(b.pulse(0) == 0);
  CHECK(b.says("A1", 5050).empty());
  b.box.end_fault(box_fault(FaultKind::kPower), at_ms(5060));
  CHECK(b.pulse(0) == 6000);
}

TEST_CASE("maestro: errors come at random, of three kinds, as often as is asked",
          "[hal_sim][emulators]") {
  Box b;
  b.box.begin_fault(box_fault(FaultKind::kError, 0.5), at_ms(0));
  std::uint64_t told = 0;
  unsigned kinds = 0;
  for (std::int64_t ms = 0; ms < 400'000; ms += 20) {
    const Bytes errors = b.says("84 00 14 32 A1", ms);
    told += errors[0] != 0 ? 1U : 0U;
    kinds |= errors[0];
  }
  CHECK(kinds == 0x38);
  CHECK(told > 150);  // 200
  CHECK(told < 260);
  CHECK(b.box.injections().of(FaultKind::kError).count == told);
}

}  // namespace
}  // namespace lodesman
