// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/decode/delta_t_lines.h"

#include "drivers/delta_t/control.h"
#include "tests/support/catch.h"
#include "tests/support/delta_t_records.h"
#include "tests/unit/delta_t/vectors.h"

namespace lodesman {
namespace {

using Json = nlohmann::ordered_json;
using testing::ByteList;

[[nodiscard]] std::vector<Json> lines_of(const ByteList& bytes, DecodeCounts& counts) {
  std::vector<Json> lines;
  counts = delta_t_lines(bytes, [&](const Json& line) { lines.push_back(line); });
  return lines;
}

TEST_CASE("delta t lines: a profile's values are in the units of their names", "[drivers]") {
  DecodeCounts counts;
  const std::vector<Json> lines = lines_of(testing::profile_vector(), counts);
  REQUIRE(lines.size() == 1);
  const Json& line = lines.front();
  CHECK(line.begin().key() == "type");
  CHECK(line.at("type") == "83P");
  CHECK(line.at("known") == true);
  CHECK(line.at("date") == "21-NOV-2026");
  CHECK(line.at("time") == "12:35:00.253");
  CHECK(line.at("latitude_deg").get<double>() == Approx(35.0272));
  CHECK(line.at("ping") == 1234);
  CHECK(line.at("range_m") == 10.0);
  CHECK(line.at("heading_rad").get<double>() == Approx(to_rad(56.2)));
  CHECK(line.at("data_latency_s").get<double>() == Approx(0.012));
  CHECK(line.at("ranges_m").size() == 120);
  CHECK(line.at("ranges_m")[2].get<double>() == Approx(5.04));
  CHECK(line.at("intensities")[118] == 118);
  CHECK(counts.packets == 1);
  CHECK(counts.skipped_bytes == 0);
}

TEST_CASE("delta t lines: the real header is one line, and what it leaves open is null",
          "[drivers]") {
  DecodeCounts counts;
  const Json line = lines_of(testing::real_vector(), counts).at(0);
  CHECK(line.at("pitch_rad").is_null());
  CHECK(line.at("heading_rad").is_null());
  CHECK(line.at("latitude_deg").is_null());
  CHECK(line.at("pings_averaged") == 5);
  CHECK_FALSE(line.contains("intensities"));
}

TEST_CASE("delta t lines: all that a file may hold is told apart, and the rest counted",
          "[drivers]") {
  ByteList all = testing::usual_image(testing::usual_header(delta_t::RecordKind::kImage, 5));
  const ByteList image = all;
  all.insert(all.end(), {'x', '8', '3', 'B', 0});
  const auto frame = delta_t::control_frame({});
  all.insert(all.end(), frame.begin(), frame.end());
  all.insert(all.end(), image.begin(), image.end() - 1);  // cut off
  DecodeCounts counts;
  const std::vector<Json> lines = lines_of(all, counts);
  REQUIRE(lines.size() == 2);
  CHECK(lines[0].at("type") == "83B");
  CHECK(lines[0].at("greatest_echo") == 200);
  CHECK(lines[1].at("type") == "control");
  CHECK(lines[1].at("range_m") == 30);
  CHECK(counts.packets == 2);
  CHECK(counts.refused == 2);
  CHECK(counts.skipped_bytes == 5 + image.size() - 1);
}

TEST_CASE("delta t lines: a text of any bytes is printed as it can be", "[drivers]") {
  ByteList bytes = testing::profile_vector();
  for (std::size_t at = 8; at < 61; ++at) {
    bytes[at] = static_cast<std::uint8_t>(0xF0 + at % 16);
  }
  DecodeCounts counts;
  const Json line = lines_of(bytes, counts).at(0);
  CHECK(line.at("date") == "????????????");
  CHECK(line.at("latitude_deg").is_null());
  CHECK_NOTHROW(line.dump());
}

}  // namespace
}  // namespace lodesman
