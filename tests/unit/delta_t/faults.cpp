// SPDX-License-Identifier: Apache-2.0
// What goes wrong with sonars of this kind in the wild: docs/device_faults.md names each row's
// test.
#include <random>

#include "tests/unit/delta_t/bench.h"
#include "tests/unit/delta_t/vectors.h"

namespace lodesman {
namespace {

using delta_t::Header;
using delta_t::RecordKind;
using std::chrono::milliseconds;
using testing::ByteList;
using testing::DeltaTBench;
using testing::usual_header;

TEST_CASE("delta t: D1: a resolution in centimetres is mended, another is refused and counted",
          "[drivers]") {
  DeltaTSettings settings;
  settings.control.output = RecordKind::kProfile;
  DeltaTBench bench{settings};
  ByteList bytes = testing::usual_profile(usual_header(RecordKind::kProfile, 1));
  bytes[86] = 6;  // 6 cm
  REQUIRE(bench.send(bytes));
  REQUIRE(bench.poll() == ReadStatus::kFresh);
  CHECK(bench.ping->points[30].range_m == Approx(6.0));
  CHECK(bench.driver.counts().centimetres == 1);
  bytes = testing::usual_profile(usual_header(RecordKind::kProfile, 2));
  bytes[86] = 61;
  REQUIRE(bench.send(bytes));
  CHECK(bench.poll() == ReadStatus::kFresh);  // within two in a hundred
  for (std::uint32_t number = 3; number <= 8; ++number) {
    bytes = testing::usual_profile(usual_header(RecordKind::kProfile, number));
    bytes[86] = 70;
    REQUIRE(bench.send(bytes));
    CHECK(bench.poll() == ReadStatus::kCorrupt);
    CHECK(bench.poll() == ReadStatus::kNothingNew);
  }
  CHECK(bench.driver.counts().implausible == 6);
  CHECK(bench.driver.fault() == DeviceFault::kImplausible);
}

TEST_CASE("delta t: D2: a datagram of a whole image is taken, lengths that lie are refused",
          "[drivers]") {
  DeltaTBench bench;
  REQUIRE(bench.send_image(1));
  REQUIRE(bench.poll() == ReadStatus::kFresh);
  CHECK(bench.ping->echo_count == 60000);
  ByteList part = testing::profile_vector();
  part.resize(300);
  std::uint64_t refused = 0;
  for (const unsigned length : {0U, 255U, 256U, 65535U}) {
    part[4] = static_cast<std::uint8_t>(length >> 8U);
    part[5] = static_cast<std::uint8_t>(length & 0xFFU);
    REQUIRE(bench.send(part));
    CHECK(bench.poll() == ReadStatus::kCorrupt);
    CHECK(bench.driver.counts().wrong_lengths == ++refused);
  }
  ByteList cut = testing::usual_image(usual_header(RecordKind::kImage, 2));
  cut.resize(2176);
  REQUIRE(bench.send(cut));
  CHECK(bench.poll() == ReadStatus::kCorrupt);
  REQUIRE(bench.send_image(3));
  CHECK(bench.poll() == ReadStatus::kFresh);
}

TEST_CASE("delta t: D3: other tags on the socket are counted and disturb nothing", "[drivers]") {
  DeltaTBench bench;
  int fresh = 0;
  for (std::uint32_t number = 1; number <= 50; ++number) {
    ByteList other = testing::profile_vector();
    other[2] = number % 2 == 0 ? 'Z' : 'F';
    REQUIRE(bench.send(other));
    REQUIRE(bench.send({}));
    REQUIRE(bench.send_image(number));
    REQUIRE(bench.send(ByteList(60000, 0x55)));
    fresh += bench.poll(milliseconds{100}) == ReadStatus::kFresh ? 1 : 0;
  }
  CHECK(fresh == 50);
  CHECK(bench.driver.counts().unknown_tags == 150);
  CHECK(bench.driver.fault() == DeviceFault::kNone);
}

TEST_CASE("delta t: D4: a stamp is the time of the ping, by the latencies of its header",
          "[drivers]") {
  DeltaTBench bench;
  Header h = usual_header(RecordKind::kImage, 1);
  h.ping_latency = milliseconds{5};
  h.data_latency = milliseconds{120};
  for (; h.ping_number <= 20; ++h.ping_number) {
    const Time sent = bench.now + milliseconds{100} - milliseconds{115};
    REQUIRE(bench.send(testing::usual_image(h)));
    REQUIRE(bench.poll(milliseconds{100}) == ReadStatus::kFresh);
    CHECK(bench.ping->captured == sent);
  }
}

TEST_CASE("delta t: D4: a ping that comes again is used once, a gap is counted", "[drivers]") {
  DeltaTBench bench;
  for (const std::uint32_t number : {7U, 7U, 8U, 6U, 1008U, 1009U}) {
    REQUIRE(bench.send_image(number));
    const bool is_news = number != 6 && !(number == 7 && bench.last_number > 0);
    CHECK((bench.poll() == ReadStatus::kFresh) == is_news);
  }
  CHECK(bench.driver.counts().order.repeated == 1);
  CHECK(bench.driver.counts().order.late == 1);
  CHECK(bench.driver.counts().order.lost == 999);
  CHECK(bench.driver.counts().images == 4);
}

TEST_CASE("delta t: D6: bearings are the header's, and a strange geometry is told", "[drivers]") {
  DeltaTBench bench;
  Header h = usual_header(RecordKind::kImage, 1);
  const struct {
    double start_deg, step_deg, sector_deg;
    DeviceFault fault;
  } rows[] = {{-59.5, 1.0, 120.0, DeviceFault::kNone},
              {-60.0, 1.0, 120.0, DeviceFault::kUnusualBeams},
              {-59.5, 0.5, 120.0, DeviceFault::kUnusualBeams},
              {-59.5, 1.0, 90.0, DeviceFault::kUnusualBeams},
              {-29.75, 0.5, 60.0, DeviceFault::kNone}};
  for (const auto& row : rows) {
    h.first_bearing_rad = to_rad(row.start_deg);
    h.beam_step_rad = to_rad(row.step_deg);
    h.sector_rad = to_rad(row.sector_deg);
    REQUIRE(bench.send(testing::usual_image(h)));
    REQUIRE(bench.poll() == ReadStatus::kFresh);
    CHECK(to_deg(bench.ping->bearing_rad(0)) == Approx(row.start_deg));
    CHECK(to_deg(bench.ping->bearing_rad(1)) == Approx(row.start_deg + row.step_deg));
    CHECK(bench.driver.fault() == row.fault);
    ++h.ping_number;
  }
  CHECK(bench.driver.counts().unusual_beams == 3);
}

TEST_CASE("delta t: D7: each ping is decoded by its own header while settings change",
          "[drivers]") {
  DeltaTBench bench;
  REQUIRE(bench.send_image(1));
  REQUIRE(bench.poll(milliseconds{100}) == ReadStatus::kFresh);
  CHECK(bench.driver.is_as_asked());
  static_cast<void>(bench.asked());
  Header h = usual_header(RecordKind::kImage, 2);
  h.range_m = 10.0;
  REQUIRE(bench.send(testing::usual_image(h)));
  REQUIRE(bench.poll(milliseconds{100}) == ReadStatus::kFresh);
  CHECK(bench.ping->range_m == Approx(10.0).margin(1e-12));
  CHECK(bench.asked().value().range_m ==
        Approx(30).margin(1e-12));  // at once, though a second has not gone by
  h = usual_header(RecordKind::kProfile, 3);
  REQUIRE(bench.send(testing::usual_profile(h)));
  REQUIRE(bench.poll(milliseconds{100}) == ReadStatus::kFresh);
  CHECK(bench.ping->kind == PingKind::kProfile);
  CHECK(bench.ping->points[30].range_m == Approx(6.0));
  CHECK(bench.asked().value().output == RecordKind::kImage);
  REQUIRE(bench.send_image(4));
  REQUIRE(bench.poll(milliseconds{100}) == ReadStatus::kFresh);
  CHECK(bench.ping->kind == PingKind::kImage);
  CHECK(bench.ping->point_count == 0);
  CHECK(bench.driver.is_as_asked());
}

TEST_CASE("delta t: damaged datagrams never give a wrong ping", "[drivers]") {
  DeltaTBench bench;
  std::mt19937 random{20261127};
  int fresh = 0;
  for (std::uint32_t number = 1; number <= 2000; ++number) {
    const RecordKind kind = number % 2 == 0 ? RecordKind::kImage : RecordKind::kProfile;
    Header h = usual_header(kind, number);
    h.samples = 20;
    ByteList bytes =
        kind == RecordKind::kImage ? testing::usual_image(h) : testing::usual_profile(h);
    switch (random() % 4) {
      case 0: bytes.resize(random() % bytes.size()); break;
      case 1: bytes[random() % 256] = static_cast<std::uint8_t>(random()); break;
      case 2: bytes.insert(bytes.end(), 1 + random() % 10, 0); break;
      default: break;
    }
    REQUIRE(bench.send(bytes));
    if (random() % 100 == 0) {
      REQUIRE(bench.send(bytes));  // twice
    }
    // Its bench asks whether each that comes is sane, later than the last, and not of the future.
    for (int i = 0; i < 2; ++i) {
      fresh += bench.poll() == ReadStatus::kFresh ? 1 : 0;
    }
    static_cast<void>(bench.asked());
  }
  CHECK(fresh > 600);
  const DeltaTCounts counts = bench.driver.counts();
  CHECK(counts.wrong_lengths > 500);
  CHECK(counts.datagrams >= 2000);
}

}  // namespace
}  // namespace lodesman
