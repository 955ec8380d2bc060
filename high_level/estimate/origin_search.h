// SPDX-License-Identifier: Apache-2.0
// Which of a receiver's first fixes is good enough to be the origin of the world: the last of a few
// in a row that are accurate by their own word and agree with each other. A receiver's very first
// fixes are its worst, and an origin stays. One thread; plain values, no allocation.
#pragma once

#include "mid_level/base/geodesy.h"
#include "mid_level/base/time.h"
#include "mid_level/messages/vehicle.h"

namespace lodesman {

struct OriginSearchOptions {
  double sigma_max_m = 0.0;      // [m] > 0 no fix of more is one of them
  double sigma_unknown_m = 0.0;  // [m] > 0 of a receiver that does not say
};

class OriginSearch {
 public:
  static constexpr int kAgreeing = 3;
  static constexpr Duration kRunBreaks = std::chrono::seconds{3};  // fixes farther apart
  static constexpr double kLatitudeMost_deg = 85.0;  // nearer to a pole east has no meaning

  explicit OriginSearch(const OriginSearchOptions& options) noexcept : options_{options} {}

  // Takes the next fix; whether it is the one.
  [[nodiscard]] bool take(const PositionFix& fix) noexcept;

 private:
  [[nodiscard]] bool agrees(GeoPoint place, double sigma_m, Time measured) const noexcept;

  OriginSearchOptions options_;
  int in_a_row_ = 0;
  GeoPoint last_;
  Time last_measured_{};
};

}  // namespace lodesman
