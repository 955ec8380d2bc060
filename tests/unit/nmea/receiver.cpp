// SPDX-License-Identifier: Apache-2.0
#include "drivers/nmea/nmea_receiver.h"

#include <fstream>

#include "tests/support/allocations.h"
#include "tests/support/data_dir.h"
#include "tests/unit/nmea/support.h"

namespace lodesman::testing {
namespace {

TEST_CASE("nmea: GGA and RMC of one time are one fix, with what each of them knows", "[nmea]") {
  Wired wired;
  wired.say("$GPGGA,123500.00,3501.6320,N,13854.0000,E,1,08,0.9,12.4,M,39.7,M,,*59\r\n");
  CHECK(wired.fixes().empty());
  wired.say("$GPRMC,123500.00,A,3501.6320,N,13854.0000,E,0.972,054.7,211126,007.6,W,A*25\r\n");
  const auto fixes = wired.fixes();
  REQUIRE(fixes.size() == 1);
  const PositionFix& fix = fixes.front();
  CHECK(fix.latitude_deg == Approx(35.0272).margin(1e-9));
  CHECK(fix.longitude_deg == Approx(138.9).margin(1e-9));
  CHECK(fix.measured == wired.now);
  CHECK(fix.quality == FixQuality::kSingle);
  CHECK(fix.source == FixSource::kNmea);
  CHECK(fix.sigma_m == Approx(3.0 * 0.9));
  CHECK(fix.utc_ns == 1795264500'000'000'000);  // 2026-11-21 12:35:00
  REQUIRE(fix.has_speed);
  CHECK(fix.speed_m_s == Approx(0.5).margin(1e-3));
  REQUIRE(fix.has_course);
  CHECK(fix.course_rad == Approx(0.954695).margin(1e-5));
  CHECK(wired.driver.fault() == DeviceFault::kNone);
}

TEST_CASE("nmea: the order of the sentences plays no part", "[nmea]") {
  Wired wired;
  Fixed fix;
  for (int i = 0; i < 5; ++i, fix.second_of_day += 1.0) {
    wired.say(rmc_line(fix));
    CHECK(wired.fixes().empty());
    wired.say(gga_line(fix));
    CHECK(wired.fixes().size() == 1);
    wired.pass(seconds{1});
  }
}

TEST_CASE("nmea: a receiver that sends one kind alone is waited for, and then no more", "[nmea]") {
  Wired wired;
  Fixed fix;
  const Time begun = wired.now;
  for (int i = 0; i < 8; ++i, fix.second_of_day += 1.0) {
    wired.say(rmc_line(fix));
    const bool known = i >= 3;
    INFO(i);
    CHECK(wired.fixes().size() == (known ? 1U : 0U));
    wired.pass(milliseconds{400});
    const auto late = wired.fixes();
    CHECK(late.size() == (known ? 0U : 1U));
    for (const PositionFix& one : late) {
      CHECK(one.measured == begun + seconds{i});
      CHECK(one.quality == FixQuality::kSingle);
      CHECK(one.sigma_m == Approx(6.0));  // without an HDOP, as if the satellites stood badly
    }
    wired.pass(milliseconds{600});
  }
  // The other kind is waited for again as soon as it comes.
  wired.say(rmc_line(fix) + gga_line(fix));
  CHECK(wired.fixes().size() == 1);
  wired.pass(seconds{1});
  fix.second_of_day += 1.0;
  wired.say(rmc_line(fix));
  CHECK(wired.fixes().empty());
  wired.say(gga_line(fix));
  CHECK(wired.fixes().size() == 1);
}

TEST_CASE("nmea: GGA alone gives fixes without a date, and VTG their speed", "[nmea]") {
  Wired wired;
  Fixed fix;
  std::vector<PositionFix> last;
  for (int i = 0; i < 6; ++i, fix.second_of_day += 1.0) {
    wired.say(gga_line(fix) + line_of("$GPVTG,090.0,T,,M,2.000,N,3.704,K,A"));
    wired.pass(seconds{1});
    last = wired.fixes();
    REQUIRE(last.size() == 1);
  }
  CHECK(last.front().utc_ns == 0);
  REQUIRE(last.front().has_speed);
  CHECK(last.front().speed_m_s == Approx(2.0 * 1852.0 / 3600.0));
  CHECK(last.front().course_rad == Approx(1.5707963));
}

TEST_CASE("nmea: accuracy goes by quality and HDOP", "[nmea]") {
  struct Row {
    int gga;
    FixQuality quality;
    double sigma_m;
  };
  Wired wired;
  Fixed fix;
  fix.hdop = 1.2;
  for (const Row& row : {Row{1, FixQuality::kSingle, 3.6}, Row{2, FixQuality::kDifferential, 1.2},
                         Row{5, FixQuality::kRtkFloat, 0.48}, Row{4, FixQuality::kRtkFixed, 0.024},
                         Row{3, FixQuality::kSingle, 3.6}}) {
    fix.quality = row.gga;
    const auto fixes = wired.fixes_of(fix);
    fix.second_of_day += 1.0;
    INFO(row.gga);
    REQUIRE(fixes.size() == 1);
    CHECK(fixes.front().quality == row.quality);
    CHECK(fixes.front().sigma_m == Approx(row.sigma_m));
  }
}

TEST_CASE("nmea: what is reckoned, entered by hand or simulated is no fix", "[nmea]") {
  Wired wired;
  Fixed fix;
  for (const int quality : {6, 7, 8, 0}) {
    fix.quality = quality;
    fix.second_of_day += 1.0;
    CHECK(wired.fixes_of(fix).empty());
    CHECK(wired.driver.fault() == DeviceFault::kNoFix);
  }
  CHECK(wired.driver.counts().voids == 4);
}

TEST_CASE("nmea: midnight is like any other second, and the date goes on", "[nmea]") {
  Wired wired;
  Fixed fix;
  fix.second_of_day = 86398.0;
  std::vector<PositionFix> all;
  for (int i = 0; i < 4; ++i, fix.second_of_day += 1.0) {
    fix.date = i < 2 ? "311226" : "010127";
    for (const PositionFix& one : wired.fixes_of(fix)) {
      all.push_back(one);
    }
  }
  REQUIRE(all.size() == 4);
  for (std::size_t i = 1; i < all.size(); ++i) {
    CHECK(all[i].utc_ns - all[i - 1].utc_ns == 1'000'000'000);
    CHECK(all[i].measured - all[i - 1].measured == seconds{1});
  }
}

TEST_CASE("nmea: sentences of one time that disagree on the place are refused", "[nmea]") {
  Wired wired;
  Fixed fix;
  Fixed damaged = fix;
  damaged.latitude_minutes += 0.1;
  wired.say(gga_line(fix) + rmc_line(damaged));
  CHECK(wired.fixes().empty());
  CHECK(wired.corrupt == 1);
  CHECK(wired.driver.fault() == DeviceFault::kImplausible);
  // One may have fewer digits than the other.
  wired.pass(seconds{1});
  fix.second_of_day += 1.0;
  Fixed rounded = fix;
  rounded.latitude_minutes += 0.001;
  wired.say(gga_line(fix) + rmc_line(rounded));
  CHECK(wired.fixes().size() == 1);
}

TEST_CASE("nmea: lines that arrive in batches do not show in the stamps", "[nmea]") {
  Wired wired;
  Fixed fix;
  fix.second_of_day = 45300.0;
  std::vector<Time> stamps;
  for (int i = 0; i < 50; ++i) {
    const Duration late = milliseconds{(i * 37) % 80};
    wired.pass(late);
    wired.say(gga_line(fix) + rmc_line(fix));
    for (const PositionFix& one : wired.fixes()) {
      CHECK(one.measured <= wired.now);
      stamps.push_back(one.measured);
    }
    wired.pass(milliseconds{200} - late);
    fix.second_of_day += 0.2;
  }
  REQUIRE(stamps.size() == 50);
  for (std::size_t i = 10; i < stamps.size(); ++i) {
    CHECK(std::abs(to_seconds(stamps[i] - stamps[i - 1]) - 0.2) < 0.001);
  }
}

// A recording of a receiver with RTK at 5 Hz, at the pace of its own times.
TEST_CASE("nmea: G7: a recorded RTK track has the accuracy of RTK, each of its times once",
          "[nmea]") {
  const auto path = data_path("nmea_usv_rtk/202412071309.txt");
  if (!path) {
    return;
  }
  std::ifstream stream{*path, std::ios::binary};
  Wired wired;
  std::string line;
  int given = 0;
  while (std::getline(stream, line)) {
    if (line.starts_with("$GPGGA")) {
      wired.pass(milliseconds{200});
    }
    wired.say(line + "\n");
    for (const PositionFix& fix : wired.fixes()) {
      CHECK(fix.quality == FixQuality::kRtkFixed);
      CHECK(fix.sigma_m <= 0.05);
      CHECK(fix.latitude_deg == Approx(22.5697).margin(0.01));
      CHECK(fix.has_speed);
      ++given;
    }
  }
  CHECK(given == 1268);
  CHECK(wired.driver.counts().voids == 0);
}

TEST_CASE("nmea: a poll takes nothing from the heap, whatever comes", "[nmea]") {
  Wired wired;
  Fixed fix;
  std::uint64_t taken = 0;
  int fresh = 0;
  for (int i = 0; i < 20; ++i, fix.second_of_day += 1.0, fix.latitude_minutes += 0.001) {
    wired.say(gga_line(fix) + "$GPRMC,garbage*00\r\n" + rmc_line(fix));
    const AllocationScope scope;
    for (int k = 0; k < 6; ++k) {
      fresh += wired.driver.poll(wired.now).status == ReadStatus::kFresh ? 1 : 0;
    }
    taken += scope.count();
    wired.pass(seconds{1});
  }
  CHECK(fresh == 20);
  CHECK(taken == 0);
}

}  // namespace
}  // namespace lodesman::testing
