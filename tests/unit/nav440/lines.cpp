// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <fstream>
#include <iterator>

#include "deploy/operator/decode/nav440_lines.h"
#include "tests/support/catch.h"
#include "tests/support/data_dir.h"
#include "tests/unit/nav440/support.h"

namespace lodesman::testing {
namespace {

using Json = nlohmann::ordered_json;

struct Decoded {
  std::vector<Json> lines;
  DecodeCounts counts;
};

[[nodiscard]] Decoded decoded_lines(const ByteList& bytes) {
  Decoded decoded;
  decoded.counts = nav440_lines(bytes, [&](const Json& line) { decoded.lines.push_back(line); });
  return decoded;
}

[[nodiscard]] Json line_of(std::string_view number) {
  const Decoded decoded = decoded_lines(vector_bytes(number));
  REQUIRE(decoded.lines.size() == 1);
  return decoded.lines.front();
}

[[nodiscard]] bool near(const Json& value, double expected) {
  return std::abs(value.get<double>() - expected) < 1e-5;
}

TEST_CASE("nav440 lines: each vector is one line that begins with type and known", "[nav440]") {
  ByteList all;
  for (const Vector& vector : kVectors) {
    INFO(vector.number);
    append(all, bytes_of(vector.hex));
    const Json line = line_of(vector.number);
    CHECK(line.begin().key() == "type");
    CHECK(line.at("known") == true);
    const Kept frame = kept_of(bytes_of(vector.hex));
    const std::string letters{static_cast<char>(frame.type >> 8U),
                              static_cast<char>(frame.type & 0xFFU)};
    CHECK(line.at("type") == (frame.type == 0x1515 ? "0x1515" : letters));
  }
  const Decoded decoded = decoded_lines(all);
  CHECK(decoded.lines.size() == kVectors.size());
  CHECK(decoded.counts.packets == kVectors.size());
  CHECK(decoded.counts.skipped_bytes == 0);
  CHECK(decoded.counts.refused == 0);
}

TEST_CASE("nav440 lines: values are in the units of their names", "[nav440]") {
  const Json a1 = line_of("A-21");
  CHECK(near(a1.at("roll_rad"), 0.026173));
  CHECK(near(a1.at("yaw_magnetic_rad"), -1.570796));
  CHECK(near(a1.at("rate_rad_s").at(2), 0.174490));
  CHECK(near(a1.at("acceleration_m_s2").at(2), -9.807249));
  CHECK(near(a1.at("field_tesla").at(0), 0.25e-4));
  CHECK(a1.at("time_ms") == 123456789);
  const Json n1 = line_of("A-28");
  CHECK(near(n1.at("yaw_true_rad"), 0.052347));
  CHECK(near(n1.at("longitude_deg"), 127.207868));
  CHECK(near(n1.at("altitude_m"), 100.0));
  CHECK(line_of("A-20").at("model") == "NAV440 2.0.1 8350-2000");
  CHECK(line_of("A-18").at("version") == "20.2.1");
  CHECK(line_of("A-15").at("refused") == "SF");
  CHECK(line_of("A-13").at("fields").at(2).at("value") == 0x4131);
  CHECK(line_of("A-32").at("com_serial_b_bit") == 2);
  CHECK(line_of("A-2").at("payload") == "414243");
}

TEST_CASE("nav440 lines: a type that is not known is said to be so, with its bytes", "[nav440]") {
  const Decoded decoded = decoded_lines(frame_of("z1", {0xAB, 0x01}));
  REQUIRE(decoded.lines.size() == 1);
  CHECK(decoded.lines.front().dump() == R"({"type":"z1","known":false,"payload":"AB01"})");
}

TEST_CASE("nav440 lines: what is skipped and refused is counted", "[nav440]") {
  ByteList bytes{0x00, 0x55};
  append(bytes, vector_bytes("A-21"));
  ByteList wrong = vector_bytes("A-22");
  wrong[20] ^= 1U;
  append(bytes, wrong);
  append(bytes, frame_of("A1", ByteList(31, 0)));
  append(bytes, {0x55, 0x55, 0x41});
  const Decoded decoded = decoded_lines(bytes);
  CHECK(decoded.counts.packets == 1);
  CHECK(decoded.counts.refused == 2);
  CHECK(decoded.counts.skipped_bytes == bytes.size() - 39);
}

TEST_CASE("nav440 lines: recordings", "[nav440]") {
  const auto lines_of = [](const std::filesystem::path& file) {
    std::ifstream stream{file, std::ios::binary};
    return decoded_lines({std::istreambuf_iterator<char>{stream}, {}});
  };
  const auto scaled = data_path("imu_0x5555/Scale1.raw");
  const auto foreign = data_path("imu_0x5555/s1.raw");
  if (!scaled || !foreign) {
    return;
  }
  const Decoded known = lines_of(*scaled);
  CHECK(known.counts.packets == 1002);
  CHECK(known.counts.skipped_bytes == 0);
  CHECK(std::all_of(known.lines.begin(), known.lines.end(), [](const Json& line) {
    return line.at("type") == "S1" && line.at("known") == true && line.contains("counter");
  }));
  const Decoded other = lines_of(*foreign);
  CHECK(other.counts.packets == 1694);
  CHECK(other.counts.skipped_bytes == 47 + 7);
  CHECK(std::all_of(other.lines.begin(), other.lines.end(), [](const Json& line) {
    return line.at("type") == "s1" && line.at("known") == false;
  }));
}

}  // namespace
}  // namespace lodesman::testing
