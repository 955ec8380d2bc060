// SPDX-License-Identifier: Apache-2.0
#include "drivers/gpsd/reports.h"

#include <string>

#include "tests/support/catch.h"

namespace lodesman::gpsd {
namespace {

template <class Kind>
[[nodiscard]] Kind as(std::string_view line) {
  const Report report = decoded(line);
  INFO(std::string{line});
  REQUIRE(std::holds_alternative<Kind>(report));
  return std::get<Kind>(report);
}

TEST_CASE("gpsd reports: TPV", "[gpsd]") {
  const Tpv tpv =
      as<Tpv>(R"({"class":"TPV","device":"/dev/pts/3","status":2,"mode":3,)"
              R"("time":"2026-11-21T12:35:00.250Z",)"
              R"("lat":35.0272,"lon":138.9,"altHAE":52.1,"track":270.0,"speed":0.5,"eph":17.1})");
  CHECK(tpv.device == "/dev/pts/3");
  CHECK(tpv.mode == 3);
  CHECK(tpv.status == 2);
  CHECK(tpv.utc_ns == 1795264500'250'000'000);
  CHECK(tpv.latitude_deg.value() == Approx(35.0272));
  CHECK(tpv.longitude_deg.value() == Approx(138.9));
  CHECK(tpv.course_rad.value() == Approx(-1.5707963));
  CHECK(tpv.speed_m_s.value() == Approx(0.5));
  CHECK(tpv.eph_m.value() == Approx(17.1));
  const Tpv none = as<Tpv>(R"({"class":"TPV","mode":1})");
  CHECK(none.mode == 1);
  CHECK(!none.utc_ns);
  CHECK(!none.latitude_deg);
}

TEST_CASE("gpsd reports: the others", "[gpsd]") {
  CHECK(as<Sky>(R"({"class":"SKY","hdop":0.9,"uSat":8,"satellites":[{"PRN":1}]})").hdop.value() ==
        Approx(0.9));
  CHECK(as<Att>(R"({"class":"ATT","heading":56.2})").heading_rad.value() == Approx(0.980875));
  CHECK(!as<Devices>(R"({"class":"DEVICES","devices":[]})").any);
  CHECK(as<Devices>(R"({"class":"DEVICES","devices":[{"class":"DEVICE","path":"/dev/x"}]})").any);
  CHECK(!as<Device>(R"({"class":"DEVICE","path":"/dev/x","activated":0})").active);
  CHECK(as<Device>(R"({"class":"DEVICE","path":"/dev/x","activated":"2026-11-21T12:35:00Z"})")
            .active);
  const Version version =
      as<Version>(R"({"class":"VERSION","release":"3.22","proto_major":3,"proto_minor":14})");
  CHECK(version.release == "3.22");
  CHECK(version.protocol_major == 3);
  CHECK(version.protocol_minor == 14);
  static_cast<void>(as<Other>(R"({"class":"WATCH","enable":true})"));
  static_cast<void>(as<Broken>(R"({"mode":3})"));
  static_cast<void>(as<Broken>(R"({"class":"TPV","mode":3)"));
}

TEST_CASE("gpsd reports: what cannot be is as if it had not been given", "[gpsd]") {
  const Tpv tpv = as<Tpv>(R"({"class":"TPV","mode":7,"time":"yesterday",)"
                          R"("lat":91,"lon":-180.1,"speed":-1,"track":400})");
  CHECK(tpv.mode == 0);
  CHECK(!tpv.utc_ns);
  CHECK(!tpv.latitude_deg);
  CHECK(!tpv.longitude_deg);
  CHECK(!tpv.speed_m_s);
  CHECK(!tpv.course_rad);
  CHECK(as<Tpv>(R"({"class":"TPV","mode":"3"})").mode == 0);
}

TEST_CASE("gpsd reports: time is of one form", "[gpsd]") {
  CHECK(utc_of("1970-01-01T00:00:00Z") == 0);
  CHECK(utc_of("2024-02-29T23:59:59.999999999Z") == 1709251199'999'999'999);
  CHECK(utc_of("2024-02-29T23:59:60.0Z") == 1709251200'000'000'000);
  for (const char* text :
       {"", "2024-02-30T00:00:00Z", "2023-02-29T00:00:00Z", "2024-13-01T00:00:00Z",
        "2024-01-01T24:00:00Z", "2024-01-01T00:60:00Z", "2024-01-01T00:00:00",
        "2024-01-01 00:00:00Z", "2024-01-01T00:00:00.Z", "2024-01-01T00:00:00.xZ",
        "1969-12-31T23:59:59Z", "x024-01-01T00:00:00Z", "2300-01-01T00:00:00Z"}) {
    INFO(text);
    CHECK(!utc_of(text));
  }
}

}  // namespace
}  // namespace lodesman::gpsd
