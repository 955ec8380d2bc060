// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/decode/maestro_lines.h"

#include <vector>

#include "tests/support/catch.h"

namespace lodesman {
namespace {

struct Decoded {
  std::vector<std::string> lines;
  DecodeCounts counts;
};

[[nodiscard]] Decoded decoded(const std::vector<std::uint8_t>& bytes) {
  Decoded all;
  all.counts = maestro_lines(
      bytes, [&](const nlohmann::ordered_json& json) { all.lines.push_back(json.dump()); });
  return all;
}

TEST_CASE("maestro lines: each form of a target", "[maestro]") {
  const Decoded all =
      decoded({0x84, 0x00, 0x70, 0x2E, 0xAA, 0x0C, 0x04, 0x00, 0x70, 0x2E, 0xFF, 0x00,
               0x7F, 0x84, 0x01, 0x2A, 0x24, 0x9F, 0x02, 0x03, 0x70, 0x2E, 0x14, 0x32});
  CHECK(all.lines ==
        std::vector<std::string>{
            R"({"type":"set_target","known":true,"form":"compact","channel":0,"pulse_us":1500.0})",
            R"({"type":"set_target","known":true,"form":"pololu","device":12,"channel":0,)"
            R"("pulse_us":1500.0})",
            R"({"type":"mini_ssc","known":true,"channel":0,"target":127})",
            R"({"type":"set_target","known":true,"form":"compact","channel":1,"pulse_us":1162.5})",
            R"({"type":"set_targets","known":true,"form":"compact","channel":3,)"
            R"("pulses_us":[1500.0,1605.0]})"});
  CHECK(all.counts.packets == 5);
  CHECK(all.counts.skipped_bytes == 0);
  CHECK(all.counts.refused == 0);
}

TEST_CASE("maestro lines: checks are found, and from then on demanded", "[maestro]") {
  const Decoded right = decoded(
      {0x84, 0x00, 0x70, 0x2E, 0x2B, 0x90, 0x00, 0x65, 0xA1, 0x1B, 0xAA, 0x01, 0x10, 0x00, 0x6B});
  CHECK(right.counts.packets == 4);
  CHECK(right.counts.skipped_bytes == 0);
  CHECK(right.lines[2] == R"({"type":"get_errors","known":true,"form":"compact","crc":27})");
  const Decoded wrong = decoded({0xA1, 0x1B, 0x90, 0x00, 0x64, 0x84, 0x00, 0x70, 0x2E, 0xA2});
  CHECK(wrong.counts.packets == 1);
  CHECK(wrong.counts.refused == 3);
  CHECK(wrong.counts.skipped_bytes == 8);
}

TEST_CASE("maestro lines: what is torn, unknown or too much", "[maestro]") {
  const Decoded all = decoded(
      {0x12, 0x84, 0x00, 0x70, 0x90, 0x01, 0xB5, 0x01, 0x02, 0xAA, 0xA2, 0xAA, 0x0C, 0xFF, 0x01});
  CHECK(all.lines ==
        std::vector<std::string>{
            R"({"type":"get_position","known":true,"form":"compact","channel":1})",
            R"({"type":"command","known":false,"form":"compact","command":181,"data":[1,2]})",
            R"({"type":"detect_baud","known":true})",
            R"({"type":"go_home","known":true,"form":"compact"})"});
  CHECK(all.counts.packets == 4);
  CHECK(all.counts.refused == 3);
  CHECK(all.counts.skipped_bytes == 8);
  CHECK(decoded({}).counts.packets == 0);
}

}  // namespace
}  // namespace lodesman
