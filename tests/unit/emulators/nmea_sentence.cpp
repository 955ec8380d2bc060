// SPDX-License-Identifier: Apache-2.0
// NMEA 0183 sentences byte for byte, with sums that were checked against gpsd 3.22.
#include "hal_sim/emulators/nmea_sentence.h"

#include "tests/support/catch.h"

namespace lodesman {
namespace {

using namespace lodesman::emulated;

[[nodiscard]] NmeaFix example() {
  NmeaFix fix;
  fix.time = {2026, 11, 21, 12, 35, 0, 0};
  fix.latitude_deg = 35.0272;
  fix.longitude_deg = 138.9;
  fix.altitude_m = 12.4;
  fix.geoid_m = 39.7;
  fix.speed_m_s = 0.5;
  fix.course_deg = 54.7;
  fix.variation_deg = -7.6;
  fix.heading_deg = 56.2;
  return fix;
}

TEST_CASE("nmea sentence: the documented ones to the byte", "[hal_sim][emulators]") {
  const NmeaManner manner;
  const NmeaFix fix = example();
  CHECK(rmc(fix, manner) ==
        "$GPRMC,123500.00,A,3501.6320,N,13854.0000,E,0.972,054.7,211126,007.6,W,A*25\r\n");
  CHECK(gga(fix, manner) ==
        "$GPGGA,123500.00,3501.6320,N,13854.0000,E,1,08,0.9,12.4,M,39.7,M,,*59\r\n");
  CHECK(vtg(fix, manner) == "$GPVTG,054.7,T,062.3,M,0.972,N,1.800,K,A*27\r\n");
  CHECK(hdt(fix, manner) == "$GPHDT,056.20,T*04\r\n");
  NmeaFix other = fix;
  other.heading_deg = 274.07;
  CHECK(hdt(other, manner) == "$GPHDT,274.07,T*03\r\n");
}

TEST_CASE("nmea sentence: without a fix the commas are left", "[hal_sim][emulators]") {
  NmeaFix fix = example();
  fix.time.second = 1;
  fix.quality = NmeaQuality::kNone;
  CHECK(rmc(fix, {}) == "$GPRMC,123501.00,V,,,,,,,211126,,,N*7E\r\n");
  CHECK(gga(fix, {}) == "$GPGGA,123501.00,,,,,0,00,,,M,,M,,*4C\r\n");
  CHECK(vtg(fix, {}).find("$GPVTG,,T,,M,,N,,K,N*") == 0);
}

TEST_CASE("nmea sentence: at rest there is no course, and a receiver may write finer",
          "[hal_sim][emulators]") {
  NmeaFix fix;
  fix.time = {2017, 1, 10, 0, 10, 31, 0};
  fix.latitude_deg = 44.0 + 4.13993 / 60.0;
  fix.longitude_deg = -(121.0 + 18.86023 / 60.0);
  fix.speed_m_s = 0.146 * 1852.0 / 3600.0;
  CHECK(rmc(fix, {"GN", 5}) ==
        "$GNRMC,001031.00,A,4404.13993,N,12118.86023,W,0.146,,100117,,,A*7B\r\n");
}

TEST_CASE("nmea sentence: no sixty minutes, no 360 degrees, and never more than 82 bytes",
          "[hal_sim][emulators]") {
  NmeaFix fix = example();
  fix.latitude_deg = -34.99999999999;
  fix.longitude_deg = -179.99999999999;
  fix.course_deg = 359.98;
  fix.satellites = 12;
  fix.hdop = 50.0;
  fix.altitude_m = -100.5;
  fix.geoid_m = -100.5;
  const std::string said = rmc(fix, {"GN", 5});
  CHECK(said.find(",3500.00000,S,18000.00000,W,0.972,000.0,") != std::string::npos);
  for (const std::string& sentence :
       {said, gga(fix, {"GN", 5}), vtg(fix, {"GN", 5}), hdt(fix, {"GN", 5})}) {
    CHECK(sentence.size() <= 82);
    CHECK(sentence[sum_at(sentence)] == '*');
  }
}

TEST_CASE("utc: dates over leap days, and what a week's rollover takes away",
          "[hal_sim][emulators]") {
  const CivilTime begin = civil_time(kVirtualEpoch + std::chrono::milliseconds{1234});
  CHECK(begin.year == 2026);
  CHECK(begin.month == 11);
  CHECK(begin.day == 21);
  CHECK(begin.hour == 12);
  CHECK(begin.minute == 35);
  CHECK(begin.second == 1);
  CHECK(begin.millisecond == 234);
  const CivilTime leap = civil_time(std::chrono::seconds{1'709'164'800 + 86'399});
  CHECK(leap.month == 2);
  CHECK(leap.day == 29);
  CHECK(leap.second == 59);
  const CivilTime earlier = civil_time(kVirtualEpoch - kWeekRollover);
  CHECK(earlier.year == 2007);
  CHECK(earlier.month == 4);
  CHECK(earlier.day == 7);
}

}  // namespace
}  // namespace lodesman
