// SPDX-License-Identifier: Apache-2.0
#include "mid_level/base/speed_table.h"

#include <algorithm>
#include <cmath>

#include "mid_level/base/check.h"
#include "mid_level/base/short_number.h"

namespace lodesman {

SpeedTable::SpeedTable(std::span<const SpeedPoint> points) : count_{points.size()} {
  LODESMAN_CHECK(!points.empty() && points.size() <= kMaxPoints);
  SpeedPoint before;
  for (const SpeedPoint& point : points) {
    LODESMAN_CHECK(point.surge_ref > before.surge_ref && point.speed_m_s > before.speed_m_s);
    before = point;
  }
  std::copy(points.begin(), points.end(), points_.begin());
}

SpeedTable SpeedTable::proportional(double k_m_s) {
  const SpeedPoint full{kMaxSurgeRef, k_m_s * kMaxSurgeRef};
  return SpeedTable{{&full, 1}};
}

double SpeedTable::speed_m_s(int surge_ref) const noexcept {
  const double size = std::abs(surge_ref);
  const auto* end = points_.begin() + count_;
  const auto* next = std::find_if(points_.begin(), end,
                                  [size](const SpeedPoint& p) { return p.surge_ref >= size; });
  double speed_m_s = 0.0;
  if (next == end) {
    const SpeedPoint& last = points_[count_ - 1];
    speed_m_s = last.speed_m_s * size / last.surge_ref;
  } else {
    const SpeedPoint before = next == points_.begin() ? SpeedPoint{} : *(next - 1);
    const double share = (size - before.surge_ref) / (next->surge_ref - before.surge_ref);
    speed_m_s = std::lerp(before.speed_m_s, next->speed_m_s, share);
  }
  return std::copysign(speed_m_s, surge_ref);
}

HeldSpeed SpeedTable::held(double wanted_m_s) const noexcept {
  HeldSpeed best{1, speed_m_s(1)};
  for (int surge_ref = 2; surge_ref <= kMaxSurgeRef; ++surge_ref) {
    const double speed = speed_m_s(surge_ref);
    if (std::abs(speed - wanted_m_s) < std::abs(best.speed_m_s - wanted_m_s)) {
      best = {surge_ref, speed};
    }
  }
  return best;
}

std::string SpeedTable::objection(double wanted_m_s) const {
  const HeldSpeed nearest = held(wanted_m_s);
  if (std::abs(nearest.speed_m_s - wanted_m_s) <= kSpeedTolerance * wanted_m_s) {
    return "";
  }
  return "no SurgeRef holds it within 3 % (the nearest, " + std::to_string(nearest.surge_ref) +
         ", gives " + short_number(nearest.speed_m_s) + " m/s)";
}

HeldSpeed SpeedTable::held_at_most(double limit_m_s) const noexcept {
  int surge_ref = 1;
  while (surge_ref < kMaxSurgeRef && speed_m_s(surge_ref + 1) <= limit_m_s) {
    ++surge_ref;
  }
  return {surge_ref, speed_m_s(surge_ref)};
}

}  // namespace lodesman
