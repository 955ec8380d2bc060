// SPDX-License-Identifier: Apache-2.0
#include "drivers/hal/fix_stamp.h"

#include <algorithm>

namespace lodesman {
namespace {

constexpr Duration kDay = std::chrono::hours{24};
// Between the satellites' clock and ours: 100 ppm at the most.
constexpr std::int64_t kDriftPart = 10000;

}  // namespace

Duration FixStamp::step_between(Duration from, Duration to) noexcept {
  const Duration step = (to - from) % kDay;
  return step > kDay / 2 ? step - kDay : step <= -kDay / 2 ? step + kDay : step;
}

FixStamp::Judged FixStamp::judge(Duration time_of_day, Time arrived) noexcept {
  if (!has_begun_) {
    return begin(time_of_day, arrived);
  }
  const Duration step = step_between(time_of_day_, time_of_day);
  if (step < Duration::zero()) {
    return go_back(time_of_day, arrived);
  }
  consistent_ = 0;
  if (step == Duration::zero()) {
    return {Verdict::kSame, {}};
  }
  const Time measured = carried_on(step, arrived);
  time_of_day_ = time_of_day;
  if (measured <= measured_) {
    return {Verdict::kSame, {}};
  }
  measured_ = measured;
  return {Verdict::kNew, measured};
}

FixStamp::Judged FixStamp::begin(Duration time_of_day, Time arrived) noexcept {
  has_begun_ = true;
  consistent_ = 0;
  late_since_ = {};
  time_of_day_ = time_of_day;
  if (arrived <= measured_) {
    return {Verdict::kSame, {}};
  }
  measured_ = arrived;
  return {Verdict::kNew, arrived};
}

FixStamp::Judged FixStamp::go_back(Duration time_of_day, Time arrived) noexcept {
  const bool follows = consistent_ > 0 && step_between(candidate_, time_of_day) > Duration::zero();
  consistent_ = follows ? consistent_ + 1 : 1;
  candidate_ = time_of_day;
  return consistent_ >= kConsistent ? begin(time_of_day, arrived) : Judged{Verdict::kOld, {}};
}

Time FixStamp::carried_on(Duration step, Time arrived) noexcept {
  const Time measured = std::min(measured_ + step + step / kDriftPart, arrived);
  const Duration late = arrived - measured;
  if (late <= kLate) {
    late_since_ = {};
    return measured;
  }
  if (late_since_ == Time{}) {
    late_since_ = arrived;
    least_late_ = late;
  }
  least_late_ = std::min(least_late_, late);
  if (arrived - late_since_ < kLateFor) {
    return measured;
  }
  late_since_ = {};
  return measured + least_late_;
}

}  // namespace lodesman
