// SPDX-License-Identifier: Apache-2.0
// What result.json says of many measurements in three numbers. A pure function and a plain value;
// any one thread.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "deploy/operator/report/run_record.h"

namespace lodesman::cli {

// Nearest rank: always one of the values. Not finite values are left out; zeros when none is left.
[[nodiscard]] Percentiles percentiles(std::vector<double> values);

// The same of however many values in bounded memory: exact up to kMost of them, from then on those
// of kMost that chance has left (the same at every run); the largest is always exact.
class PercentileSample {
 public:
  static constexpr std::size_t kMost = 65536;

  void add(double value);
  [[nodiscard]] Percentiles percentiles() const;

 private:
  std::vector<double> values_;
  std::uint64_t count_ = 0;
  double largest_ = 0.0;
  std::mt19937_64 random_{1};
};

}  // namespace lodesman::cli
