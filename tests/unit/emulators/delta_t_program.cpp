// SPDX-License-Identifier: Apache-2.0
// The Delta T's program as a boat meets it: pings, settings, numbers, latencies and its own faults.
#include "hal_sim/emulators/delta_t_program.h"

#include <algorithm>
#include <functional>
#include <random>

#include "mid_level/base/heading.h"
#include "tests/support/catch.h"
#include "tests/unit/emulators/support.h"

namespace lodesman {
namespace {

using namespace lodesman::testing;

[[nodiscard]] unsigned u16(const Bytes& record, std::size_t at) {
  return (unsigned{record[at]} << 8U) | record[at + 1];
}
[[nodiscard]] unsigned u32(const Bytes& record, std::size_t at) {
  return (u16(record, at) << 16U) | u16(record, at + 2);
}
[[nodiscard]] std::string tag(const Bytes& record) { return {record.begin(), record.begin() + 3}; }

// A program that pings every 100 ms into water where one surface lies so far away in every beam.
struct Pinging {
  DeltaTProgram program;
  double surface_m = 6.0;
  std::int64_t ms = 0;

  explicit Pinging(const DeltaTProgramOptions& options = {}) : program{options, at_ms(0)} {}

  // The next record that is sent; empty where the ping gives none.
  [[nodiscard]] Utterance next() {
    REQUIRE(program.is_due(at_ms(ms)));
    program.ping(std::vector<double>(program.beams(), surface_m), {}, at_ms(ms));
    std::vector<Utterance> said = said_until(program, at_ms(ms));
    ms += 100;
    REQUIRE(said.size() <= 1);
    return said.empty() ? Utterance{} : said.front();
  }
  [[nodiscard]] Bytes next_record() { return next().bytes; }
  void control(const std::function<void(Bytes&)>& change) {
    Bytes frame =
        hex("45 43 00 01 00 00 00 05 0A 32 00 03 00 02 00 00 00 3A 98 03 01 01 00 1E 00 B4");
    frame.resize(256);
    change(frame);
    CHECK(answer(program, frame, at_ms(ms)).empty());
  }
};

// The first bin of a beam with an echo, or -1.
[[nodiscard]] int first_echo(const Bytes& record, std::size_t beam) {
  for (int bin = 0; bin < 500; ++bin) {
    if (record[256 + beam * 500 + static_cast<std::size_t>(bin)] != 0) {
      return bin;
    }
  }
  return -1;
}

TEST_CASE("delta_t program: an image a ping, numbered, with its latencies",
          "[hal_sim][emulators]") {
  Pinging pinging;
  const Utterance first = pinging.next();
  REQUIRE(first.bytes.size() == 60256);
  CHECK(tag(first.bytes) == "83B");
  CHECK(u32(first.bytes, 93) == 1);
  CHECK(first_echo(first.bytes, 0) == 100);  // 6 m of 30 in 500 bins
  CHECK(first.bytes[256 + 100] == 200);
  CHECK(u16(first.bytes, 79) == 30);
  CHECK(u16(first.bytes, 85) == 60);
  CHECK(u16(first.bytes, 91) == 100);
  CHECK(u16(first.bytes, 76) == 0x2F12);
  CHECK(first.bytes[78] == 100);
  // Half a millisecond, 40 ms of sound and 10 of work.
  CHECK(u16(first.bytes, 118) == 5);
  CHECK(u16(first.bytes, 120) == 505);
  CHECK(first.begins == at_ms(50));
  const Bytes second = pinging.next_record();
  CHECK(u32(second, 93) == 2);
  CHECK(Bytes(second.begin() + 8, second.begin() + 31) ==
        hex("32 31 2D 4E 4F 56 2D 32 30 32 36 00 31 32 3A 33 35 3A 30 30 00 2E 31"));
}

TEST_CASE("delta_t program: latency to a grid, and none at all", "[hal_sim][emulators]") {
  DeltaTProgramOptions options;
  options.leaves_at_multiples_of = std::chrono::milliseconds{20};
  Pinging gridded{options};
  const Utterance on_grid = gridded.next();
  CHECK(on_grid.begins == at_ms(60));
  CHECK(u16(on_grid.bytes, 120) - u16(on_grid.bytes, 118) == 600);
  options.instant = true;
  Pinging instant{options};
  const Utterance at_once = instant.next();
  CHECK(at_once.begins == at_ms(0));
  CHECK(u16(at_once.bytes, 118) == 0);
  CHECK(u16(at_once.bytes, 120) == 0);
}

TEST_CASE("delta_t program: a frame counts from the next ping on", "[hal_sim][emulators]") {
  Pinging pinging;
  static_cast<void>(pinging.next());
  pinging.control([](Bytes& frame) {
    frame[7] = 3;
    frame[8] = 4;
  });
  const Bytes nearer = pinging.next_record();
  CHECK(u16(nearer, 79) == 10);
  CHECK(u16(nearer, 85) == 20);
  CHECK(first_echo(nearer, 7) == 300);
  CHECK(nearer[256 + 7 * 500 + 300] == 100);  // 6 dB down
  pinging.control([](Bytes& frame) {
    frame[20] = 0;     // profile
    frame[11] = 2;     // 90 degrees
    frame[13] = 1;     // 240 beams
    frame[17] = 0x39;  // 1480 m/s
    frame[18] = 0xD0;
  });
  const Bytes profile = pinging.next_record();
  CHECK(tag(profile) == "83P");
  REQUIRE(profile.size() == 256 + 4 * 240);
  CHECK(u16(profile, 70) == 240);
  CHECK(u16(profile, 74) == 90);
  CHECK(profile[78] == 37);  // 0.375 degrees: what the byte does not hold is cut off
  CHECK(u16(profile, 83) == (0x8000 | 14800));
  CHECK(profile[122] == 1);
  CHECK(u16(profile, 85) == 6);
  CHECK(u16(profile, 256) == 1000);  // 6 m in 6 mm
  CHECK(u16(profile, 256 + 2 * 240) == 200);
  CHECK(u32(profile, 93) == 3);
  // The beams lie where the header says.
  const double start_deg = u16(profile, 76) / 100.0 - 180.0;
  CHECK(to_deg(pinging.program.bearing_rad(0)) == Approx(start_deg).margin(0.006));
  CHECK(to_deg(pinging.program.bearing_rad(239)) == Approx(start_deg + 239 * 0.37).margin(0.006));
  pinging.control([](Bytes& frame) {
    frame[20] = 0;
    frame[21] = 0;
  });
  CHECK(pinging.next_record().empty());  // a profile without its points
  pinging.control([](Bytes& frame) { frame[4] = 1; });
  CHECK(first_echo(pinging.next_record(), 0) == -1);  // it listens alone
}

TEST_CASE("delta_t program: images come of 120 beams over 120 degrees, or as asked",
          "[hal_sim][emulators]") {
  const auto ask = [](Pinging& pinging) {
    pinging.control([](Bytes& frame) {
      frame[11] = 2;
      frame[13] = 2;
    });
    return pinging.next_record();
  };
  Pinging strict;
  CHECK(u16(ask(strict), 74) == 120);
  DeltaTProgramOptions options;
  options.images_are_120_by_120 = false;
  Pinging free{options};
  const Bytes asked = ask(free);
  CHECK(u16(asked, 74) == 90);
  CHECK(asked[78] == 75);
  CHECK(u16(asked, 76) == 13538);  // -44.625 degrees, rounded
  free.control([](Bytes& frame) { frame[13] = 0; });
  CHECK(free.next_record().empty());  // 480 x 500 bytes fit no datagram
}

TEST_CASE("delta_t program: nothing is heard from beyond its range", "[hal_sim][emulators]") {
  Pinging pinging;
  for (const double share : {1.0, 1.2, 2.0, 3.0}) {
    pinging.surface_m = 30.0 * share;
    const Bytes image = pinging.next_record();
    CHECK(std::count(image.begin() + 256, image.end(), 0) == 120 * 500);
  }
  pinging.control([](Bytes& frame) { frame[20] = 0; });
  pinging.surface_m = 36.0;
  const Bytes profile = pinging.next_record();
  CHECK(std::count(profile.begin() + 256, profile.end(), 0) == 4 * 120);
}

TEST_CASE("delta_t program: no ping before the sound of the last one is back",
          "[hal_sim][emulators]") {
  Pinging pinging;
  pinging.control([](Bytes& frame) { frame[7] = 12; });  // 200 m: 267 ms
  const Bytes far = pinging.next_record();
  CHECK(u16(far, 91) == 267);
  CHECK_FALSE(pinging.program.is_due(at_ms(200)));
  CHECK(pinging.program.is_due(at_ms(267)));
}

TEST_CASE("delta_t program: averaging smears what moves, and the header tells of it",
          "[hal_sim][emulators]") {
  Pinging pinging;
  pinging.control([](Bytes& frame) { frame[14] = 2; });
  static_cast<void>(pinging.next());
  pinging.surface_m = 9.0;
  const Bytes mean = pinging.next_record();
  CHECK(mean[125] == 2);
  CHECK(u16(mean, 126) == 500);
  CHECK(mean[256 + 100] == 100);
  CHECK(mean[256 + 150] == 100);
  pinging.control([](Bytes& frame) { frame[14] = 0; });
  const Bytes sharp = pinging.next_record();
  CHECK(sharp[125] == 0);
  CHECK(first_echo(sharp, 0) == 150);
}

TEST_CASE("delta_t faults: numbers that repeat and that jump either way", "[hal_sim][emulators]") {
  Pinging pinging;
  static_cast<void>(pinging.next());
  pinging.program.begin_fault(sonar_fault(FaultKind::kRepeat, 1.0), at_ms(100));
  CHECK(u32(pinging.next_record(), 93) == 1);
  CHECK(pinging.program.injections().of(FaultKind::kRepeat).count == 1);
  pinging.program.end_fault(sonar_fault(FaultKind::kRepeat), at_ms(200));
  pinging.program.begin_fault(sonar_fault(FaultKind::kJump, 0.0, 1000.0), at_ms(200));
  CHECK(u32(pinging.next_record(), 93) == 1002);
  CHECK(u32(pinging.next_record(), 93) == 1003);
  pinging.program.begin_fault(sonar_fault(FaultKind::kJump, 0.0, -500.0), at_ms(400));
  CHECK(u32(pinging.next_record(), 93) == 504);
}

TEST_CASE("delta_t faults: its user changes what it was told, and it can be told again",
          "[hal_sim][emulators]") {
  Pinging pinging;
  pinging.program.begin_fault(sonar_fault(FaultKind::kRange, 0.0, 10.0), at_ms(0));
  pinging.program.begin_fault(sonar_fault(FaultKind::kOutput), at_ms(0));
  const Bytes changed = pinging.next_record();
  CHECK(tag(changed) == "83P");
  CHECK(u16(changed, 79) == 10);
  pinging.control([](Bytes&) {});
  const Bytes again = pinging.next_record();
  CHECK(tag(again) == "83B");
  CHECK(u16(again, 79) == 30);
}

TEST_CASE("delta_t faults: averaging that cannot be put off, and centimetres",
          "[hal_sim][emulators]") {
  Pinging pinging;
  pinging.program.begin_fault(sonar_fault(FaultKind::kAverage, 0.0, 5.0), at_ms(0));
  pinging.program.begin_fault(sonar_fault(FaultKind::kCentimetres), at_ms(0));
  pinging.control([](Bytes& frame) { frame[14] = 0; });
  const Bytes record = pinging.next_record();
  CHECK(record[125] == 5);
  CHECK(u16(record, 85) == 6);
  pinging.program.end_fault(sonar_fault(FaultKind::kAverage), at_ms(0));
  pinging.program.end_fault(sonar_fault(FaultKind::kCentimetres), at_ms(0));
  const Bytes after = pinging.next_record();
  CHECK(after[125] == 0);
  CHECK(u16(after, 85) == 60);
}

TEST_CASE("delta_t faults: a length that is not true, and datagrams for others",
          "[hal_sim][emulators]") {
  Pinging pinging;
  const Bytes good = pinging.next_record();
  pinging.program.begin_fault(sonar_fault(FaultKind::kCorrupt), at_ms(100));
  const Bytes bad = pinging.next_record();
  CHECK(bad.size() == good.size());
  CHECK(bad[5] != good[5]);
  CHECK(pinging.program.injections().of(FaultKind::kCorrupt).count == 1);
  pinging.program.begin_fault(sonar_fault(FaultKind::kForeign, 20.0), at_ms(200));
  const auto foreign = said_until(pinging.program, at_ms(10'100));
  CHECK(foreign.size() > 120);  // 200
  CHECK(foreign.size() < 300);
  CHECK(pinging.program.injections().of(FaultKind::kForeign).count == foreign.size());
  bool any_other_tag = false;
  for (const Utterance& utterance : foreign) {
    REQUIRE(utterance.bytes.size() < 2100);
    any_other_tag = any_other_tag || (utterance.bytes.size() > 3 && tag(utterance.bytes) == "83Z");
  }
  CHECK(any_other_tag);
}

TEST_CASE("delta_t faults: switched off it is silent, and on again it is as its user left it",
          "[hal_sim][emulators]") {
  Pinging pinging;
  pinging.control([](Bytes& frame) { frame[7] = 3; });
  static_cast<void>(pinging.next());
  pinging.program.begin_fault(sonar_fault(FaultKind::kPower), at_ms(100));
  CHECK_FALSE(pinging.program.is_due(at_ms(200)));
  CHECK(said_until(pinging.program, at_ms(200)).empty());
  pinging.program.end_fault(sonar_fault(FaultKind::kPower), at_ms(300));
  pinging.ms = 300;
  const Bytes anew = pinging.next_record();
  CHECK(u32(anew, 93) == 1);
  CHECK(u16(anew, 79) == 30);
}

TEST_CASE("any bytes: a Delta T's program goes on", "[hal_sim][emulators]") {
  std::mt19937 random{7};
  Pinging pinging;
  for (int lot = 0; lot < 500; ++lot) {
    Bytes sent(random() % 2 == 0 ? 256 : random() % 600);
    for (std::uint8_t& byte : sent) {
      byte = static_cast<std::uint8_t>(random() & 0xFFU);
    }
    if (sent.size() >= 4 && random() % 2 == 0) {
      std::copy_n(hex("45 43 00 01").begin(), 4, sent.begin());
    }
    CHECK(answer(pinging.program, sent, at_ms(pinging.ms)).empty());
    pinging.ms += 1000;
    const Bytes record = pinging.next_record();
    REQUIRE(record.size() <= 65507);
  }
  pinging.control([](Bytes&) {});
  CHECK(pinging.next_record().size() == 60256);
}

}  // namespace
}  // namespace lodesman
