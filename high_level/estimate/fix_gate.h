// SPDX-License-Identifier: Apache-2.0
// Which fixes are believed. One that lies farther off than the covariance or the boat's own speed
// can explain is refused; where the fixes go on to say so, each agreeing with the one before, the
// estimate goes to them at a bounded rate. After a long gap none is believed alone. One thread;
// plain values, no allocation.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>

#include "mid_level/base/frames.h"
#include "mid_level/base/time.h"
#include "mid_level/messages/vehicle.h"

namespace lodesman {

struct FixGateOptions {
  double sigmas = 0.0;           // [-] > 0 of the innovation's covariance, and of the receiver
  double speed_m_s = 0.0;        // [m/s] > 0 what it may have gone that nobody foresaw, in a gap
  double sigma_least_m = 0.0;    // [m] > 0 no receiver is believed to be better
  double sigma_unknown_m = 0.0;  // [m] > 0 of a receiver that does not say
  Duration lasting{};            // > 0 refused for so long, fixes are approached ...
  double approach_m_s = 0.0;     // [m/s] > 0 ... at this rate
  Duration bridging{};           // > 0 a gap this long is said
  Duration longest_gap{};        // after it the position is lost
  double frozen_way_m = 0.0;     // [m] > 0 through the water without a digit changing: frozen
};

enum class FixVerdict : std::uint8_t {
  kBelieved,
  kFirst,      // the position begins here
  kApproach,   // lasting: the estimate goes a step towards it
  kRefused,    // too far off
  kAwaits,     // of another that agrees with it
  kFrozen,     // the same to the last digit though the boat is under way
  kUntimely,   // not later than the last one, older than what is remembered, or of the future
  kSenseless,  // not finite
};

class FixGate {
 public:
  explicit FixGate(const FixGateOptions& options) noexcept : options_{options} {}
  void begin_anew() noexcept { *this = FixGate{options_}; }
  // As one left it that was here before. Of fixes that were being refused it knows nothing.
  void resume(const EstimatorMemory& memory) noexcept;
  void remember(EstimatorMemory& memory) const noexcept;

  // A fix as it comes, before it is compared with anything.
  struct Look {
    WorldPoint position;
    double sigma_m = 0.0;
    Time measured{};
    double way_m = 0.0;  // through the water, ever
    Eigen::Vector2d innovation_m = Eigen::Vector2d::Zero();
    double mahalanobis_squared = 0.0;
  };
  [[nodiscard]] FixVerdict judge(const Look& look) noexcept;

  // A sigma that can be reckoned with.
  [[nodiscard]] double believable_sigma_m(double said_m) const noexcept;
  // How far the estimate may go towards the fix last judged as kApproach.
  [[nodiscard]] double approach_step_m() const noexcept { return approach_step_m_; }
  // What those fixes moved by against the estimate [m/s], where it is more than scatter: then it is
  // the velocity that is wrong, and not only the place. 0 else.
  [[nodiscard]] const Eigen::Vector2d& drift_m_s() const noexcept { return drift_m_s_; }
  [[nodiscard]] double drift_sigma_m_s() const noexcept { return drift_sigma_m_s_; }
  [[nodiscard]] Time last_measured() const noexcept { return last_measured_; }
  [[nodiscard]] Time last_believed() const noexcept { return last_believed_; }
  [[nodiscard]] bool knows_position(Time now) const noexcept {
    return begun_ && now - last_believed_ <= options_.longest_gap;
  }
  [[nodiscard]] PositionTrust trust(Time now) const noexcept;

 private:
  enum class Phase : std::uint8_t { kTracking, kApproaching };
  // Refused fixes that agree with each other.
  struct Run {
    std::size_t count = 0;
    Time began{};
    Time last{};
    Eigen::Vector2d innovation_m = Eigen::Vector2d::Zero();
    // Of the drift: since when, from where, and how much of the way was approached meanwhile.
    Time drift_since{};
    Eigen::Vector2d first_m = Eigen::Vector2d::Zero();
    Eigen::Vector2d approached_m = Eigen::Vector2d::Zero();
  };

  [[nodiscard]] bool is_frozen(const Look& look) noexcept;
  [[nodiscard]] bool within(const Look& look) const noexcept;
  [[nodiscard]] bool extends_run(const Look& look) noexcept;
  [[nodiscard]] FixVerdict judge_approached(const Look& look, Duration since) noexcept;
  [[nodiscard]] FixVerdict judge_refused(const Look& look) noexcept;
  void look_for_drift(const Look& look) noexcept;
  FixVerdict believe(const Look& look, FixVerdict verdict) noexcept;

  FixGateOptions options_;
  Phase phase_ = Phase::kTracking;
  bool begun_ = false;
  bool frozen_ = false;
  Time last_measured_{};
  Time last_believed_{};
  double last_sigma_m_ = 0.0;  // of the one that was believed
  std::size_t believed_ = 0;
  Run run_;
  double approach_step_m_ = 0.0;
  Eigen::Vector2d drift_m_s_ = Eigen::Vector2d::Zero();
  double drift_sigma_m_s_ = 0.0;
  WorldPoint same_;  // what the receiver says, and since when
  double same_since_way_m_ = 0.0;
};

}  // namespace lodesman
