// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/report/percentiles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace lodesman::cli {

Percentiles percentiles(std::vector<double> values) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (values.empty()) {
    return {};
  }
  std::sort(values.begin(), values.end());
  // In integers: 0.99 is no double, and the rank is a ceiling.
  const auto at_percent = [&](std::size_t percent) {
    return values[(percent * values.size() + 99) / 100 - 1];
  };
  return {.p50 = at_percent(50), .p99 = at_percent(99), .max = values.back()};
}

void PercentileSample::add(double value) {
  if (!std::isfinite(value)) {
    return;
  }
  largest_ = count_ == 0 ? value : std::max(largest_, value);
  ++count_;
  if (values_.size() < kMost) {
    values_.push_back(value);
  } else if (const std::uint64_t place = random_() % count_; place < kMost) {
    values_[place] = value;
  }
}

Percentiles PercentileSample::percentiles() const {
  Percentiles result = cli::percentiles(values_);
  result.max = largest_;
  return result;
}

}  // namespace lodesman::cli
