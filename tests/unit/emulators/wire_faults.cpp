// SPDX-License-Identifier: Apache-2.0
// How often the faults of a line happen, and that none depends on another. The bounds are four
// standard deviations and more away from what is expected.
#include <algorithm>
#include <cmath>
#include <set>

#include "hal_sim/emulators/wire.h"
#include "tests/support/catch.h"
#include "tests/unit/emulators/support.h"

namespace lodesman {
namespace {

using namespace lodesman::testing;

constexpr int kManyBytes = 100'000;

// Sends `count` bytes of 0xA5, a thousand at a time, 100 ms from one lot to the next.
[[nodiscard]] Bytes through(EmulatedWire& wire, int count = kManyBytes) {
  std::vector<TimedByte> bytes;
  for (int lot = 0; lot < count / 1000; ++lot) {
    wire.from_device({at_ms(100 * lot), Bytes(1000, 0xA5)}, false, 0, 0);
    wire.to_host(at_ms(100 * lot), bytes);
  }
  Bytes all;
  for (const TimedByte& byte : bytes) {
    all.push_back(byte.value);
  }
  return all;
}

[[nodiscard]] Bytes with(std::initializer_list<Fault> faults, std::uint64_t seed = 1,
                         double thrust_share = 0.0) {
  EmulatedWire wire{"test", seed};
  wire.set_thrust_share(thrust_share);
  for (const Fault& fault : faults) {
    wire.begin_fault(fault, at_ms(0));
  }
  return through(wire);
}

[[nodiscard]] auto others_in(const Bytes& bytes) {
  return static_cast<std::int64_t>(bytes.size()) - std::count(bytes.begin(), bytes.end(), 0xA5);
}

TEST_CASE("wire faults: bytes are hit as often as is asked, the same with the same seed",
          "[hal_sim][emulators]") {
  const Fault flip = ahrs_fault(FaultKind::kFlip, 0.01);
  const Bytes flipped = with({flip});
  CHECK(flipped.size() == kManyBytes);
  CHECK(others_in(flipped) > 870);
  CHECK(others_in(flipped) < 1130);
  CHECK(flipped == with({flip}));
  CHECK(flipped != with({flip}, 2));
  std::set<std::uint8_t> seen{flipped.begin(), flipped.end()};
  CHECK(seen.size() > 200);  // it becomes any other
  const auto lost = kManyBytes - with({ahrs_fault(FaultKind::kDrop, 0.01)}).size();
  CHECK(lost > 870);
  CHECK(lost < 1130);
  const Bytes doubled = with({ahrs_fault(FaultKind::kDuplicate, 0.01)});
  CHECK(doubled.size() > kManyBytes + 870);
  CHECK(doubled.size() < kManyBytes + 1130);
  CHECK(others_in(doubled) == 0);
}

TEST_CASE("wire faults: half of the inserted bytes mean something", "[hal_sim][emulators]") {
  const Bytes bytes = with({ahrs_fault(FaultKind::kInsert, 0.02)});
  const double inserted = static_cast<double>(bytes.size()) - kManyBytes;
  CHECK(inserted > 1820);
  CHECK(inserted < 2180);
  for (const int telling : {0x55, 0x11, 0x13, 0xFF, 0x00}) {
    const auto count = static_cast<double>(std::count(bytes.begin(), bytes.end(), telling));
    CHECK(count / inserted > 0.07);
    CHECK(count / inserted < 0.14);
  }
}

TEST_CASE("wire faults: every injection is counted", "[hal_sim][emulators]") {
  EmulatedWire wire{"test", 1};
  wire.begin_fault(ahrs_fault(FaultKind::kFlip, 0.01), at_ms(0));
  const Bytes bytes = through(wire);
  const Injection& flips = wire.injections().of(FaultKind::kFlip);
  CHECK(flips.count == static_cast<std::uint64_t>(others_in(bytes)));
  CHECK(flips.last > at_ms(9000));
  CHECK(wire.injections().of(FaultKind::kDrop).count == 0);
  wire.end_fault(ahrs_fault(FaultKind::kFlip));
  CHECK(others_in(through(wire)) == 0);
  // On their way to the device too, by a stream of its own.
  wire.begin_fault(ahrs_fault(FaultKind::kFlip, 1.0), at_ms(20'000));
  wire.from_host(0xA5, at_ms(20'000), 0, 0);
  CHECK(wire.next_to_device(at_ms(20'000))->value != 0xA5);
}

TEST_CASE("wire faults: one more moves none of the others", "[hal_sim][emulators]") {
  const Fault flip = ahrs_fault(FaultKind::kFlip, 0.01);
  const Bytes alone = with({flip});
  // With every byte twice, and with cuts and more flips, the first flips hit the same bytes.
  const Bytes doubled = with({flip, ahrs_fault(FaultKind::kDuplicate, 1.0)});
  REQUIRE(doubled.size() == 2 * alone.size());
  for (std::size_t i = 0; i < alone.size(); ++i) {
    REQUIRE(doubled[2 * i] == alone[i]);
  }
  Fault later = flip;
  later.at_s = 1.0;
  const Bytes more = with({flip, later});
  std::size_t kept = 0;
  std::size_t hit = 0;
  for (std::size_t i = 0; i < alone.size(); ++i) {
    kept += alone[i] != 0xA5 && more[i] == alone[i] ? 1U : 0U;
    hit += alone[i] != 0xA5 ? 1U : 0U;
  }
  CHECK(kept > hit * 95 / 100);
  CHECK(others_in(more) > others_in(alone) * 3 / 2);
}

TEST_CASE("wire faults: a cut moves no flip", "[hal_sim][emulators]") {
  const auto first_bytes = [](bool cut) {
    EmulatedWire wire{"test", 5};
    wire.begin_fault(ahrs_fault(FaultKind::kFlip, 0.2), at_ms(0));
    if (cut) {
      wire.begin_fault(ahrs_fault(FaultKind::kCut, 0.5), at_ms(0));
    }
    std::vector<Bytes> lots;
    for (int i = 0; i < 200; ++i) {
      std::vector<TimedByte> bytes;
      wire.from_device({at_ms(i), Bytes(39, 0xA5)}, false, 0, 0);
      wire.to_host(at_ms(i), bytes);
      lots.emplace_back();
      for (const TimedByte& byte : bytes) {
        lots.back().push_back(byte.value);
      }
    }
    return lots;
  };
  const auto whole = first_bytes(false);
  const auto cut = first_bytes(true);
  std::size_t shorter = 0;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    REQUIRE(whole[i].size() == 39);
    shorter += cut[i].size() < 39 ? 1U : 0U;
    CHECK(std::equal(cut[i].begin(), cut[i].end(), whole[i].begin()));
  }
  CHECK(shorter > 70);
  CHECK(shorter < 130);
}

TEST_CASE("wire faults: bursts come in bad spells", "[hal_sim][emulators][plain]") {
  EmulatedWire wire{"test", 1};
  wire.begin_fault(ahrs_fault(FaultKind::kBurst, 0.3), at_ms(0));
  // A byte a millisecond for three hours: 20 ms of every 10.02 s are bad.
  std::int64_t hit = 0;
  std::int64_t spells = 0;
  std::int64_t last_hit_ms = -1'000'000;
  std::vector<TimedByte> bytes;
  constexpr std::int64_t kLast_ms = 10'800'000;
  for (std::int64_t ms = 0; ms < kLast_ms; ++ms) {
    bytes.clear();
    wire.from_device({at_ms(ms), {0xA5}}, false, 0, 0);
    wire.to_host(at_ms(ms), bytes);
    if (bytes.at(0).value != 0xA5) {
      ++hit;
      spells += ms - last_hit_ms > 500 ? 1 : 0;
      last_hit_ms = ms;
    }
  }
  const double bad_share = static_cast<double>(hit) / (0.3 * static_cast<double>(kLast_ms));
  CHECK(bad_share > 0.0017);
  CHECK(bad_share < 0.0023);
  CHECK(spells > 750);  // of 1078 spells those that hit a byte
  CHECK(spells < 1078);
}

TEST_CASE("wire faults: interference grows with the square of the thrust", "[hal_sim][emulators]") {
  const Fault interference = ahrs_fault(FaultKind::kInterference, 0.04);
  CHECK(others_in(with({interference}, 1, 0.0)) < 5);
  const auto full = others_in(with({interference}, 1, 1.0));
  CHECK(full > 3750);
  CHECK(full < 4250);
  const auto half = others_in(with({interference}, 1, 0.5));
  CHECK(half > 870);
  CHECK(half < 1130);
}

TEST_CASE("wire faults: corrupt spoils one byte of everything that is said",
          "[hal_sim][emulators]") {
  EmulatedWire wire{"test", 1};
  wire.begin_fault(ahrs_fault(FaultKind::kCorrupt), at_ms(0));
  std::set<std::size_t> places;
  for (int i = 0; i < 500; ++i) {
    std::vector<TimedByte> bytes;
    wire.from_device({at_ms(i), Bytes(39, 0xA5)}, false, 0, 0);
    wire.to_host(at_ms(i), bytes);
    REQUIRE(bytes.size() == 39);
    std::size_t spoilt = 0;
    for (std::size_t k = 0; k < bytes.size(); ++k) {
      if (bytes[k].value != 0xA5) {
        ++spoilt;
        places.insert(k);
      }
    }
    REQUIRE(spoilt == 1);
  }
  CHECK(places.size() == 39);
  CHECK(wire.injections().of(FaultKind::kCorrupt).count == 500);
}

TEST_CASE("wire faults: answers are late, a stream is not", "[hal_sim][emulators]") {
  EmulatedWire wire{"test", 1};
  wire.begin_fault(box_fault(FaultKind::kLate, 0.05, 0.1), at_ms(0));
  std::uint64_t late = 0;
  Duration least = std::chrono::seconds{9};
  Duration most{};
  for (int i = 0; i < 4000; ++i) {
    const Time said = at_ms(1000 * i);
    std::vector<TimedByte> bytes;
    wire.from_device({said, {1}}, true, 0, 0);
    wire.from_device({said, {2}}, false, 0, 0);
    wire.to_host(said + std::chrono::milliseconds{999}, bytes);
    REQUIRE(bytes.size() == 2);
    CHECK(bytes.at(bytes[0].value == 2 ? 0 : 1).at == said);
    if (bytes[1].value == 1) {
      ++late;
      least = std::min(least, bytes[1].at - said);
      most = std::max(most, bytes[1].at - said);
    }
  }
  CHECK(late > 145);  // 200
  CHECK(late < 260);
  CHECK(wire.injections().of(FaultKind::kLate).count == late);
  CHECK(least >= std::chrono::milliseconds{100});
  CHECK(least < std::chrono::milliseconds{110});
  CHECK(most <= std::chrono::milliseconds{300});
  CHECK(most > std::chrono::milliseconds{290});
}

TEST_CASE("wire faults: batches while the fault lasts", "[hal_sim][emulators]") {
  EmulatedWire wire{"test", 1};
  wire.begin_fault(ahrs_fault(FaultKind::kBatch, 0.0, 0.016), at_ms(0));
  std::vector<TimedByte> bytes;
  wire.from_device({at_ms(1), {1}}, false, 0, 0);
  wire.to_host(at_ms(15), bytes);
  CHECK(bytes.empty());
  wire.to_host(at_ms(16), bytes);
  REQUIRE(bytes.size() == 1);
  CHECK(bytes[0].at == at_ms(16));
  wire.end_fault(ahrs_fault(FaultKind::kBatch));
  wire.from_device({at_ms(17), {1}}, false, 0, 0);
  wire.to_host(at_ms(17), bytes);
  REQUIRE(bytes.size() == 2);
  CHECK(bytes[1].at == at_ms(17));
}

// For how long a line was away, each time, in a day.
struct Absences {
  std::vector<double> away_s;
  std::vector<double> present_s;
  std::uint64_t renames = 0;
  std::uint64_t counted = 0;
};
[[nodiscard]] Absences absences(const Fault& fault, double thrust_share, bool silence) {
  EmulatedWire wire{"test", 1};
  wire.set_thrust_share(thrust_share);
  wire.begin_fault(fault, at_ms(0));
  Absences all;
  std::int64_t changed_ms = 0;
  bool away = false;
  for (std::int64_t ms = 0; ms < 86'400'000; ms += 10) {
    wire.advance(at_ms(ms));
    std::vector<TimedByte> bytes;
    if (silence) {
      wire.from_device({at_ms(ms), {1}}, false, 0, 0);
      wire.to_host(at_ms(ms), bytes);
    }
    if (const bool is_away = silence ? bytes.empty() : !wire.plugged(); is_away != away) {
      (away ? all.away_s : all.present_s).push_back(static_cast<double>(ms - changed_ms) * 1e-3);
      away = is_away;
      changed_ms = ms;
    }
  }
  all.renames = wire.renames();
  all.counted = wire.injections().of(fault.kind).count;
  return all;
}

[[nodiscard]] double mean_log(const std::vector<double>& lengths_s) {
  double sum = 0.0;
  for (const double s : lengths_s) {
    sum += std::log(s);
  }
  return sum / static_cast<double>(lengths_s.size());
}

TEST_CASE("wire faults: unplugged now and then, for 0.1 to 5 s", "[hal_sim][emulators]") {
  const Absences all = absences(ahrs_fault(FaultKind::kReplug, 2.0), 0.0, false);
  const auto count = static_cast<double>(all.away_s.size());
  CHECK(count > 2550);  // 2 a minute while it is there, and a tenth more
  CHECK(count < 3300);
  CHECK(all.counted >= all.away_s.size());
  CHECK(*std::min_element(all.away_s.begin(), all.away_s.end()) >= 0.1);
  CHECK(*std::max_element(all.away_s.begin(), all.away_s.end()) <= 5.02);
  CHECK(mean_log(all.away_s) == Approx(0.5 * (std::log(0.1) + std::log(5.0))).margin(0.1));
  CHECK(static_cast<double>(all.renames) / count == Approx(0.5).margin(0.05));
  const auto again = std::count_if(all.present_s.begin(), all.present_s.end(),
                                   [](double s) { return s > 0.195 && s < 0.215; });
  CHECK(static_cast<double>(again) / count > 0.06);
  CHECK(static_cast<double>(again) / count < 0.14);
}

TEST_CASE("wire faults: silent now and then, for 50 ms to 30 s", "[hal_sim][emulators][plain]") {
  const Absences all = absences(ahrs_fault(FaultKind::kHang, 1.0), 0.0, true);
  CHECK(all.away_s.size() > 1150);  // 1 a minute of what is left of the day
  CHECK(all.away_s.size() < 1440);
  CHECK(*std::min_element(all.away_s.begin(), all.away_s.end()) >= 0.05);
  CHECK(*std::max_element(all.away_s.begin(), all.away_s.end()) <= 30.02);
  CHECK(mean_log(all.away_s) == Approx(0.5 * (std::log(0.05) + std::log(30.0))).margin(0.25));
}

TEST_CASE("wire faults: interference unplugs for 100 ms, by the square of the thrust",
          "[hal_sim][emulators]") {
  const Absences full = absences(ahrs_fault(FaultKind::kInterference, 0.0), 1.0, false);
  CHECK(full.away_s.size() >= 3);  // 14.4 a day
  CHECK(full.away_s.size() <= 32);
  for (const double s : full.away_s) {
    CHECK(s == Approx(0.1).margin(0.001));
  }
  CHECK(absences(ahrs_fault(FaultKind::kInterference, 0.0), 0.0, false).away_s.empty());
}

}  // namespace
}  // namespace lodesman
