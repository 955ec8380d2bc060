// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/decode/roboclaw_lines.h"

#include <vector>

#include "tests/support/catch.h"

namespace lodesman {
namespace {

struct Decoded {
  std::vector<nlohmann::ordered_json> lines;
  DecodeCounts counts;
};

[[nodiscard]] Decoded decoded(const std::vector<std::uint8_t>& bytes) {
  Decoded all;
  all.counts =
      roboclaw_lines(bytes, [&](const nlohmann::ordered_json& json) { all.lines.push_back(json); });
  return all;
}

TEST_CASE("roboclaw lines: what is said, with its check", "[roboclaw]") {
  const Decoded all =
      decoded({0x80, 0x22, 0x40, 0x00, 0xC0, 0x00, 0xE0, 0xDF, 0xFF, 0x80, 0x00, 0x40, 0x73,
               0x9E, 0x80, 0x06, 0x40, 0xD9, 0x38, 0x80, 0x18, 0x80, 0x0E, 0x0A, 0xB9, 0x1F});
  REQUIRE(all.counts.packets == 6);
  CHECK(all.counts.refused == 0);
  CHECK(all.counts.skipped_bytes == 0);
  CHECK(all.lines[0]["type"] == "duty_both");
  CHECK(all.lines[0]["address"] == 128);
  CHECK(all.lines[0]["command"] == 34);
  CHECK(all.lines[0]["duty_1"].get<double>() == Approx(0.5).margin(1e-4));
  CHECK(all.lines[0]["duty_2"].get<double>() == Approx(-0.5).margin(1e-4));
  CHECK(all.lines[1]["type"] == "acknowledge");
  CHECK(all.lines[2]["duty"].get<double>() == Approx(64.0 / 127.0));
  CHECK(all.lines[3]["duty"].get<double>() == Approx(0.0).margin(1e-12));
  CHECK(all.lines[4].dump() ==
        R"({"type":"read_main_battery","known":true,"address":128,"command":24})");
  CHECK(all.lines[5]["time_out_s"].get<double>() == Approx(1.0));
}

TEST_CASE("roboclaw lines: what is damaged or unknown is refused, and nothing behind it",
          "[roboclaw]") {
  const Decoded all = decoded(
      {0x80, 0x22, 0x40, 0x00, 0xC0, 0x01, 0xE0, 0xDF, 0x80, 0x18, 0x81, 0x7F, 0x80, 0x5A, 0x80});
  REQUIRE(all.counts.packets == 2);
  CHECK(all.lines[0]["type"] == "read_main_battery");
  CHECK(all.lines[1]["type"] == "read_status");
  CHECK(all.counts.refused == 3);
  CHECK(all.counts.skipped_bytes == 11);
}

}  // namespace
}  // namespace lodesman
