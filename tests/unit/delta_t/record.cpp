// SPDX-License-Identifier: Apache-2.0
#include "drivers/delta_t/record.h"

#include <random>

#include "mid_level/messages/sonar.h"
#include "tests/support/catch.h"
#include "tests/support/delta_t_records.h"
#include "tests/unit/delta_t/vectors.h"

namespace lodesman::delta_t {
namespace {

using std::chrono::microseconds;
using testing::ByteList;

[[nodiscard]] Record good(const ByteList& bytes) {
  const Parsed parsed = parse_record(bytes);
  REQUIRE(parsed.refusal == Refusal::kNone);
  return parsed.record;
}

[[nodiscard]] bool comes_back(const ByteList& bytes) {
  const Record record = good(bytes);
  return testing::record_bytes(record.header, record.body) == bytes;
}

void set_word(ByteList& bytes, std::size_t at, unsigned value) {
  bytes[at] = static_cast<std::uint8_t>(value >> 8U);
  bytes[at + 1] = static_cast<std::uint8_t>(value & 0xFFU);
}

TEST_CASE("delta t record: a profile says what its bytes mean", "[drivers]") {
  const ByteList bytes = testing::profile_vector();
  const Record record = good(bytes);
  const Header& h = record.header;
  CHECK(h.kind == RecordKind::kProfile);
  CHECK(h.version == 10);
  CHECK(h.total_bytes == 736);
  CHECK(text_of(h.date) == "21-NOV-2026");
  CHECK(text_of(h.time) == "12:35:00");
  CHECK(text_of(h.hundredths) == ".25");
  CHECK(text_of(h.milliseconds) == ".253");
  CHECK(degrees_in(text_of(h.latitude)).value() == Approx(35.0 + 1.632 / 60.0).epsilon(1e-12));
  CHECK(degrees_in(text_of(h.longitude)).value() == Approx(138.9).epsilon(1e-12));
  CHECK(h.speed_m_s == Approx(1852.0 / 3600.0));
  CHECK(to_deg(h.course_rad) == Approx(54.7));
  CHECK(to_deg(h.pitch_rad.value()) == Approx(1.5));
  CHECK(to_deg(h.roll_rad.value()) == Approx(-2.0));
  CHECK(to_deg(h.heading_rad.value()) == Approx(56.2));
  CHECK(h.beams == 120);
  CHECK(h.samples == 500);
  CHECK(to_deg(h.sector_rad) == Approx(120.0));
  CHECK(to_deg(h.first_bearing_rad) == Approx(-60.0));
  CHECK(to_deg(h.beam_step_rad) == Approx(1.0));
  CHECK(h.range_m == Approx(10.0).margin(1e-12));
  CHECK(h.frequency_hz == Approx(260e3).margin(1e-12));
  CHECK(h.sound_speed.value() == Approx(1500.0).margin(1e-12));
  CHECK(h.resolution_m == Approx(0.02));
  CHECK(h.tilt_rad == Approx(0.0).margin(1e-12));
  CHECK(h.repetition_s == Approx(0.1));
  CHECK(h.ping_number == 1234);
  CHECK(h.offset_m[2] == Approx(0.35));
  CHECK(h.has_intensities);
  CHECK(h.ping_latency == microseconds{5000});
  CHECK(h.data_latency == microseconds{12000});
  CHECK(h.age_at_arrival() == microseconds{7000});
  CHECK_FALSE(h.fills_its_sector());  // a real program would begin at -59.5
  CHECK(written_at(h).value() == std::chrono::seconds{1795264500} + microseconds{253000});
}

TEST_CASE("delta t record: a profile's ranges lie where they should", "[drivers]") {
  const ByteList bytes = testing::profile_vector();
  const Record record = good(bytes);
  CHECK(record.range_m(0) == Approx(5.0));
  CHECK(record.range_m(1) == Approx(0.0).margin(1e-12));
  CHECK(record.range_m(2) == Approx(5.04));
  CHECK(record.intensity(2) == 2);
  const double bearing = record.header.first_bearing_rad + 2.0 * record.header.beam_step_rad;
  CHECK(record.range_m(2) * std::sin(bearing) == Approx(-4.274).margin(5e-4));
  CHECK(record.range_m(2) * std::cos(bearing) == Approx(2.671).margin(5e-4));
}

TEST_CASE("delta t record: the real header of 2015 says what its bytes mean", "[drivers]") {
  const ByteList bytes = testing::real_vector();
  const Record record = good(bytes);
  const Header& h = record.header;
  CHECK(h.total_bytes == 1216);
  CHECK(text_of(h.date) == "12-JUN-2015");
  CHECK(text_of(h.time) == "12:59:24");
  CHECK_FALSE(h.pitch_rad);
  CHECK(h.roll_rad.value() == Approx(0.0).margin(1e-12));
  CHECK_FALSE(h.heading_rad);
  CHECK(h.beams == 480);
  CHECK(to_deg(h.first_bearing_rad) == Approx(-59.87));
  CHECK(to_deg(h.beam_step_rad) == Approx(0.25));
  CHECK(h.fills_its_sector());
  CHECK(h.range_m == Approx(5.0).margin(1e-12));
  CHECK(h.frequency_hz == Approx(675e3).margin(1e-12));
  CHECK(h.sound_speed.value() == Approx(1480.0));
  CHECK(h.resolution_m == Approx(0.001));
  CHECK(h.sample_rate_code == 1);
  CHECK(h.pulse_s == Approx(30e-6));
  CHECK(h.repetition_s == Approx(0.103));
  CHECK(h.ping_number == 1);
  CHECK_FALSE(h.has_intensities);
  CHECK(h.ping_latency == microseconds{500});
  CHECK(h.data_latency == Duration::zero());
  CHECK(h.pings_averaged == 5);
  CHECK(h.centre_ping_offset == microseconds{400000});
  CHECK(degrees_in(text_of(h.latitude)) == std::nullopt);
  const Duration at = written_at(h).value();
  CHECK(at % std::chrono::seconds{1} == std::chrono::milliseconds{734});
}

TEST_CASE("delta t record: what is decoded goes back to the byte", "[drivers]") {
  CHECK(comes_back(testing::profile_vector()));
  CHECK(comes_back(testing::real_vector()));
  ByteList bare = testing::profile_vector();  // without intensities
  bare.resize(496);
  bare[117] = 0;
  set_word(bare, 4, 496);
  CHECK(comes_back(bare));
  ByteList full = testing::profile_vector();  // the longest: 480 beams with intensities
  full.resize(2176);
  set_word(full, 4, 2176);
  set_word(full, 70, 480);
  full[78] = 25;
  CHECK(full[4] == 0x08);
  CHECK(full[5] == 0x80);
  CHECK(comes_back(full));
  CHECK(comes_back(testing::usual_image(testing::usual_header(RecordKind::kImage, 0x01020304))));
  Header h = testing::usual_header(RecordKind::kProfile, 7);
  h.has_intensities = true;
  h.sound_speed.reset();
  h.external_flags = 7;
  h.external_pitch_rad = to_rad(-1.5);
  h.external_roll_rad = to_rad(2.25);
  h.external_heading_rad = to_rad(181.0);
  h.altitude_m = 12.5;
  h.heave_m = -0.25;
  h.auto_scan = true;
  h.flags = 5;
  CHECK(comes_back(testing::usual_profile(h)));
}

TEST_CASE("delta t record: of an image three bytes hold the length, and a row is a beam",
          "[drivers]") {
  const ByteList small = testing::usual_image(testing::usual_header(RecordKind::kImage, 1));
  REQUIRE(small.size() == 60256);
  const ByteList begin{0x38, 0x33, 0x42, 0x0A, 0x00, 0xEB, 0x60, 0x00};
  CHECK(std::equal(begin.begin(), begin.end(), small.begin()));
  Header h = testing::usual_header(RecordKind::kImage, 1);
  h.beams = 480;
  h.beam_step_rad = to_rad(0.25);
  h.first_bearing_rad = to_rad(-59.87);
  const ByteList large = testing::image_record(h, [](std::uint32_t beam, std::uint32_t bin) {
    return static_cast<std::uint8_t>(beam == 59 && bin == 250 ? 77 : 1);
  });
  REQUIRE(large.size() == 240256);
  const ByteList long_begin{0x38, 0x33, 0x42, 0x0A, 0x03, 0xAA, 0x80, 0x00};
  CHECK(std::equal(long_begin.begin(), long_begin.end(), large.begin()));
  CHECK(large[30006] == 77);
  const Record record = good(large);
  CHECK(record.sample(59, 250) == 77);
  CHECK(record.sample(60, 250) == 1);
  CHECK(comes_back(large));
}

TEST_CASE("delta t record: what is not valid is absent, whatever its other bits say", "[drivers]") {
  ByteList bytes = testing::profile_vector();
  set_word(bytes, 68, 0x0232);
  set_word(bytes, 83, 0x3A98);
  const Record record = good(bytes);
  CHECK_FALSE(record.header.heading_rad);
  CHECK_FALSE(record.header.sound_speed);
  CHECK(record.header.sound_speed_m_s() == Approx(1500.0).margin(1e-12));
}

TEST_CASE("delta t record: ranges are stretched by the speed of sound", "[drivers]") {
  ByteList bytes = testing::profile_vector();
  set_word(bytes, 83, 0x8000 + 14400);
  CHECK(good(bytes).range_m(0) == Approx(5.0 * 1440.0 / 1500.0));
  set_word(bytes, 256, 511);  // 10.22 m of 10: of another ping, or noise
  CHECK(good(bytes).range_m(0) == Approx(0.0).margin(1e-12));
  set_word(bytes, 256, 509);
  CHECK(good(bytes).range_m(0) == Approx(10.18 * 0.96));
}

TEST_CASE("delta t record: a resolution in centimetres is seen and mended, another is refused",
          "[drivers]") {
  ByteList bytes = testing::profile_vector();
  set_word(bytes, 85, 2);
  const Record record = good(bytes);
  CHECK(record.header.resolution_was_cm);
  CHECK(record.header.resolution_m == Approx(0.02));
  CHECK(record.range_m(0) == Approx(5.0));
  for (const unsigned resolution_mm : {0U, 1U, 3U, 19U, 21U, 200U, 65535U}) {
    INFO(resolution_mm);
    set_word(bytes, 85, resolution_mm);
    CHECK(parse_record(bytes).refusal == Refusal::kRange);
  }
}

TEST_CASE("delta t record: reals whose byte order is in doubt are read by what they can be",
          "[drivers]") {
  ByteList bytes = testing::profile_vector();
  bytes[137] = 7;
  const auto set_real = [&](std::size_t at, double value, bool low_first) {
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
    for (std::size_t i = 0; i < 4; ++i) {
      bytes[at + i] = static_cast<std::uint8_t>(bits >> (low_first ? 8 * i : 24 - 8 * i));
    }
  };
  for (const bool low_first : {false, true}) {
    for (const double value : {-12.25, 3.3, 181.0, 0.01}) {
      set_real(138, value, low_first);
      set_real(142, -value, low_first);
      set_real(146, 359.5, low_first);
      set_real(133, 1.75, low_first);
      const Header h = good(bytes).header;
      CHECK(to_deg(h.external_pitch_rad.value()) == Approx(value));
      CHECK(to_deg(h.external_roll_rad.value()) == Approx(-value));
      CHECK(to_deg(h.external_heading_rad.value()) == Approx(359.5));
      CHECK(h.altitude_m.value() == Approx(1.75));
    }
  }
  bytes[138] = bytes[141] = 0x7F;  // neither way round: both are huge
  bytes[139] = bytes[140] = 0xC0;
  CHECK_FALSE(good(bytes).header.external_pitch_rad);
  bytes[137] = 0;  // not there, whatever its bytes say
  CHECK_FALSE(good(bytes).header.external_heading_rad);
}

TEST_CASE("delta t record: a length that is not its own is refused, however it is wrong",
          "[drivers]") {
  const ByteList profile = testing::profile_vector();
  const ByteList image = testing::usual_image(testing::usual_header(RecordKind::kImage, 1));
  for (const ByteList& whole : {profile, image}) {
    for (std::size_t size = 3; size < whole.size(); size += size < 300 ? 1 : 97) {
      CHECK(parse_record(Bytes{whole}.first(size)).refusal == Refusal::kWrongLength);
    }
    ByteList longer = whole;
    longer.push_back(0);
    CHECK(parse_record(longer).refusal == Refusal::kWrongLength);
  }
  ByteList part{profile.begin(), profile.begin() + 300};
  for (const unsigned length : {0U, 255U, 256U, 300U, 65535U}) {
    set_word(part, 4, length);
    CHECK(parse_record(part).refusal == Refusal::kWrongLength);
  }
}

TEST_CASE("delta t record: geometry, range and sound speed that cannot be are refused",
          "[drivers]") {
  const ByteList bytes = testing::usual_image(testing::usual_header(RecordKind::kImage, 1));
  const auto refusal = [&](std::size_t at, unsigned value) {
    ByteList changed = bytes;
    set_word(changed, at, value);
    return parse_record(changed).refusal;
  };
  const auto refusal_of_step = [&](std::uint8_t step) {
    ByteList changed = bytes;
    changed[78] = step;
    return parse_record(changed).refusal;
  };
  CHECK(refusal_of_step(100) == Refusal::kNone);
  CHECK(refusal_of_step(0) == Refusal::kGeometry);
  CHECK(refusal_of_step(151) == Refusal::kGeometry);  // more than half round
  CHECK(refusal(76, 36001) == Refusal::kGeometry);
  CHECK(refusal(76, 30000) == Refusal::kGeometry);  // the last beams would look astern of astern
  CHECK(refusal(79, 0) == Refusal::kRange);
  CHECK(refusal(79, 301) == Refusal::kRange);
  CHECK(refusal(79, 300) == Refusal::kNone);
  CHECK(refusal(83, 0x8000) == Refusal::kSoundSpeed);
  CHECK(refusal(83, 0x8000 + 17001) == Refusal::kSoundSpeed);
  CHECK(refusal(83, 0x8000 + 17000) == Refusal::kNone);
  Header h = testing::usual_header(RecordKind::kImage, 1);
  h.samples = kMaxBins + 1;
  CHECK(parse_record(testing::usual_image(h)).refusal == Refusal::kGeometry);
  h.samples = 500;
  h.beams = 0;
  CHECK(parse_record(testing::usual_image(h)).refusal == Refusal::kGeometry);
}

TEST_CASE("delta t record: other tags are others", "[drivers]") {
  for (const std::string_view tag : {"83Z", "83F", "837", "83b", "93P", "", "83", "IUX"}) {
    ByteList bytes = testing::profile_vector();
    bytes.resize(tag.size() < 3 ? tag.size() : 736);
    std::copy(tag.begin(), tag.end(), bytes.begin());
    CHECK(parse_record(bytes).refusal == Refusal::kUnknownTag);
    CHECK(record_length(bytes) == 0);
  }
  CHECK(record_length(testing::profile_vector()) == 736);
}

TEST_CASE("delta t record: any bytes may be asked about", "[drivers]") {
  std::mt19937 random{13};
  const ByteList whole = testing::profile_vector();
  int taken = 0;
  bool all_in_range = true;
  for (int round = 0; round < 20000; ++round) {
    ByteList bytes = whole;
    for (unsigned i = 0; i <= random() % 6; ++i) {
      bytes[random() % (round % 2 == 0 ? 256 : bytes.size())] = static_cast<std::uint8_t>(random());
    }
    bytes.resize(round % 3 == 0 ? random() % 1000 : bytes.size());
    const Parsed parsed = parse_record(bytes);
    if (parsed.refusal != Refusal::kNone) {
      continue;
    }
    ++taken;
    const Header& h = parsed.record.header;
    for (std::uint32_t beam = 0; beam < h.beams; ++beam) {
      const double range_m = parsed.record.range_m(beam);
      all_in_range = all_in_range && range_m >= 0.0 && range_m <= kMaxSonarRange_m;
      static_cast<void>(parsed.record.intensity(beam));
    }
    static_cast<void>(written_at(h));
    static_cast<void>(degrees_in(text_of(h.latitude)));
  }
  CHECK(all_in_range);
  CHECK(taken > 1000);
}

TEST_CASE("delta t record: places and times are read where they are some", "[drivers]") {
  CHECK(degrees_in(" 35.01.63200 S").value() == Approx(-35.0272));
  CHECK(degrees_in("179.59.99999 W").value() == Approx(-180.0).margin(1e-6));
  for (const std::string_view text :
       {"", " ", "35", " 91.00.00000 N", "181.00.00000 E", " 35.61.00000 N", " 35.01.63200 Q",
        " 35.01.63200", "ab.cd.efghi N", "99999999.1.1 N"}) {
    CHECK_FALSE(degrees_in(text));
  }
  Header h = testing::usual_header(RecordKind::kImage, 1);
  REQUIRE(written_at(h));
  for (const std::string_view date :
       {"", "31-FEB-2026", "01-XXX-2026", "1-JAN-69", "01-JAN-9999", "JAN-01-2026", "01/01/2026"}) {
    testing::set_text(h.date, date);
    CHECK_FALSE(written_at(h));
  }
  testing::set_text(h.date, "01-JAN-1970");
  testing::set_text(h.time, "00:00:01");
  testing::set_text(h.milliseconds, "");
  CHECK(written_at(h).value() == std::chrono::milliseconds{1250});
  testing::set_text(h.hundredths, "??");
  CHECK(written_at(h).value() == std::chrono::seconds{1});
  testing::set_text(h.time, "24:00:00");
  CHECK_FALSE(written_at(h));
}

}  // namespace
}  // namespace lodesman::delta_t
