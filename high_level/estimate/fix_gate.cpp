// SPDX-License-Identifier: Apache-2.0
#include "high_level/estimate/fix_gate.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lodesman {
namespace {

constexpr double kSameDigits_m = 1e-6;  // two fixes nearer than this are the same text
constexpr Duration kRunBreaks = std::chrono::seconds{3};  // fixes farther apart confirm nothing
constexpr std::size_t kRunLeast = 3;                      // of them make a run
constexpr std::size_t kSettled = 3;    // fixes believed before a position is one to stay with
constexpr double kRunSpeed_m_s = 3.0;  // no model is wrong by more
// A drift is one that is more than its scatter and more than a current that the filter will learn.
constexpr double kDriftSigmas = 3.0;
constexpr double kDriftLeast_m_s = 0.1;
// An approach is over where the fix lies within what its own scatter explains.
constexpr double kArrivedSigmas = 2.0;

}  // namespace

double FixGate::believable_sigma_m(double said_m) const noexcept {
  return said_m > 0.0 ? std::max(said_m, options_.sigma_least_m) : options_.sigma_unknown_m;
}

void FixGate::resume(const EstimatorMemory& memory) noexcept {
  begin_anew();
  begun_ = memory.fix_believed != Time{};
  last_measured_ = memory.fix_last;
  last_believed_ = memory.fix_believed;
  last_sigma_m_ = memory.fix_sigma_m;
  believed_ = memory.fixes_believed;
}

void FixGate::remember(EstimatorMemory& memory) const noexcept {
  memory.fix_last = last_measured_;
  memory.fix_believed = last_believed_;
  memory.fix_sigma_m = last_sigma_m_;
  memory.fixes_believed = believed_;
}

FixVerdict FixGate::judge(const Look& look) noexcept {
  const Duration since = look.measured - last_measured_;
  if (begun_ && since <= Duration::zero()) {
    return FixVerdict::kUntimely;
  }
  const bool frozen = is_frozen(look);
  last_measured_ = look.measured;
  if (frozen) {
    return FixVerdict::kFrozen;
  }
  if (!begun_) {
    begun_ = true;
    return believe(look, FixVerdict::kFirst);
  }
  if (phase_ == Phase::kApproaching) {
    return judge_approached(look, since);
  }
  const bool alone = look.measured - last_believed_ > options_.longest_gap;
  if (!within(look)) {
    return judge_refused(look);
  }
  if (alone && !extends_run(look)) {
    return FixVerdict::kAwaits;
  }
  return believe(look, FixVerdict::kBelieved);
}

// Scatter alone changes the last digits, so that the same text again and again was not measured.
bool FixGate::is_frozen(const Look& look) noexcept {
  if (!begun_ || (look.position.xy_m - same_.xy_m).cwiseAbs().maxCoeff() > kSameDigits_m) {
    same_ = look.position;
    same_since_way_m_ = look.way_m;
  }
  frozen_ = look.way_m - same_since_way_m_ > options_.frozen_way_m;
  return frozen_;
}

bool FixGate::within(const Look& look) const noexcept {
  const double gap_s = to_seconds(look.measured - last_believed_);
  const double explained_m =
      options_.speed_m_s * gap_s + options_.sigmas * std::hypot(look.sigma_m, last_sigma_m_);
  return look.mahalanobis_squared <= options_.sigmas * options_.sigmas &&
         look.innovation_m.norm() <= explained_m;
}

// Whether the fix agrees with the refused ones before it; it is one of them from here on.
bool FixGate::extends_run(const Look& look) noexcept {
  const double gap_s = to_seconds(look.measured - run_.last);
  const double explained_m =
      kRunSpeed_m_s * gap_s + options_.sigmas * std::numbers::sqrt2 * look.sigma_m;
  const bool agrees = run_.count > 0 && look.measured - run_.last <= kRunBreaks &&
                      (look.innovation_m - run_.innovation_m).norm() <= explained_m;
  if (!agrees) {
    run_ = {};
    run_.began = look.measured;
    run_.drift_since = look.measured;
    run_.first_m = look.innovation_m;
  }
  ++run_.count;
  run_.last = look.measured;
  run_.innovation_m = look.innovation_m;
  return agrees;
}

FixVerdict FixGate::judge_refused(const Look& look) noexcept {
  const bool lost = look.measured - last_believed_ > options_.longest_gap;
  if (!extends_run(look) || run_.count < kRunLeast) {
    return FixVerdict::kRefused;
  }
  if (lost || believed_ < kSettled) {
    return believe(look, FixVerdict::kFirst);  // there is no position yet, or no more, to jump from
  }
  if (look.measured - run_.began < options_.lasting) {
    return FixVerdict::kRefused;
  }
  phase_ = Phase::kApproaching;
  last_believed_ = look.measured;
  approach_step_m_ = 0.0;
  look_for_drift(look);
  return FixVerdict::kApproach;
}

FixVerdict FixGate::judge_approached(const Look& look, Duration since) noexcept {
  const Run before = run_;
  if (!extends_run(look)) {
    if (look.measured - before.last > kRunBreaks) {
      phase_ = Phase::kTracking;
    } else {
      run_ = before;
    }
    return FixVerdict::kRefused;
  }
  last_believed_ = look.measured;
  const double gap_s = std::min(to_seconds(since), 1.0);
  approach_step_m_ = options_.approach_m_s * gap_s;
  look_for_drift(look);
  if (look.innovation_m.norm() <= kArrivedSigmas * look.sigma_m + approach_step_m_) {
    phase_ = Phase::kTracking;
    (void)believe(look, FixVerdict::kApproach);
  } else {
    // What comes next is that much nearer.
    const Eigen::Vector2d step_m =
        std::min(1.0, approach_step_m_ / look.innovation_m.norm()) * look.innovation_m;
    run_.innovation_m -= step_m;
    run_.approached_m += step_m;
  }
  return FixVerdict::kApproach;
}

// An offset that grows is no leap of the receiver: boat or water are faster than is believed.
void FixGate::look_for_drift(const Look& look) noexcept {
  drift_m_s_.setZero();
  const Duration since = look.measured - run_.drift_since;
  if (since < options_.lasting) {
    return;
  }
  const Eigen::Vector2d moved_m = look.innovation_m + run_.approached_m - run_.first_m;
  const Eigen::Vector2d drift_m_s = moved_m / to_seconds(since);
  drift_sigma_m_s_ = std::numbers::sqrt2 * look.sigma_m / to_seconds(since);
  if (drift_m_s.norm() > kDriftSigmas * drift_sigma_m_s_ + kDriftLeast_m_s) {
    drift_m_s_ = drift_m_s;
    run_.drift_since = look.measured;
    run_.first_m = look.innovation_m;
    run_.approached_m.setZero();
  }
}

FixVerdict FixGate::believe(const Look& look, FixVerdict verdict) noexcept {
  last_believed_ = look.measured;
  last_sigma_m_ = look.sigma_m;
  ++believed_;
  run_ = {};
  return verdict;
}

PositionTrust FixGate::trust(Time now) const noexcept {
  if (!knows_position(now)) {
    return PositionTrust::kLost;
  }
  if (frozen_) {
    return PositionTrust::kFrozen;
  }
  if (phase_ == Phase::kApproaching) {
    return PositionTrust::kApproaching;
  }
  return now - last_believed_ > options_.bridging ? PositionTrust::kBridged
                                                  : PositionTrust::kTracked;
}

}  // namespace lodesman
