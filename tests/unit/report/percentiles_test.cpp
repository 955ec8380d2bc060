// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/report/percentiles.h"

#include <limits>
#include <numeric>

#include "tests/support/catch.h"

using lodesman::cli::percentiles;

TEST_CASE("percentiles: of nothing are zeros", "[report]") {
  const auto p = percentiles({});
  CHECK(p.p50 == Approx(0.0));
  CHECK(p.p99 == Approx(0.0));
  CHECK(p.max == Approx(0.0));
}

TEST_CASE("percentiles: of one value are that value", "[report]") {
  const auto p = percentiles({7.5});
  CHECK(p.p50 == Approx(7.5));
  CHECK(p.p99 == Approx(7.5));
  CHECK(p.max == Approx(7.5));
}

TEST_CASE("percentiles: nearest rank takes a value that was measured, in any order", "[report]") {
  struct Row {
    int count;
    double p50, p99;
  };
  // Of 1 ... n: rank ceil(p n).
  for (const auto& [count, p50, p99] :
       {Row{2, 1, 2}, Row{3, 2, 3}, Row{100, 50, 99}, Row{101, 51, 100}, Row{1000, 500, 990}}) {
    std::vector<double> values(static_cast<std::size_t>(count));
    std::iota(values.rbegin(), values.rend(), 1.0);
    const auto p = percentiles(values);
    INFO(count);
    CHECK(p.p50 == Approx(p50));
    CHECK(p.p99 == Approx(p99));
    CHECK(p.max == Approx(count));
  }
}

TEST_CASE("percentiles: a value that is not finite is left out", "[report]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto p = percentiles({nan, 2.0, std::numeric_limits<double>::infinity(), 1.0});
  CHECK(p.p50 == Approx(1.0));
  CHECK(p.max == Approx(2.0));
}

TEST_CASE("percentiles: of more than can be kept the sample is near and its largest exact",
          "[report]") {
  cli::PercentileSample sample;
  std::vector<double> all;
  constexpr std::uint64_t kCount = 4 * cli::PercentileSample::kMost;
  for (std::uint64_t i = 0; i < kCount; ++i) {
    const double value = static_cast<double>(i * 7919 % kCount);
    sample.add(value);
    all.push_back(value);
    if (i == cli::PercentileSample::kMost - 1) {
      CHECK(sample.percentiles().p99 == Approx(cli::percentiles(all).p99).margin(0.0));
    }
  }
  const auto exact = cli::percentiles(all);
  const auto sampled = sample.percentiles();
  CHECK(sampled.p50 == Approx(exact.p50).epsilon(0.02));
  CHECK(sampled.p99 == Approx(exact.p99).epsilon(0.01));
  CHECK(sampled.max == Approx(exact.max).margin(0.0));
  CHECK(cli::PercentileSample{}.percentiles().max == Approx(0.0).margin(0.0));
}
