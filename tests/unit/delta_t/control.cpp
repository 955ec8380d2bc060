// SPDX-License-Identifier: Apache-2.0
#include "drivers/delta_t/control.h"

#include "drivers/delta_t/settings.h"
#include "mid_level/base/startup_error.h"
#include "tests/support/catch.h"
#include "tests/support/delta_t_records.h"
#include "tests/unit/delta_t/vectors.h"

namespace lodesman::delta_t {
namespace {

using testing::ByteList;

[[nodiscard]] DeltaTSettings settings_of(std::string_view rest) {
  return delta_t_settings_in({rest, delta_t_settings()});
}

[[nodiscard]] ByteList frame_of(const Control& control) {
  const auto frame = control_frame(control);
  return {frame.begin(), frame.end()};
}

TEST_CASE("delta t control: its frame is that of the sources, to the byte", "[drivers]") {
  const ByteList image = testing::hex(
      "45 43 00 01 00 00 00 03 05 32 00 03 00 02 00 00 00 3A 98 03 01 01 00 1E 00 B4 00 00 00 00 "
      "00 00 00 00 00 00 ",
      256);
  const ByteList profile = testing::hex(
      "45 43 00 01 00 00 00 05 0A 32 00 03 00 02 00 00 00 3A 98 03 00 01 00 1E 00 B4 00 00 00 00 "
      "00 00 00 00 00 00 ",
      256);
  Control control;
  control.range_m = 10;
  control.gain_db = 5;
  CHECK(frame_of(control) == image);
  CHECK(control_in(image) == control);
  control = {};
  control.output = RecordKind::kProfile;
  CHECK(frame_of(control) == profile);
  CHECK(control_in(profile) == control);
}

TEST_CASE("delta t control: every setting comes back from its frame", "[drivers]") {
  for (const int range_m : kRanges_m) {
    for (const int sector_deg : kSectors_deg) {
      for (const int beams : kBeams) {
        Control control;
        control.output = RecordKind::kProfile;
        control.range_m = range_m;
        control.sector_deg = sector_deg;
        control.beams = beams;
        control.gain_db = 20;
        control.sound_speed_m_s = 1482.3;
        control.display_gain_percent = 77;
        control.least_level_percent = 90;
        control.least_range_m = 3;
        control.transducer_up = true;
        CHECK(control_in(control_frame(control)) == control);
      }
    }
  }
}

TEST_CASE("delta t control: what is no such frame is none", "[drivers]") {
  const ByteList good = frame_of({});
  CHECK_FALSE(control_in(Bytes{good}.first(255)));
  for (const auto& [at, value] : std::vector<std::pair<std::size_t, int>>{{0, 'e'},
                                                                          {1, 'B'},
                                                                          {2, 1},
                                                                          {3, 2},
                                                                          {7, 0},
                                                                          {7, 1},
                                                                          {7, 15},
                                                                          {11, 4},
                                                                          {13, 3},
                                                                          {20, 2}}) {
    ByteList bad = good;
    bad[at] = static_cast<std::uint8_t>(value);
    CHECK_FALSE(control_in(bad));
  }
}

TEST_CASE("delta t control: a header echoes what was asked for, or does not", "[drivers]") {
  const Control control;
  const Header good = testing::usual_header(RecordKind::kImage, 1);
  CHECK(echoes(good, control));
  Header h = good;
  SECTION("another range") { h.range_m = 20.0; }
  SECTION("another kind") { h.kind = RecordKind::kProfile; }
  SECTION("other beams") { h.beams = 240; }
  SECTION("another sector") { h.sector_rad = to_rad(90.0); }
  SECTION("another sound speed") { h.sound_speed = 1499.9; }
  SECTION("averaged pings") { h.pings_averaged = 2; }
  CHECK_FALSE(echoes(h, control));
}

TEST_CASE("delta t settings: an address says all of them", "[drivers]") {
  const DeltaTSettings usual = settings_of("192.168.0.5");
  CHECK(usual.port == 4040);
  CHECK(usual.controls);
  CHECK(usual.beam_sign == BeamSign::kStarboard);
  CHECK(usual.control == Control{});
  const DeltaTSettings other = settings_of(
      "sonar-pc?port=4041&output=83P&range_m=80&gain_db=7&sector_deg=90&beams=480"
      "&sound_speed_m_s=1482.5&display_gain_percent=60&least_level_percent=20&least_range_m=2"
      "&transducer=up&control=off&beam_sign=port");
  CHECK(other.port == 4041);
  CHECK_FALSE(other.controls);
  CHECK(other.beam_sign == BeamSign::kPort);
  CHECK(other.control == Control{RecordKind::kProfile, 80, 7, 60, 90, 480, 1482.5, 20, 2, true});
}

TEST_CASE("delta t settings: what cannot be is refused", "[drivers]") {
  for (const std::string_view rest :
       {"", "?port=4040", "pc?port=0", "pc?port=65536", "pc?range_m=35", "pc?gain_db=21",
        "pc?sector_deg=100", "pc?beams=121", "pc?sound_speed_m_s=1399", "pc?sound_speed_m_s=nan",
        "pc?output=83Z", "pc?beam_sign=left", "pc?control=yes", "pc?transducer=side",
        "pc?sector_deg=90", "pc?beams=240", "pc?output=83B&beams=480", "pc?colour=red"}) {
    INFO(rest);
    CHECK_THROWS_AS(settings_of(rest), StartupError);
  }
  CHECK(settings_of("pc?output=83P&sector_deg=90&beams=240").control.beams == 240);
}

}  // namespace
}  // namespace lodesman::delta_t
