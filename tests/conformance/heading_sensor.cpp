// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "tests/conformance/driver_bench.h"
#include "tests/conformance/sensor_suite.h"

namespace lodesman::conformance {
namespace {

using HeadingSensors = std::tuple<SimHeadingBench, Nav440Bench>;

constexpr auto kPoll = [](auto& bench) {
  const auto reading = bench.device().poll(bench.now());
  return Polled{reading.status, reading.sample.measured};
};

TEMPLATE_LIST_TEST_CASE("heading sensor: each sample is given once", "[conformance]",
                        HeadingSensors) {
  gives_each_sample_once<TestType>(kPoll);
}

TEMPLATE_LIST_TEST_CASE("heading sensor: samples come at its rate, in order, none of the future",
                        "[conformance]", HeadingSensors) {
  brings_samples_at_its_rate<TestType>(kPoll);
}

TEMPLATE_LIST_TEST_CASE("heading sensor: faults show as they must, and it recovers",
                        "[conformance]", HeadingSensors) {
  fails_as_it_must_and_recovers<TestType>(kPoll);
}

TEMPLATE_LIST_TEST_CASE("heading sensor: nothing is taken from the heap, whatever happens",
                        "[conformance]", HeadingSensors) {
  polls_without_the_heap<TestType>(kPoll);
}

TEMPLATE_LIST_TEST_CASE("heading sensor: values are finite and in range", "[conformance]",
                        HeadingSensors) {
  TestType bench;
  bench.come_up();
  int fresh = 0;
  for (int i = 0; i < 200; ++i) {
    bench.pass(TestType::period());
    const auto reading = bench.device().poll(bench.now());
    if (reading.status == ReadStatus::kFresh) {
      ++fresh;
      CHECK(std::abs(reading.sample.heading_rad) <= std::numbers::pi);
      CHECK(std::abs(reading.sample.yaw_rate_rad_s) <= 11.0);  // 630 degrees a second
    }
  }
  CHECK(fresh > 150);
}

}  // namespace
}  // namespace lodesman::conformance
