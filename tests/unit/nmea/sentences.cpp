// SPDX-License-Identifier: Apache-2.0
#include "drivers/nmea/sentences.h"

#include <string>

#include "tests/support/catch.h"

namespace lodesman::testing {
namespace {

using namespace nmea;

constexpr double kDegree_rad = 0.017453292519943295;
constexpr std::int64_t kSecond_ns = 1'000'000'000;

template <class Kind>
[[nodiscard]] Kind as(std::string_view sentence) {
  const Sentence said = decoded(sentence);
  INFO(std::string{sentence});
  REQUIRE(std::holds_alternative<Kind>(said));
  return std::get<Kind>(said);
}

[[nodiscard]] bool is_malformed(std::string_view sentence) {
  return std::holds_alternative<Malformed>(decoded(sentence));
}

TEST_CASE("nmea sentences: RMC, vectors D-1, D-6 and D-7", "[nmea]") {
  const Rmc d1 =
      as<Rmc>("$GPRMC,123500.00,A,3501.6320,N,13854.0000,E,0.972,054.7,211126,007.6,W,A");
  CHECK(d1.time_of_day == Duration{45300 * kSecond_ns});
  CHECK(d1.valid);
  REQUIRE(d1.place);
  CHECK(d1.place->latitude_deg == Approx(35.0272).margin(1e-9));
  CHECK(d1.place->longitude_deg == Approx(138.9).margin(1e-9));
  CHECK(d1.speed_m_s.value() == Approx(0.500).margin(1e-3));
  CHECK(d1.course_rad.value() == Approx(54.7 * kDegree_rad));
  CHECK(d1.date_ns == 1795219200 * kSecond_ns);  // 2026-11-21
  CHECK(d1.variation_rad.value() == Approx(-7.6 * kDegree_rad));
  CHECK(d1.mode == 'A');
  const Rmc d6 = as<Rmc>("$GNRMC,001031.00,A,4404.13993,N,12118.86023,W,0.146,,100117,,,A");
  CHECK(d6.time_of_day == Duration{631 * kSecond_ns});
  CHECK(d6.place.value().latitude_deg == Approx(44.068998833).margin(1e-9));
  CHECK(d6.place.value().longitude_deg == Approx(-121.314337167).margin(1e-9));
  CHECK(d6.speed_m_s.value() == Approx(0.0751).margin(1e-4));
  CHECK(!d6.course_rad);
  CHECK(!d6.variation_rad);
  CHECK(d6.date_ns == 1484006400 * kSecond_ns);  // 2017-01-10
  const Rmc d7 = as<Rmc>("$GPRMC,123501.00,V,,,,,,,211126,,,N");
  CHECK(!d7.valid);
  CHECK(!d7.place);
  CHECK(d7.mode == 'N');
}

TEST_CASE("nmea sentences: GGA, vectors D-2 and D-8", "[nmea]") {
  const Gga d2 = as<Gga>("$GPGGA,123500.00,3501.6320,N,13854.0000,E,1,08,0.9,12.4,M,39.7,M,,");
  CHECK(d2.time_of_day == Duration{45300 * kSecond_ns});
  CHECK(d2.place.value().latitude_deg == Approx(35.0272).margin(1e-9));
  CHECK(d2.quality == 1);
  CHECK(d2.satellites == 8);
  CHECK(d2.hdop.value() == Approx(0.9));
  CHECK(d2.altitude_m.value() == Approx(12.4));
  CHECK(d2.altitude_m.value() + d2.geoid_m.value() == Approx(52.1));
  const Gga d8 = as<Gga>("$GPGGA,123501.00,,,,,0,00,,,M,,M,,");
  CHECK(d8.quality == 0);
  CHECK(!d8.place);
  CHECK(!d8.hdop);
}

TEST_CASE("nmea sentences: VTG, HDT and HDG, vectors D-3 to D-5", "[nmea]") {
  const Vtg d3 = as<Vtg>("$GPVTG,054.7,T,062.3,M,0.972,N,1.800,K,A");
  CHECK(d3.course_rad.value() == Approx(54.7 * kDegree_rad));
  CHECK(d3.course_magnetic_rad.value() == Approx(62.3 * kDegree_rad));
  CHECK(d3.speed_m_s.value() == Approx(0.972 * 1852.0 / 3600.0));
  CHECK(as<Vtg>("$GPVTG,,T,,M,,N,3.6,K").speed_m_s.value() == Approx(1.0));
  CHECK(as<Hdt>("$GPHDT,056.20,T").heading_rad.value() == Approx(56.2 * kDegree_rad));
  CHECK(as<Hdt>("$GPHDT,274.07,T").heading_rad.value() == Approx((274.07 - 360.0) * kDegree_rad));
  CHECK(!as<Hdt>("$GPHDT,,T").heading_rad);
  const Hdg hdg = as<Hdg>("$24HDG,182.1,01.0,W,04.5,E");
  CHECK(hdg.heading_magnetic_rad.value() == Approx((182.1 - 360.0) * kDegree_rad));
  CHECK(hdg.deviation_rad.value() == Approx(-1.0 * kDegree_rad));
  CHECK(hdg.variation_rad.value() == Approx(4.5 * kDegree_rad));
}

TEST_CASE("nmea sentences: the talker plays no part, and makers' own are none of ours", "[nmea]") {
  for (const char* talker : {"GP", "GN", "GL", "GA", "IN", "HE", "02"}) {
    const std::string sentence = "$" + std::string{talker} + "HDT,056.20,T";
    static_cast<void>(as<Hdt>(sentence));
    CHECK(type_of(sentence) == "HDT");
    CHECK(talker_of(sentence) == talker);
  }
  for (const char* other : {"$PGRMC,A,1", "$PTNTHTM,14223,N,169", "!AIVDM,1,1,,B,x,0", "$", "",
                            "$GPGSV,3,1,12", "$HDT,056.20,T", "$GPHDTT,056.20,T"}) {
    INFO(other);
    static_cast<void>(as<Unknown>(other));
  }
  CHECK(type_of("$PGRMC,A,1") == "PGRMC");
}

TEST_CASE("nmea sentences: the southern and western halves of the earth are negative", "[nmea]") {
  const auto place = [](const char* where) {
    return as<Gga>("$GPGGA,000000," + std::string{where} + ",1,08,0.9,,,,,,").place.value();
  };
  CHECK(place("3351.0000,S,15112.0000,E").latitude_deg == Approx(-33.85));
  CHECK(place("3351.0000,S,15112.0000,E").longitude_deg == Approx(151.2));
  CHECK(place("5454.0000,S,06818.0000,W").longitude_deg == Approx(-68.3));
  CHECK(place("8000.0000,N,18000.0000,W").longitude_deg == Approx(-180.0));
  CHECK(place("9000.0000,N,00000.0000,E").latitude_deg == Approx(90.0));
}

TEST_CASE("nmea sentences: what cannot be makes a sentence malformed", "[nmea]") {
  CHECK(is_malformed("$GPRMC,246000.00,A,,,,,,,211126,,,A"));
  CHECK(is_malformed("$GPRMC,12350,A,,,,,,,211126,,,A"));
  CHECK(is_malformed("$GPRMC,123500.0x,A,,,,,,,211126,,,A"));
  CHECK(is_malformed("$GPRMC,123500,B,,,,,,,211126,,,A"));
  CHECK(is_malformed("$GPRMC,123500,A,3560.0000,N,13854.0000,E,,,211126,,,A"));
  CHECK(is_malformed("$GPRMC,123500,A,9000.0001,N,13854.0000,E,,,211126,,,A"));
  CHECK(is_malformed("$GPRMC,123500,A,3501.0000,N,18000.0001,E,,,211126,,,A"));
  CHECK(is_malformed("$GPRMC,123500,A,501.0000,N,13854.0000,E,,,211126,,,A"));
  CHECK(is_malformed("$GPRMC,123500,A,3501.0000,E,13854.0000,N,,,211126,,,A"));
  CHECK(is_malformed("$GPRMC,123500,A,,,,,-1.0,,211126,,,A"));
  CHECK(is_malformed("$GPRMC,123500,A,,,,,nan,,211126,,,A"));
  CHECK(is_malformed("$GPRMC,123500,A,,,,,1e3,,211126,,,A"));
  CHECK(is_malformed("$GPRMC,123500,A,,,,,,360.1,211126,,,A"));
  CHECK(is_malformed("$GPRMC,123500,A,,,,,,,310226,,,A"));
  CHECK(is_malformed("$GPGGA,123500,3501.0000,N,13854.0000,E,9,08,0.9,,M,,M,,"));
  CHECK(is_malformed("$GPGGA,123500,3501.0000,N,13854.0000,E,1,08,-0.9,,M,,M,,"));
  CHECK(is_malformed("$GPHDT,inf,T"));
  // A part of a place is none.
  CHECK(!as<Rmc>("$GPRMC,123500,A,3501.0000,N,,,,,211126,,,A").place);
  CHECK(!as<Rmc>("$GPRMC,123500,A,3501.0000,,13854.0000,E,,,211126,,,A").place);
}

TEST_CASE("nmea sentences: one cut off anywhere says no more than it has", "[nmea]") {
  const std::string whole =
      "$GPRMC,123500.00,A,3501.6320,N,13854.0000,E,0.972,054.7,211126,007.6,W,A";
  for (std::size_t size = 0; size <= whole.size(); ++size) {
    const Sentence said = decoded(whole.substr(0, size));
    if (const auto* rmc = std::get_if<Rmc>(&said); rmc != nullptr && rmc->place) {
      CHECK(size >= whole.find(",E,") + 2);
    }
  }
}

}  // namespace
}  // namespace lodesman::testing
