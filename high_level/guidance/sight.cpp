// SPDX-License-Identifier: Apache-2.0
#include "high_level/guidance/sight.h"

#include <algorithm>

namespace lodesman {
namespace {

constexpr int kIntervals = 3;  // without a frame are too many
constexpr Duration kLateAfter_min = std::chrono::milliseconds{500};

}  // namespace

Sight SightWatch::look(Time now, Time frame) noexcept {
  if (frame != frame_) {
    const bool follows = frame_ != Time{} && frame - frame_ < lost_after_;
    interval_ = follows ? frame - frame_ : Duration{};
    frame_ = frame;
  }
  const Duration age = now - frame;
  if (age > lost_after_) {
    return Sight::kLost;
  }
  const Duration late_after =
      std::min(std::max(kLateAfter_min, kIntervals * interval_), lost_after_ / 2);
  return age > late_after ? Sight::kLate : Sight::kNew;
}

}  // namespace lodesman
