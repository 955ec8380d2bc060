// SPDX-License-Identifier: Apache-2.0
#include "drivers/delta_t/head.h"

#include "drivers/delta_t/raw_file.h"
#include "drivers/delta_t/scan.h"
#include "mid_level/base/heading.h"
#include "tests/support/catch.h"
#include "tests/support/delta_t_records.h"
#include "tests/unit/delta_t/vectors.h"

namespace lodesman::delta_t {
namespace {

using testing::ByteList;
using testing::hex;

// 10 m; 30 m and the last packet; 30 m tilted, of 16000 points.
constexpr std::string_view kSwitch10 =
    "FE 44 10 0A 00 00 00 00 05 01 0A 78 00 00 06 00 00 00 00 08 08 80 00 00 00 56 FD ";
constexpr std::string_view kSwitch30 =
    "FE 44 10 1E 00 00 00 00 0A 01 0A 78 00 07 12 00 00 00 00 08 08 80 00 00 00 56 FD ";
constexpr std::string_view kSwitchTilted =
    "FE 44 10 1E 00 F5 55 00 08 01 0A 78 00 00 12 00 00 00 00 10 08 80 10 00 00 56 FD ";

[[nodiscard]] ByteList reply() {
  ByteList bytes = hex(
      "49 55 58 10 40 00 01 0A 00 00 03 E8 01 05 11 01 94 FE F7 27 12 34 00 00 05 00 FA 00 C8 00 "
      "00 00 ",
      1033);
  bytes[32] = 9;
  bytes[1032] = 0xFC;
  return bytes;
}

// A .837 record of 8000 points.
[[nodiscard]] ByteList raw_record() {
  ByteList bytes =
      hex("38 33 37 0A 20 00 1F 4D 32 31 2D 4E 4F 56 2D 32 "
          "30 32 36 00 31 32 3A 33 35 3A 30 30 00 2E 32 35 "
          "00 00 00 00 00 83 05 00 00 00 00 00 06 00 BA 98 "
          "20 33 35 2E 30 31 2E 36 33 32 30 30 20 4E 31 33 "
          "38 2E 35 34 2E 30 30 30 30 30 20 45 0A 02 23 00 "
          "01 04 83 93 83 70 82 32 00 64 32 00 00 2E 32 35 "
          "33 00 00 00 49 55 58 10 40 07 01 0A 00 00 03 E8 ",
          8192);
  bytes[112] = 200;
  bytes[8112] = 0xFC;
  return bytes;
}

TEST_CASE("delta t head: switch commands say what their bytes mean", "[drivers]") {
  const SwitchCommand first = switch_command_in(hex(kSwitch10)).value();
  CHECK(first.range_m == Approx(10).margin(1e-12));
  CHECK(first.gain_db == 5);
  CHECK(first.log_f == 1);
  CHECK(first.absorption_db_m == Approx(0.10));
  CHECK(first.agc_threshold == 120);
  CHECK(first.packet == 0);
  CHECK(first.pulse_s == Approx(60e-6));
  CHECK(first.data_points == 8000);
  CHECK(first.data_bits == 8);
  CHECK(first.attitude_command == 0x80);
  CHECK(first.frequency_hz == Approx(260e3).margin(1e-12));
  const SwitchCommand last = switch_command_in(hex(kSwitch30)).value();
  CHECK(last.range_m == Approx(30).margin(1e-12));
  CHECK(last.gain_db == 10);
  CHECK(last.packet == 7);
  CHECK(last.pulse_s == Approx(180e-6));
  const SwitchCommand tilted = switch_command_in(hex(kSwitchTilted)).value();
  CHECK(to_deg(tilted.nadir_offset_rad) == Approx(-15.0).margin(0.003));
  CHECK(tilted.gain_db == 8);
  CHECK(tilted.data_points == 16000);
  CHECK(tilted.run_mode == 0x10);
}

TEST_CASE("delta t head: what is no switch command is none", "[drivers]") {
  const ByteList good = hex(kSwitch10);
  CHECK_FALSE(switch_command_in(Bytes{good}.first(26)));
  for (const auto& [at, value] : std::vector<std::pair<std::size_t, int>>{
           {0, 0xFF}, {1, 0x45}, {2, 0x11}, {3, 11}, {13, 8}, {19, 9}, {25, 87}, {26, 0xFC}}) {
    ByteList bad = good;
    bad[at] = static_cast<std::uint8_t>(value);
    INFO("byte " << at);
    CHECK_FALSE(switch_command_in(bad));
  }
  CHECK(head_range_m(201) == 250);
  CHECK(head_range_m(202) == 300);
  CHECK(head_range_m(203) == 0);
}

TEST_CASE("delta t head: a reply says what its bytes mean", "[drivers]") {
  const ByteList bytes = reply();
  const HeadReply r = head_reply_in(bytes).value();
  CHECK(r.data_points == 8000);
  CHECK(r.status == 0x40);
  CHECK_FALSE(r.switch_error());
  CHECK(r.packet == 0);
  CHECK(r.firmware == 1);
  CHECK(r.range_m == Approx(10).margin(1e-12));
  CHECK(r.trigger_status == 1);
  CHECK(r.attitude_sensor == 5);
  CHECK(to_deg(r.pitch_rad) == Approx(1.4996).margin(5e-5));
  CHECK(to_deg(r.roll_rad) == Approx(-1.9995).margin(5e-5));
  CHECK(to_deg(r.heading_rad) == Approx(56.2006).margin(5e-5));
  CHECK(r.timer_ticks == 0x1234);
  CHECK(r.gain_db == 5);
  CHECK(r.agc_bin == 250);
  CHECK(r.agc_most == 200);
  REQUIRE(r.echoes.size() == 1000);
  CHECK(r.echoes[0] == 9);
}

TEST_CASE("delta t head: a reply in pieces is one when they are all there", "[drivers]") {
  const ByteList whole = reply();
  for (std::size_t piece = 1; piece <= 100; ++piece) {
    ByteList collected;
    while (collected.size() < whole.size()) {
      REQUIRE_FALSE(head_reply_in(collected));
      const std::size_t count = std::min(piece, whole.size() - collected.size());
      const auto from = whole.begin() + static_cast<std::ptrdiff_t>(collected.size());
      collected.insert(collected.end(), from, from + static_cast<std::ptrdiff_t>(count));
    }
    REQUIRE(head_reply_in(collected));
  }
}

TEST_CASE("delta t head: a switch error is seen, and a damaged reply is none", "[drivers]") {
  ByteList bytes = reply();
  bytes[4] = 1;
  CHECK(head_reply_in(bytes).value().switch_error());
  for (const auto& [at, value] : std::vector<std::pair<std::size_t, int>>{
           {0, 'J'}, {1, 'W'}, {2, 'Y'}, {3, 0x11}, {5, 8}, {10, 4}, {11, 0}, {1032, 0}}) {
    ByteList bad = reply();
    bad[at] = static_cast<std::uint8_t>(value);
    INFO("byte " << at);
    CHECK_FALSE(head_reply_in(bad));
  }
  ByteList of_sixteen = reply();
  of_sixteen[1] = 'V';
  of_sixteen[5] = 15;
  CHECK(head_reply_in(of_sixteen).value().data_points == 16000);
}

TEST_CASE("delta t head: a record of a raw file says what its bytes mean", "[drivers]") {
  const ByteList bytes = raw_record();
  const RawFileRecord r = raw_file_record_in(bytes).value();
  CHECK(r.length == 8192);
  CHECK(text_of(r.date) == "21-NOV-2026");
  CHECK(text_of(r.time) == "12:35:00");
  CHECK(text_of(r.hundredths) == ".25");
  CHECK(text_of(r.milliseconds) == ".253");
  CHECK(degrees_in(text_of(r.longitude)).value() == Approx(138.9));
  CHECK(r.display_mode == 0x83);
  CHECK(r.gain_db == 5);
  CHECK_FALSE(r.tilt_rad);
  CHECK(r.pulse_s == Approx(60e-6));
  CHECK(r.sound_speed_m_s == Approx(1500.0).margin(1e-12));
  CHECK(r.frequency_hz == Approx(260e3).margin(1e-12));
  CHECK(to_deg(r.pitch_rad.value()) == Approx(1.5));
  CHECK(to_deg(r.roll_rad.value()) == Approx(-2.0));
  CHECK(to_deg(r.heading_rad.value()) == Approx(56.2));
  CHECK(r.repetition_s == Approx(0.1));
  CHECK(r.display_gain_percent == 50);
  CHECK(r.status == 0x40);
  CHECK(r.packet == 7);
  CHECK(r.range_m == Approx(10).margin(1e-12));
  REQUIRE(r.echoes.size() == 8000);
  CHECK(r.echoes[0] == 200);
}

TEST_CASE("delta t head: raw records of 16000 points, of other water, tilted", "[drivers]") {
  ByteList bytes = raw_record();
  bytes[46] = 0xB9;
  bytes[47] = 0xE7;
  bytes[39] = 0x86;
  bytes[40] = 0x72;
  CHECK(raw_file_record_in(bytes).value().sound_speed_m_s == Approx(1482.3));
  CHECK(to_deg(raw_file_record_in(bytes).value().tilt_rad.value()) == Approx(-15.0));
  bytes[8112] = 0;
  CHECK_FALSE(raw_file_record_in(bytes));
  bytes.resize(16384);
  const ByteList lengths = hex("0B 40 00 3E 8D ");
  std::copy(lengths.begin(), lengths.end(), bytes.begin() + 3);
  bytes[16112] = 0xFC;
  bytes[110] = 0x3E;  // the whole buffer's length, as one of two writers has it
  bytes[111] = 0x80;
  CHECK(raw_file_record_in(bytes).value().echoes.size() == 16000);
  CHECK_FALSE(raw_file_record_in(Bytes{bytes}.first(16383)));
}

TEST_CASE("delta t head: a file of everything is told apart", "[drivers]") {
  ByteList all{1, 2, 3};
  const auto append = [&](const ByteList& bytes) {
    all.insert(all.end(), bytes.begin(), bytes.end());
  };
  append(hex(kSwitch10));
  append(reply());
  append(raw_record());
  append(testing::profile_vector());
  append({'8', '3', 'B'});
  append(testing::usual_image(testing::usual_header(RecordKind::kImage, 5)));
  const auto frame = control_frame({});
  append({frame.begin(), frame.end()});
  std::array<int, 6> seen{};
  int refused = 0;
  std::size_t skipped = 0;
  for (Bytes left{all}; !left.empty();) {
    const Found found = look_at_front(left);
    ++seen[found.what.index()];
    refused += found.refused ? 1 : 0;
    skipped += found.what.index() == 0 ? found.size : 0;
    left = left.subspan(found.size);
  }
  CHECK(seen[1] == 2);
  CHECK(seen[2] == 1);
  CHECK(seen[3] == 1);
  CHECK(seen[4] == 1);
  CHECK(seen[5] == 1);
  CHECK(refused == 1);
  CHECK(skipped == 6);
}

}  // namespace
}  // namespace lodesman::delta_t
