// SPDX-License-Identifier: Apache-2.0
// The records of the Delta T's program, and the frame that sets it, byte for byte as documents and
// one real record of 2015 have them.
#include "hal_sim/emulators/delta_t_record.h"

#include <algorithm>

#include "hal_sim/emulators/delta_t_control.h"
#include "tests/support/catch.h"
#include "tests/unit/emulators/support.h"

namespace lodesman {
namespace {

using namespace lodesman::testing;
using namespace lodesman::emulated;

[[nodiscard]] Bytes padded(Bytes bytes, std::size_t size = 256) {
  bytes.resize(size);
  return bytes;
}

[[nodiscard]] Bytes header_of(const DeltaTHeader& header, std::size_t total) {
  const auto made = delta_t_header(header, total);
  return {made.begin(), made.end()};
}

// A legal header of version 1.10, 120 beams, with intensity.
[[nodiscard]] DeltaTHeader example() {
  DeltaTHeader header;
  header.time = {2026, 11, 21, 12, 35, 0, 253};
  header.has_position = true;
  header.latitude_deg = 35.0 + 1.632 / 60.0;
  header.longitude_deg = 138.9;
  header.speed_kn = 1.0;
  header.course_deg = 54.7;
  header.pitch = {1.5, true};
  header.roll = {-2.0, true};
  header.heading = {56.2, true};
  header.start_deg = -60.0;
  header.range_m = 10;
  header.resolution_mm = 20;
  header.ping = 1234;
  header.offset_m = {0.0F, 0.0F, 0.35F};
  header.has_intensity = true;
  header.ping_latency_100us = 50;
  header.data_latency_100us = 120;
  return header;
}

const char* const kExample =
    "38 33 50 0A 02 E0 00 00 32 31 2D 4E 4F 56 2D 32"
    "30 32 36 00 31 32 3A 33 35 3A 30 30 00 2E 32 35"
    "00 20 33 35 2E 30 31 2E 36 33 32 30 30 20 4E 31"
    "33 38 2E 35 34 2E 30 30 30 30 30 20 45 0A 02 23"
    "83 93 83 70 82 32 00 78 01 F4 00 78 2E E0 64 00"
    "0A 01 04 BA 98 00 14 00 00 00 B4 00 64 00 00 04"
    "D2 00 00 00 00 00 00 00 00 00 00 00 3E B3 33 33"
    "2E 32 35 33 00 01 00 32 00 78 00 00 00 00 00 00";

TEST_CASE("delta_t record: a profile with intensity to the byte", "[hal_sim][emulators]") {
  std::vector<std::uint16_t> ranges(120);
  for (std::uint16_t i = 0; i < 120; i = static_cast<std::uint16_t>(i + 2)) {
    ranges[i] = static_cast<std::uint16_t>(250 + i);
  }
  const Bytes record = profile_record(example(), ranges, std::vector<std::uint16_t>(120, 0x0102));
  REQUIRE(record.size() == 736);
  CHECK(Bytes(record.begin(), record.begin() + 256) == padded(hex(kExample)));
  CHECK(Bytes(record.begin() + 256, record.begin() + 262) == hex("00 FA 00 00 00 FC"));
  CHECK(Bytes(record.begin() + 496, record.begin() + 500) == hex("01 02 01 02"));
}

TEST_CASE("delta_t record: sizes without intensity and at their largest", "[hal_sim][emulators]") {
  DeltaTHeader header = example();
  header.has_intensity = false;
  const Bytes plain = profile_record(header, std::vector<std::uint16_t>(120), {});
  CHECK(plain.size() == 496);
  CHECK(Bytes(plain.begin() + 4, plain.begin() + 6) == hex("01 F0"));
  CHECK(plain[117] == 0);
  header.has_intensity = true;
  const Bytes largest =
      profile_record(header, std::vector<std::uint16_t>(480), std::vector<std::uint16_t>(480));
  CHECK(largest.size() == 2176);
  CHECK(Bytes(largest.begin() + 4, largest.begin() + 6) == hex("08 80"));
}

TEST_CASE("delta_t record: what is not valid is not marked so", "[hal_sim][emulators]") {
  DeltaTHeader header = example();
  header.heading.is_valid = false;
  header.sound_speed_is_valid = false;
  const Bytes made = header_of(header, 736);
  CHECK(Bytes(made.begin() + 68, made.begin() + 70) == hex("02 32"));
  CHECK(Bytes(made.begin() + 83, made.begin() + 85) == hex("3A 98"));
}

TEST_CASE("delta_t record: the real header of 2015 to the byte", "[hal_sim][emulators]") {
  DeltaTHeader header;
  header.time = {2015, 6, 12, 12, 59, 24, 734};
  header.roll = {0.0, true};
  header.beams = 480;
  header.start_deg = -59.87;
  header.increment_deg = 0.25;
  header.range_m = 5;
  header.frequency_khz = 675;
  header.sound_speed_m_s = 1480.0;
  header.resolution_mm = 1;
  header.pulse_us = 30;
  header.repetition_ms = 103;
  header.ping = 1;
  header.ping_latency_100us = 5;
  header.fine_ranges = true;
  header.averaged = 5;
  header.centre_ping_100us = 4000;
  CHECK(header_of(header, 1216) == padded(hex("38 33 50 0A 04 C0 00 00 31 32 2D 4A 55 4E 2D 32"
                                              "30 31 35 00 31 32 3A 35 39 3A 32 34 00 2E 37 33"
                                              "00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00"
                                              "00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00"
                                              "03 84 83 84 00 00 01 E0 01 F4 00 78 2E ED 19 00"
                                              "05 02 A3 B9 D0 00 01 00 1E 00 B4 00 67 00 00 00"
                                              "01 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00"
                                              "2E 37 33 34 00 00 00 05 00 00 01 00 00 05 0F A0")));
}

TEST_CASE("delta_t record: an image has its length in three bytes, beam after beam",
          "[hal_sim][emulators]") {
  DeltaTHeader header = example();
  header.record = DeltaTRecord::k83B;
  header.has_intensity = false;
  Bytes image(120 * 500);
  image[59 * 500 + 250] = 77;
  const Bytes record = image_record(header, image);
  REQUIRE(record.size() == 60256);
  CHECK(Bytes(record.begin(), record.begin() + 8) == hex("38 33 42 0A 00 EB 60 00"));
  CHECK(record[30006] == 77);
  CHECK(std::count(record.begin() + 256, record.end(), 0) == 120 * 500 - 1);
  header.beams = 480;
  const Bytes large = image_record(header, Bytes(480 * 500));
  CHECK(Bytes(large.begin(), large.begin() + 8) == hex("38 33 42 0A 03 AA 80 00"));
  // What of an image's header no document has may be there or not.
  CHECK(record[112] == '.');
  header.whole_image_header = false;
  const Bytes bare = header_of(header, 60256);
  CHECK(std::count(bare.begin() + 97, bare.end(), 0) == 256 - 97);
  CHECK(Bytes(bare.begin() + 93, bare.begin() + 97) == hex("00 00 04 D2"));
}

TEST_CASE("delta_t record: attitude from outside in either order", "[hal_sim][emulators]") {
  DeltaTHeader header = example();
  header.external = ExternalAttitude::kHighByteFirst;
  const Bytes high = header_of(header, 736);
  CHECK(high[137] == 0b0111);
  CHECK(Bytes(high.begin() + 138, high.begin() + 142) == hex("3F C0 00 00"));  // 1.5
  CHECK(Bytes(high.begin() + 142, high.begin() + 146) == hex("C0 00 00 00"));  // -2
  header.external = ExternalAttitude::kLowByteFirst;
  const Bytes low = header_of(header, 736);
  CHECK(Bytes(low.begin() + 138, low.begin() + 142) == hex("00 00 C0 3F"));
}

TEST_CASE("delta_t record: south and west, and no sixty minutes", "[hal_sim][emulators]") {
  CHECK(delta_t_latitude(-35.0272) == " 35.01.63200 S");
  CHECK(delta_t_longitude(-5.5) == "005.30.00000 W");
  CHECK(delta_t_latitude(34.99999999999) == " 35.00.00000 N");
}

TEST_CASE("delta_t control: the documented frames set what they say", "[hal_sim][emulators]") {
  DeltaTSettings settings;
  settings.sector_deg = 30;
  settings.beams = 480;
  settings.averaged = 5;
  CHECK(obey(padded(hex("45 43 00 01 00 00 00 03 05 32 00 03 00 02 00 00 00 3A 98 03 01 01 00 1E "
                        "00 B4 00 00 00 00 00 00 00 00 00 00")),
             settings));
  CHECK(settings.range_m == 10);
  CHECK(settings.gain_db == 5);
  CHECK(settings.sector_deg == 120);
  CHECK(settings.beams == 120);
  CHECK(settings.averaged == 0);
  CHECK(settings.sound_speed_m_s == Approx(1500.0));
  CHECK(settings.sends_image);
  CHECK(settings.profile_points);
  CHECK(settings.profile_least_level_percent == 30);
  CHECK(settings.tilt_deg == 0);
  CHECK(settings.transmits);
  CHECK(obey(padded(hex("45 43 00 01 00 00 00 05 0A 32 00 03 00 02 00 00 00 3A 98 03 00 01 00 1E "
                        "00 B4 00 00 00 00 00 00 00 00 00 00")),
             settings));
  CHECK(settings.range_m == 30);
  CHECK(settings.gain_db == 10);
  CHECK_FALSE(settings.sends_image);
}

TEST_CASE("delta_t control: what is no such frame sets nothing, nor does a code without meaning",
          "[hal_sim][emulators]") {
  const Bytes good = padded(hex("45 43 00 01 00 00 00 05 0A 32 00 03 00 02"));
  for (const std::size_t at : {0U, 1U, 2U, 3U}) {
    Bytes bad = good;
    bad[at] = static_cast<std::uint8_t>(bad[at] + 1);
    DeltaTSettings settings;
    settings.range_m = 5;
    CHECK_FALSE(obey(bad, settings));
    CHECK_FALSE(obey(std::span{good}.first(255), settings));
    CHECK(settings.range_m == 5);
  }
  DeltaTSettings settings;
  Bytes odd = good;
  odd[7] = 15;
  odd[8] = 21;
  odd[11] = 4;
  odd[13] = 3;
  odd[14] = 11;
  odd[20] = 2;
  CHECK(obey(odd, settings));
  CHECK(settings.range_m == 30);
  CHECK(settings.gain_db == 10);
  CHECK(settings.sector_deg == 120);
  CHECK(settings.beams == 120);
  CHECK(settings.averaged == 0);
  CHECK(settings.sends_image);
  CHECK(settings.sound_speed_m_s == Approx(1500.0));
}

}  // namespace
}  // namespace lodesman
