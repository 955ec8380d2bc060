// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "tests/conformance/receiver_bench.h"
#include "tests/conformance/sensor_suite.h"

namespace lodesman::conformance {
namespace {

using PositionSensors = std::tuple<SimPositionBench, NmeaBench, GpsdBench>;

constexpr auto kPoll = [](auto& bench) {
  const auto reading = bench.device().poll(bench.now());
  return Polled{reading.status, reading.sample.measured};
};

TEMPLATE_LIST_TEST_CASE("position sensor: each fix is given once", "[conformance]",
                        PositionSensors) {
  gives_each_sample_once<TestType>(kPoll);
}

TEMPLATE_LIST_TEST_CASE("position sensor: fixes come at its rate, in order, none of the future",
                        "[conformance]", PositionSensors) {
  brings_samples_at_its_rate<TestType>(kPoll);
}

TEMPLATE_LIST_TEST_CASE("position sensor: faults show as they must, and it recovers",
                        "[conformance]", PositionSensors) {
  fails_as_it_must_and_recovers<TestType>(kPoll);
}

TEMPLATE_LIST_TEST_CASE("position sensor: nothing is taken from the heap, whatever happens",
                        "[conformance]", PositionSensors) {
  polls_without_the_heap<TestType>(kPoll);
}

TEMPLATE_LIST_TEST_CASE("position sensor: values are finite and in range", "[conformance]",
                        PositionSensors) {
  TestType bench;
  bench.come_up();
  int fresh = 0;
  for (int i = 0; i < 200; ++i) {
    bench.pass(TestType::period());
    const auto reading = bench.device().poll(bench.now());
    if (reading.status == ReadStatus::kFresh) {
      ++fresh;
      CHECK(std::abs(reading.sample.latitude_deg) <= 90.0);
      CHECK(std::abs(reading.sample.longitude_deg) <= 180.0);
      CHECK(reading.sample.sigma_m >= 0.0);
      CHECK(std::isfinite(reading.sample.sigma_m));
    }
  }
  CHECK(fresh > 150);
}

}  // namespace
}  // namespace lodesman::conformance
