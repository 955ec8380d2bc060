// SPDX-License-Identifier: Apache-2.0
#include "high_level/estimate/origin_search.h"

#include <cmath>
#include <numbers>

namespace lodesman {
namespace {

constexpr double kSigmas = 3.0;
constexpr double kBoat_m_s = 3.0;  // it may drift, or be towed, while it waits

}  // namespace

bool OriginSearch::take(const PositionFix& fix) noexcept {
  const double sigma_m = fix.sigma_m > 0.0 ? fix.sigma_m : options_.sigma_unknown_m;
  const GeoPoint place{fix.latitude_deg, fix.longitude_deg};
  if (!(sigma_m <= options_.sigma_max_m) || !(std::abs(place.latitude_deg) <= kLatitudeMost_deg) ||
      !(std::abs(place.longitude_deg) <= 180.0)) {
    in_a_row_ = 0;
    return false;
  }
  if (in_a_row_ > 0 && fix.measured <= last_measured_) {
    return false;
  }
  in_a_row_ = agrees(place, sigma_m, fix.measured) ? in_a_row_ + 1 : 1;
  last_ = place;
  last_measured_ = fix.measured;
  return in_a_row_ >= kAgreeing;
}

bool OriginSearch::agrees(GeoPoint place, double sigma_m, Time measured) const noexcept {
  const Duration since = measured - last_measured_;
  return in_a_row_ > 0 && since <= kRunBreaks &&
         rough_distance_m(last_, place) <=
             kBoat_m_s * to_seconds(since) + kSigmas * std::numbers::sqrt2 * sigma_m;
}

}  // namespace lodesman
