// SPDX-License-Identifier: Apache-2.0
// What receivers do wrong (docs/device_faults.md).
#include "tests/unit/nmea/support.h"

namespace lodesman::testing {
namespace {

TEST_CASE("nmea: G1: a receiver that is silent is told of after 3 s by our own clock", "[nmea]") {
  Wired wired;
  Fixed fix;
  REQUIRE(wired.fixes_of(fix).size() == 1);
  wired.pass(milliseconds{1900});
  CHECK(wired.fixes().empty());
  CHECK(wired.driver.fault() == DeviceFault::kNone);
  wired.pass(milliseconds{200});
  CHECK(wired.fixes().empty());
  CHECK(wired.driver.fault() == DeviceFault::kNoAnswer);
  fix.second_of_day += 10.0;
  CHECK(wired.fixes_of(fix).size() == 1);
  CHECK(wired.driver.fault() == DeviceFault::kNone);
}

TEST_CASE("nmea: G1: an unplugged receiver is gone, and what was half said goes with it",
          "[nmea]") {
  Wired wired;
  Fixed fix;
  REQUIRE(wired.fixes_of(fix).size() == 1);
  fix.second_of_day += 1.0;
  const std::string rmc = rmc_line(fix);
  wired.say(gga_line(fix) + rmc.substr(0, 30));
  CHECK(wired.fixes().empty());
  wired.line.unplug();
  CHECK(wired.fixes().empty());
  CHECK(wired.last == ReadStatus::kDisconnected);
  CHECK(wired.driver.fault() == DeviceFault::kUnplugged);
  wired.line.plug();
  CHECK(wired.fixes().empty());
  wired.say(rmc.substr(30));
  CHECK(wired.fixes().empty());
  fix.second_of_day += 1.0;
  CHECK(wired.fixes_of(fix).size() == 1);
}

TEST_CASE("nmea: G4: one time is one fix, however often it is said", "[nmea]") {
  Wired wired;
  const Fixed fix;
  CHECK(wired.fixes_of(fix).size() == 1);
  CHECK(wired.fixes_of(fix).empty());
  CHECK(wired.fixes_of(fix).empty());
  Fixed before = fix;
  before.second_of_day -= 1.0;
  CHECK(wired.fixes_of(before).empty());
  CHECK(wired.driver.counts().given.fixes == 1);
  CHECK(wired.driver.counts().repeated >= 1);
}

TEST_CASE("nmea: G5: a fix that is lost is none, by either sentence's word", "[nmea]") {
  Wired wired;
  Fixed fix;
  REQUIRE(wired.fixes_of(fix).size() == 1);
  wired.say("$GPRMC,123501.00,V,,,,,,,211126,,,N*7E\r\n$GPGGA,123501.00,,,,,0,00,,,M,,M,,*4C\r\n");
  CHECK(wired.fixes().empty());
  CHECK(wired.driver.fault() == DeviceFault::kNoFix);
  wired.pass(seconds{1});
  // The old position, still said, with V or with quality 0.
  fix.second_of_day += 2.0;
  fix.status = 'V';
  CHECK(wired.fixes_of(fix).empty());
  fix.second_of_day += 1.0;
  fix.status = 'A';
  fix.quality = 0;
  CHECK(wired.fixes_of(fix).empty());
  fix.second_of_day += 1.0;
  fix.quality = 1;
  CHECK(wired.fixes_of(fix).size() == 1);
  CHECK(wired.driver.fault() == DeviceFault::kNone);
  CHECK(wired.driver.counts().voids == 3);
}

TEST_CASE("nmea: G5: a receiver that knows not even the time says that it has no fix", "[nmea]") {
  Wired wired;
  wired.say(line_of("$GPRMC,,V,,,,,,,,,,N") + line_of("$GPGGA,,,,,,0,00,99.9,,,,,,"));
  CHECK(wired.fixes().empty());
  CHECK(wired.driver.fault() == DeviceFault::kNoFix);
}

TEST_CASE("nmea: G8: latitude and longitude 0 are no place", "[nmea]") {
  Wired wired;
  wired.say(line_of("$GPGGA,123500.00,0000.0000,N,00000.0000,E,1,08,0.9,12.4,M,39.7,M,,") +
            line_of("$GPRMC,123500.00,A,0000.0000,N,00000.0000,E,0.972,054.7,211126,007.6,W,A"));
  CHECK(wired.fixes().empty());
  CHECK(wired.corrupt == 1);
  CHECK(wired.driver.fault() == DeviceFault::kImplausible);
  // The equator and the meridian of Greenwich are places.
  wired.pass(seconds{1});
  wired.say(line_of("$GPGGA,123501.00,0000.0000,N,00006.0000,W,1,08,0.9,12.4,M,39.7,M,,") +
            line_of("$GPRMC,123501.00,A,0000.0000,N,00006.0000,W,0.972,054.7,211126,007.6,W,A"));
  const auto fixes = wired.fixes();
  REQUIRE(fixes.size() == 1);
  CHECK(fixes.front().longitude_deg == Approx(-0.1));
}

TEST_CASE("nmea: G10: a date 1024 weeks back changes no stamp and is given to nobody", "[nmea]") {
  Wired wired;
  Fixed fix;
  std::vector<PositionFix> all;
  for (int i = 0; i < 12; ++i, fix.second_of_day += 1.0, fix.latitude_minutes += 0.001) {
    fix.date = i < 4 || i >= 8 ? "211126" : "070407";  // 7168 days before
    for (const PositionFix& one : wired.fixes_of(fix)) {
      all.push_back(one);
    }
    CHECK(wired.driver.fault() == (i < 4 || i >= 8 ? DeviceFault::kNone : DeviceFault::kWrongDate));
  }
  REQUIRE(all.size() == 12);
  for (std::size_t i = 0; i < all.size(); ++i) {
    CHECK((all[i].utc_ns == 0) == (i >= 4 && i < 8));
    CHECK(all[i].measured == all[0].measured + seconds{i});
  }
  CHECK(wired.driver.counts().given.wrong_dates == 4);
}

TEST_CASE("nmea: G10: a receiver that starts with such a date gives positions", "[nmea]") {
  Wired wired;
  Fixed fix;
  fix.date = "070407";
  const auto fixes = wired.fixes_of(fix);
  REQUIRE(fixes.size() == 1);
  CHECK(fixes.front().utc_ns == 0);
}

TEST_CASE("nmea: G13: a sentence without a good checksum changes nothing", "[nmea]") {
  Wired wired;
  Fixed fix;
  REQUIRE(wired.fixes_of(fix).size() == 1);
  fix.second_of_day += 1.0;
  std::string gga = gga_line(fix);
  std::string rmc = rmc_line(fix);
  gga[20] = gga[20] == '5' ? '6' : '5';
  rmc.erase(rmc.find('*'), 3);
  wired.say(gga + rmc);
  wired.pass(seconds{1});
  CHECK(wired.fixes().empty());
  CHECK(wired.corrupt == 1);
}

TEST_CASE("nmea: C3: a position that repeats itself under way is frozen after 10 s", "[nmea]") {
  Wired wired;
  Fixed fix;
  for (int i = 0; i < 5; ++i) {
    fix.second_of_day += 1.0;
    fix.latitude_minutes += 0.0003;
    REQUIRE(wired.fixes_of(fix).size() == 1);
  }
  int given = 0;
  for (int i = 0; i < 20; ++i) {
    fix.second_of_day += 1.0;
    given += static_cast<int>(wired.fixes_of(fix).size());
  }
  CHECK(given == 9);  // it is the last one that moved that the 10 s count from
  CHECK(wired.driver.fault() == DeviceFault::kFrozen);
  fix.second_of_day += 1.0;
  fix.latitude_minutes += 0.01;
  CHECK(wired.fixes_of(fix).size() == 1);
  CHECK(wired.driver.fault() == DeviceFault::kNone);
}

TEST_CASE("nmea: C3: a receiver that holds its position at rest is not frozen", "[nmea]") {
  Wired wired;
  Fixed fix;
  fix.knots = 0.1;
  for (int i = 0; i < 30; ++i) {
    fix.second_of_day += 1.0;
    CHECK(wired.fixes_of(fix).size() == 1);
  }
  CHECK(wired.driver.counts().given.frozen == 0);
}

TEST_CASE("nmea: a receiver whose time goes back by its leap seconds is believed again", "[nmea]") {
  Wired wired;
  Fixed fix;
  for (int i = 0; i < 5; ++i) {
    fix.second_of_day += 1.0;
    REQUIRE(wired.fixes_of(fix).size() == 1);
  }
  fix.second_of_day -= 3.0;
  Time newest{};
  for (int i = 0; i < 20; ++i) {
    fix.second_of_day += 1.0;
    fix.latitude_minutes += 0.001;
    for (const PositionFix& one : wired.fixes_of(fix)) {
      newest = one.measured;
    }
  }
  CHECK(newest == wired.now - seconds{1});
}

}  // namespace
}  // namespace lodesman::testing
