// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/decode/nmea_lines.h"

#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "tests/support/catch.h"
#include "tests/support/data_dir.h"

namespace lodesman::testing {
namespace {

using Json = nlohmann::ordered_json;

struct Decoded {
  std::vector<Json> lines;
  std::map<std::string, std::size_t> known;  // by type
  DecodeCounts counts;
};

[[nodiscard]] Decoded decoded_lines(const std::string& text) {
  Decoded decoded;
  const std::vector<std::uint8_t> bytes{text.begin(), text.end()};
  decoded.counts = nmea_lines(bytes, [&](const Json& line) {
    decoded.lines.push_back(line);
    if (line.at("known") == true) {
      ++decoded.known[line.at("type").get<std::string>()];
    }
  });
  return decoded;
}

TEST_CASE("nmea lines: a line begins with type and known, and leaves out what is empty", "[nmea]") {
  const Decoded decoded = decoded_lines(
      "$GPRMC,123500.00,A,3501.6320,N,13854.0000,E,0.972,054.7,211126,007.6,W,A*25\r\n"
      "$GPRMC,123501.00,V,,,,,,,211126,,,N*7E\r\n"
      "$GPGGA,123500.00,3501.6320,N,13854.0000,E,1,08,0.9,12.4,M,39.7,M,,*59\r\n"
      "$GPHDT,056.20,T*04\r\n");
  REQUIRE(decoded.lines.size() == 4);
  const Json& rmc = decoded.lines[0];
  CHECK(rmc.begin().key() == "type");
  CHECK(rmc.at("type") == "RMC");
  CHECK(rmc.at("known") == true);
  CHECK(rmc.at("talker") == "GP");
  CHECK(rmc.at("time_of_day_s") == 45300.0);
  CHECK(rmc.at("valid") == true);
  CHECK(rmc.at("latitude_deg").get<double>() == Approx(35.0272).margin(1e-9));
  CHECK(rmc.at("date_s") == 1795219200);
  CHECK(rmc.at("variation_rad").get<double>() == Approx(-0.132645));
  CHECK(decoded.lines[1].at("valid") == false);
  CHECK(!decoded.lines[1].contains("latitude_deg"));
  CHECK(decoded.lines[2].at("hdop") == 0.9);
  CHECK(decoded.lines[2].at("altitude_m") == 12.4);
  CHECK(decoded.lines[3].at("heading_rad").get<double>() == Approx(0.980875));
}

TEST_CASE("nmea lines: what is not decoded has its text, and what is refused is counted",
          "[nmea]") {
  const Decoded decoded = decoded_lines(
      "xx$PTNTHTM,14223,N,169,N,-43,N,13641,2454*15\r\n"
      "$GPHDT,056.20,T*05\r\n$GPHDT,056.20,T\r\n$GPGG");
  REQUIRE(decoded.lines.size() == 1);
  CHECK(decoded.lines[0].dump() ==
        R"({"type":"PTNTHTM","known":false,"text":"$PTNTHTM,14223,N,169,N,-43,N,13641,2454"})");
  CHECK(decoded.counts.packets == 1);
  CHECK(decoded.counts.refused == 2);
  CHECK(decoded.counts.skipped_bytes == 2 + 18 + 15 + 5);
}

// How many sentences of recorded files have a checksum that holds, and how many of these are of a
// type that is decoded: counted by a program of its own.
struct Recording {
  const char* file;
  std::uint64_t sentences;
  std::map<std::string, std::size_t> known;
};

TEST_CASE("nmea lines: recordings of many receivers", "[nmea]") {
  const Recording recordings[] = {
      {"nmea_mixed/gpsd/GPSmap-76S.log", 151, {{"RMC", 12}, {"GGA", 12}, {"VTG", 11}}},
      {"nmea_mixed/gpsd/bu303-moving.log", 0, {}},
      {"nmea_mixed/gpsd/et-332.log", 106, {{"GGA", 19}, {"RMC", 19}, {"VTG", 19}}},
      {"nmea_mixed/gpsd/humminbird-M37.log", 98, {{"RMC", 17}, {"VTG", 8}, {"GGA", 8}}},
      {"nmea_mixed/gpsd/magellan315.log", 21, {{"GGA", 3}, {"RMC", 3}}},
      {"nmea_mixed/gpsd/nmea-fuzzy-cases.log", 28, {{"GGA", 14}, {"RMC", 14}}},
      {"nmea_mixed/gpsd/sounder.log", 244, {}},
      // In its GGA four characters were put in whose sum is nothing: the checksum holds.
      {"nmea_mixed/gpsd/tcp-torture.log", 7, {{"RMC", 1}}},
      {"nmea_mixed/gpsd/tnt-revolution.log", 60, {}},
      {"nmea_mixed/opencpn/Go_to_Guernesey_slice.txt", 5848, {{"RMC", 1937}}},
      {"nmea_mixed/signalk/gps.log", 5747, {{"GGA", 1201}, {"RMC", 1201}, {"VTG", 1201}}},
      {"nmea_mixed/signalk/n2kd-183-merrimac.log", 541, {{"HDG", 123}}},
      {"nmea_usv_rtk/202412051751.txt",
       11588,
       {{"VTG", 2897}, {"HDT", 2897}, {"GGA", 2897}, {"RMC", 2897}}},
      {"nmea_usv_rtk/202412071309.txt",
       5072,
       {{"VTG", 1268}, {"HDT", 1268}, {"GGA", 1268}, {"RMC", 1268}}},
      {"asv_catabot/lake_china_20201006_slice.csv", 0, {}},
  };
  for (const Recording& recording : recordings) {
    const auto path = data_path(recording.file);
    if (!path) {
      return;
    }
    std::ifstream stream{*path, std::ios::binary};
    const Decoded decoded = decoded_lines({std::istreambuf_iterator<char>{stream}, {}});
    INFO(recording.file);
    CHECK(decoded.counts.packets == recording.sentences);
    CHECK(decoded.known == recording.known);
  }
}

}  // namespace
}  // namespace lodesman::testing
