// SPDX-License-Identifier: Apache-2.0
#include "drivers/delta_t/delta_t.h"

#include "tests/support/allocations.h"
#include "tests/unit/delta_t/bench.h"

namespace lodesman {
namespace {

using delta_t::Control;
using delta_t::Header;
using delta_t::RecordKind;
using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::DeltaTBench;
using testing::usual_header;

TEST_CASE("delta t: pings are given once each, as they come", "[drivers]") {
  DeltaTBench bench;
  for (std::uint32_t number = 1; number <= 20; ++number) {
    REQUIRE(bench.send_image(number));
    CHECK(bench.poll() == ReadStatus::kFresh);
    CHECK(bench.ping->captured == bench.now);  // without latencies its arrival is all that is known
    CHECK(bench.ping->echo[30 * 500 + 100] == 200);
    for (int i = 0; i < 9; ++i) {
      CHECK(bench.poll() == ReadStatus::kNothingNew);
    }
  }
  CHECK(bench.driver.counts().images == 20);
  CHECK(bench.driver.fault() == DeviceFault::kNone);
}

TEST_CASE("delta t: of several that wait the newest is given", "[drivers]") {
  DeltaTBench bench;
  for (std::uint32_t number = 1; number <= 4; ++number) {
    REQUIRE(bench.send_image(number));
  }
  REQUIRE(bench.poll() == ReadStatus::kFresh);
  CHECK(bench.ping->number == 4);
  CHECK(bench.poll() == ReadStatus::kNothingNew);
  CHECK(bench.driver.counts().overtaken == 3);
  CHECK(bench.driver.counts().order.lost == 0);
}

TEST_CASE("delta t: what waited while nobody polled is no news", "[drivers]") {
  DeltaTBench bench;
  REQUIRE(bench.send_image(1));
  CHECK(bench.poll(milliseconds{501}) == ReadStatus::kNothingNew);
  CHECK(bench.driver.counts().stale == 1);
  REQUIRE(bench.send_image(2));
  CHECK(bench.poll(milliseconds{499}) == ReadStatus::kFresh);
}

TEST_CASE("delta t: it is asked at each ping until the headers show it, then once a second",
          "[drivers]") {
  DeltaTSettings settings;
  settings.control.range_m = 10;
  DeltaTBench bench{settings};
  CHECK_FALSE(bench.asked());  // nobody is known yet
  Header h = usual_header(RecordKind::kImage, 1);
  for (; h.ping_number <= 5; ++h.ping_number) {
    REQUIRE(bench.send(testing::usual_image(h)));
    CHECK(bench.poll(milliseconds{100}) == ReadStatus::kFresh);  // it is used as it is
    CHECK(bench.ping->range_m == Approx(30.0).margin(1e-12));
    CHECK(bench.asked() == settings.control);
    CHECK(bench.asked_frames == 1);
  }
  CHECK_FALSE(bench.driver.is_as_asked());
  h.range_m = 10.0;
  int frames = 0;
  for (; h.ping_number <= 45; ++h.ping_number) {
    REQUIRE(bench.send(testing::usual_image(h)));
    CHECK(bench.poll(milliseconds{100}) == ReadStatus::kFresh);
    static_cast<void>(bench.asked());
    frames += bench.asked_frames;
  }
  CHECK(bench.driver.is_as_asked());
  CHECK(frames == 4);
  CHECK(bench.driver.fault() == DeviceFault::kNone);
}

TEST_CASE("delta t: in silence it is still asked, once a second", "[drivers]") {
  DeltaTBench bench;
  REQUIRE(bench.send_image(1));
  REQUIRE(bench.poll() == ReadStatus::kFresh);
  static_cast<void>(bench.asked());
  int frames = 0;
  for (int i = 0; i < 500; ++i) {
    CHECK(bench.poll() == ReadStatus::kNothingNew);
    static_cast<void>(bench.asked());
    frames += bench.asked_frames;
  }
  CHECK(frames == 5);
}

TEST_CASE("delta t: with control off nothing is ever sent", "[drivers]") {
  DeltaTSettings settings;
  settings.controls = false;
  settings.control.range_m = 10;
  DeltaTBench bench{settings};
  for (std::uint32_t number = 1; number <= 50; ++number) {
    REQUIRE(bench.send_image(number));
    CHECK(bench.poll(milliseconds{100}) == ReadStatus::kFresh);
  }
  CHECK_FALSE(bench.asked());
  CHECK(bench.driver.counts().control_frames == 0);
  CHECK(bench.driver.fault() == DeviceFault::kNone);
}

TEST_CASE("delta t: settings that are not taken are told after a while, and the pings used",
          "[drivers]") {
  DeltaTSettings settings;
  settings.control.range_m = 10;
  DeltaTBench bench{settings};
  std::uint32_t number = 1;
  for (; number <= 30; ++number) {
    REQUIRE(bench.send_image(number));
    CHECK(bench.poll(milliseconds{100}) == ReadStatus::kFresh);
    CHECK(bench.driver.fault() == DeviceFault::kNone);
  }
  for (; number <= 35; ++number) {
    REQUIRE(bench.send_image(number));
    CHECK(bench.poll(milliseconds{100}) == ReadStatus::kFresh);
  }
  CHECK(bench.driver.fault() == DeviceFault::kSettingRefused);
  Header h = usual_header(RecordKind::kImage, number);
  h.range_m = 10.0;
  REQUIRE(bench.send(testing::usual_image(h)));
  CHECK(bench.poll() == ReadStatus::kFresh);
  CHECK(bench.driver.fault() == DeviceFault::kNone);
}

TEST_CASE("delta t: silence is told, from the beginning and after pings", "[drivers]") {
  DeltaTBench bench;
  for (int i = 0; i < 300; ++i) {
    CHECK(bench.poll() == ReadStatus::kNothingNew);
    CHECK(bench.driver.fault() == DeviceFault::kNone);
  }
  bench.poll();
  CHECK(bench.driver.fault() == DeviceFault::kNoAnswer);
  Header h = usual_header(RecordKind::kImage, 1);
  h.repetition_s = 2.0;
  REQUIRE(bench.send(testing::usual_image(h)));
  CHECK(bench.poll() == ReadStatus::kFresh);
  for (int i = 0; i < 600; ++i) {
    CHECK(bench.driver.fault() == DeviceFault::kNone);
    bench.poll();
  }
  bench.poll();
  CHECK(bench.driver.fault() == DeviceFault::kNoAnswer);
}

TEST_CASE("delta t: a program that has gone is told, and it goes on when it is back", "[drivers]") {
  DeltaTBench bench;
  REQUIRE(bench.send_image(5000));
  CHECK(bench.poll() == ReadStatus::kFresh);
  bench.socket->unplug();
  CHECK(bench.poll() == ReadStatus::kDisconnected);
  CHECK(bench.driver.fault() == DeviceFault::kNobodyListens);
  bench.socket->plug();
  CHECK(bench.poll() == ReadStatus::kNothingNew);
  REQUIRE(bench.send_image(1));  // it counts anew
  CHECK(bench.poll() == ReadStatus::kFresh);
  CHECK(bench.driver.fault() == DeviceFault::kNone);
  CHECK(bench.driver.counts().order.restarts == 1);
}

TEST_CASE("delta t: C2: the wall clock and the device's own say nothing of a stamp", "[drivers]") {
  DeltaTBench bench;
  Header h = usual_header(RecordKind::kImage, 1);
  testing::set_text(h.date, "01-JAN-2099");
  h.ping_latency = milliseconds{5};
  h.data_latency = milliseconds{2};  // the data before the ping
  REQUIRE(bench.send(testing::usual_image(h)));
  REQUIRE(bench.poll() == ReadStatus::kFresh);
  CHECK(bench.ping->captured == bench.now);
  CHECK(bench.driver.counts().future_stamps == 1);
}

TEST_CASE("delta t: nothing is taken from the heap, whatever comes", "[drivers]") {
  DeltaTBench bench;
  const auto image = testing::usual_image(usual_header(RecordKind::kImage, 3));
  const auto profile = testing::usual_profile(usual_header(RecordKind::kProfile, 4));
  const testing::ByteList junk(300, 0x38);
  const testing::AllocationScope scope;
  int fresh = 0;
  for (const auto* bytes : {&image, &profile, &junk, &image}) {
    static_cast<void>(bench.socket->far_end().reply(*bytes));
    for (int i = 0; i < 200; ++i) {
      bench.now += milliseconds{10};
      fresh += bench.driver.poll(bench.now, *bench.ping) == ReadStatus::kFresh ? 1 : 0;
    }
  }
  const std::uint64_t taken_from_heap = scope.count();
  CHECK(taken_from_heap == 0);
  CHECK(fresh == 2);
}

}  // namespace
}  // namespace lodesman
