// SPDX-License-Identifier: Apache-2.0
#include "high_level/mission/progress_watch.h"

#include <algorithm>
#include <cmath>

namespace lodesman {
namespace {

// The water carries it where it has gone by this share of its way through the water, but not along.
constexpr double kDriftShare = 0.25;

}  // namespace

double least_way_m(const ProgressWatchOptions& options, double speed_m_s) noexcept {
  constexpr double kMost_m = 0.5;
  constexpr double kShare = 0.25;
  return std::min(kMost_m, kShare * speed_m_s * to_seconds(options.patience));
}

void ProgressWatch::start(Time now) noexcept { begin_anew(now, {}); }

NoWayCause ProgressWatch::update(Time now, const ProgressSample& sample) noexcept {
  // The time that it stood by decision is none in which it did not get on.
  const bool stood = stands_;
  stands_ = sample.cause == NoWayCause::kNoSonar;
  if (!sample.wanted || (stood && !stands_)) {
    begin_anew(now, sample);
    return NoWayCause::kNone;
  }
  if (sample.position && last_position_) {
    made_good_m_ += sample.course.dot(sample.position->xy_m - last_position_->xy_m);
    through_water_m_ += std::abs(sample.through_water_m_s) * to_seconds(now - last_);
  }
  // Where a lost position is found again it has not been carried to since.
  began_at_ = began_at_ && sample.position ? began_at_ : sample.position;
  last_position_ = sample.position;
  last_ = now;
  if (made_good_m_ >= options_.least_way_m) {
    begin_anew(now, sample);
    return NoWayCause::kNone;
  }
  const Duration time = now - since_;
  return time >= options_.patience ? cause_of(sample, time) : NoWayCause::kNone;
}

NoWayCause ProgressWatch::cause_of(const ProgressSample& sample, Duration time) const noexcept {
  if (sample.cause != NoWayCause::kUnknown || !sample.position || !began_at_) {
    return sample.cause;
  }
  const double moved_m = (sample.position->xy_m - began_at_->xy_m).norm();
  const bool drifts = time > Duration::zero() && moved_m > options_.least_way_m &&
                      moved_m > kDriftShare * through_water_m_;
  return drifts ? NoWayCause::kCurrent : NoWayCause::kUnknown;
}

void ProgressWatch::begin_anew(Time now, const ProgressSample& sample) noexcept {
  since_ = now;
  last_ = now;
  made_good_m_ = 0.0;
  through_water_m_ = 0.0;
  began_at_ = sample.position;
  last_position_ = sample.position;
}

}  // namespace lodesman
