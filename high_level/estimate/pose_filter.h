// SPDX-License-Identifier: Apache-2.0
// Where the boat is, how it moves and how the water moves, with covariance: an extended Kalman
// filter over the one vehicle model, driven by the thrust that was applied, heading and yaw rate,
// and fixes that may come late. (Jazwinski, Stochastic Processes and Filtering Theory, ch. 8;
// updates in Joseph's form, Bucy and Joseph 1968.)
//
// A late fix is applied where it was measured, and what came after it is filtered again from the
// inputs of the last seconds. A fix is believed only within a gate that is bounded both by the
// covariance and by what the boat can have gone since the last one that was believed: a covariance
// that has grown lets nothing through on its own. What is refused for a while, one fix agreeing
// with the next, is approached at a bounded rate. The odometry pose integrates velocities alone: it
// has kinks where a fix comes, never a jump.
//
// Owned by one thread; it allocates nothing. What is not finite, out of order or
// of the future is refused.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "high_level/estimate/fix_gate.h"
#include "high_level/estimate/vehicle_model.h"
#include "mid_level/base/time.h"
#include "mid_level/messages/vehicle.h"

namespace lodesman {

// What the model does not know, as white noise of accelerations, and what the sensors scatter by.
struct PoseFilterOptions {
  VehicleModelParameters vehicle;
  SpeedTable speeds = SpeedTable::proportional(1.0);
  double surge_noise_m_s_per_sqrt_s = 0.0;    // > 0
  double sway_noise_m_s_per_sqrt_s = 0.0;     // > 0
  double yaw_noise_rad_s_per_sqrt_s = 0.0;    // > 0
  double current_noise_m_s_per_sqrt_s = 0.0;  // > 0 how fast a current may change
  double current_sigma_m_s = 0.0;             // > 0 before anything is known of it
  double heading_sigma_rad = 0.0;             // > 0 of a sample of the AHRS
  double yaw_rate_sigma_rad_s = 0.0;          // > 0
  FixGateOptions gate;
};

class PoseFilter {
 public:
  static constexpr int kStates = 8;
  // East, north [m] [world]; heading [rad]; surge, sway [m/s]; yaw rate [rad/s] through the water;
  // current [m/s] [world].
  enum State { kX, kY, kHeading, kSurge, kSway, kYawRate, kCurrentX, kCurrentY };
  using Vector = Eigen::Matrix<double, kStates, 1>;
  using Matrix = Eigen::Matrix<double, kStates, kStates>;

  explicit PoseFilter(const PoseFilterOptions& options) noexcept;

  // As if nothing had ever come.
  void begin_anew() noexcept;

  // Moves on to `now` under the references that were applied since the last call, and takes the
  // heading, where it is a new one. After kLongestStep without a call it begins anew.
  void advance(Time now, int surge_ref, int head_ref, const Attitude& attitude) noexcept;
  static constexpr Duration kLongestStep = std::chrono::seconds{2};
  // The same without a heading. Where nobody knows what was applied, speed is doubted the more.
  void coast(Time now, int surge_ref, int head_ref, bool thrust_is_known) noexcept;

  // Goes on as one that died, from what it remembered; false where that is no estimate: then
  // nothing has changed.
  [[nodiscard]] bool resume(const EstimatorMemory& memory) noexcept;
  void remember(EstimatorMemory& memory) const noexcept;

  // A position [world] that was measured then, no later than the last `advance`; sigma_m: one
  // standard deviation of each axis, 0: unknown. Says what became of it.
  FixVerdict fix(const WorldPoint& position, double sigma_m, Time measured) noexcept;

  [[nodiscard]] bool has_begun() const noexcept { return count_ > 0; }
  // Where it has begun: the time that it has been moved on to, and of its last heading.
  [[nodiscard]] Time advanced_to() const noexcept { return newest().at; }
  [[nodiscard]] Time heading_of() const noexcept { return heading_of_; }
  // Whether there is a pose: the last believed fix is no older than the gate's longest gap.
  [[nodiscard]] bool knows_position() const noexcept;
  // The pose as of the last `advance`; its sway, covariance and both poses included.
  [[nodiscard]] VehicleState state() const noexcept;

  [[nodiscard]] const Vector& mean() const noexcept { return newest().mean; }
  [[nodiscard]] const Matrix& covariance() const noexcept { return newest().covariance; }
  // Of the last fix that was believed, by its own covariance: chi squared of two degrees of
  // freedom.
  [[nodiscard]] double normalised_innovation_squared() const noexcept { return nis_; }

 private:
  // One call of advance, so that it can be done again.
  struct Entry {
    Time at{};
    Vector mean = Vector::Zero();
    Matrix covariance = Matrix::Identity();
    ThrustForces forces;       // since the entry before
    double doubt_m2_s2 = 0.0;  // of the surge, beside the noise
    bool has_heading = false;  // measured at this time:
    double heading_rad = 0.0;
    double yaw_rate_rad_s = 0.0;
  };
  static constexpr std::size_t kHistory = 192;  // 2.7 s of steps 14 ms apart

  [[nodiscard]] Entry& entry(std::size_t number) noexcept { return history_[number % kHistory]; }
  [[nodiscard]] const Entry& entry(std::size_t number) const noexcept {
    return history_[number % kHistory];
  }
  [[nodiscard]] const Entry& newest() const noexcept { return entry(count_ - 1); }
  [[nodiscard]] std::size_t oldest() const noexcept {
    return count_ > kHistory ? count_ - kHistory : 0;
  }

  void set_out(Time now, const Attitude& attitude) noexcept;
  void predict(Vector& mean, Matrix& covariance, const ThrustForces& forces,
               double dt_s) const noexcept;
  void take_heading(const Entry& measured, Vector& mean, Matrix& covariance) const noexcept;
  void add(Entry& next) noexcept;
  // Both of the above, from one entry to the next.
  void carry_on(const Entry& from, Entry& to) const noexcept;
  void filter_again(std::size_t from) noexcept;
  [[nodiscard]] std::size_t entry_before(Time measured) const noexcept;
  void believe(Entry& then, const Eigen::Vector2d& innovation_m, double sigma_m) noexcept;
  void place(Entry& then, const WorldPoint& position, double sigma_m) noexcept;
  void approach(Entry& then, const Eigen::Vector2d& innovation_m, double sigma_m) noexcept;

  PoseFilterOptions options_;
  VehicleModel model_;
  FixGate gate_;
  std::array<Entry, kHistory> history_{};  // 150 KB
  std::size_t count_ = 0;                  // entries ever made
  Time heading_of_{};                      // when the last heading was measured
  WorldPoint odometry_;
  bool aligned_ = false;  // with the world, once: where the first fix was believed
  double way_m_ = 0.0;    // through the water, ever
  double nis_ = 0.0;
};

}  // namespace lodesman
