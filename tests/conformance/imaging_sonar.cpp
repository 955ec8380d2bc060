// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <memory>
#include <numbers>

#include "mid_level/messages/sane.h"
#include "tests/conformance/delta_t_bench.h"
#include "tests/conformance/sensor_suite.h"

namespace lodesman::conformance {
namespace {

using ImagingSonars = std::tuple<SimSonarBench, SimDetectionsBench, DeltaTBench>;

constexpr auto kPoll = [](auto& bench) {
  static const auto kPing = std::make_unique<SonarPing>();
  const ReadStatus status = bench.device().poll(bench.now(), *kPing);
  return Polled{status, kPing->captured};
};

TEMPLATE_LIST_TEST_CASE("imaging sonar: each ping is given once", "[conformance]", ImagingSonars) {
  gives_each_sample_once<TestType>(kPoll);
}

TEMPLATE_LIST_TEST_CASE("imaging sonar: pings come at its rate, in order, none of the future",
                        "[conformance]", ImagingSonars) {
  brings_samples_at_its_rate<TestType>(kPoll);
}

TEMPLATE_LIST_TEST_CASE("imaging sonar: faults show as they must, and it recovers", "[conformance]",
                        ImagingSonars) {
  fails_as_it_must_and_recovers<TestType>(kPoll);
}

TEMPLATE_LIST_TEST_CASE("imaging sonar: nothing is taken from the heap, whatever happens",
                        "[conformance]", ImagingSonars) {
  polls_without_the_heap<TestType>(kPoll);
}

TEMPLATE_LIST_TEST_CASE("imaging sonar: the buffer is touched by a fresh ping alone",
                        "[conformance]", ImagingSonars) {
  TestType bench;
  bench.come_up();
  bench.pass(2 * TestType::period());
  const auto ping = std::make_unique<SonarPing>();
  for (const bool broken : {false, true}) {
    if (broken) {
      bench.fail(BenchFault::kCorrupt);
    }
    int untouched = 0;
    for (int i = 0; i < 40; ++i) {
      ping->number = 123456789;
      ping->beams = 77;
      ping->echo.fill(0xA5);
      const ReadStatus status = bench.device().poll(bench.now(), *ping);
      if (status == ReadStatus::kFresh) {
        CHECK(ping->beams != 77);
      } else {
        CHECK(ping->number == 123456789);
        CHECK(ping->beams == 77);
        CHECK(std::all_of(ping->echo.begin(), ping->echo.end(),
                          [](std::uint8_t echo) { return echo == 0xA5; }));
        ++untouched;
      }
      bench.pass(TestType::period() / 4);
    }
    CHECK(untouched > 20);
  }
}

TEMPLATE_LIST_TEST_CASE("imaging sonar: numbers rise, sizes agree, values are in range",
                        "[conformance]", ImagingSonars) {
  TestType bench;
  bench.come_up();
  const auto ping = std::make_unique<SonarPing>();
  std::uint64_t last = 0;
  int fresh = 0;
  for (int i = 0; i < 400; ++i) {
    bench.pass(TestType::period() / 4);
    if (bench.device().poll(bench.now(), *ping) != ReadStatus::kFresh) {
      continue;
    }
    ++fresh;
    CHECK(ping->number > last);
    last = ping->number;
    CHECK(ping->range_m > 0.0);
    CHECK(ping->range_m <= 300.0);
    CHECK(ping->sector_rad > 0.0);
    CHECK(ping->sector_rad <= std::numbers::pi);
    CHECK(ping->beams >= 1);
    CHECK(ping->beams <= kMaxBeams);
    CHECK(ping->bins >= (ping->kind == PingKind::kImage ? 1U : 0U));
    CHECK(ping->bins <= kMaxBins);
    CHECK(ping->fits());
    CHECK(sane(*ping));
  }
  CHECK(fresh > 50);
}

}  // namespace
}  // namespace lodesman::conformance
