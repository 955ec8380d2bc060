// SPDX-License-Identifier: Apache-2.0
#include "high_level/estimate/pose_filter.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace lodesman {
namespace {

using Vector = PoseFilter::Vector;
using Matrix = PoseFilter::Matrix;

// Before the first fix nothing is known of the position. A boat may be under way when it begins.
constexpr double kAnywhere_m = 1e3;
constexpr double kSurgeAtFirst_m_s = 0.5;
constexpr double kSwayAtFirst_m_s = 0.2;
// A fix from a little before the oldest entry belongs to that.
constexpr Duration kBeforeOldest = std::chrono::milliseconds{100};
// While nobody knows whether the box still runs on: 0.15 m/s after the second that its time-out may
// take.
constexpr double kUnknownThrust_m2_s3 = 0.0225;

// A P A'. By coefficients: Eigen's blocked product asks for memory where matrices are larger.
[[nodiscard]] Matrix congruent(const Matrix& a, const Matrix& p) noexcept {
  const Matrix ap = a.lazyProduct(p);
  return ap.lazyProduct(a.transpose());
}

// P after a measurement of the first kSize rows' states with that gain: (I - K H) P (I - K H)' +
// K R K', which stays symmetric and positive whatever the rounding.
template <int kSize>
[[nodiscard]] Matrix joseph(const Matrix& covariance,
                            const Eigen::Matrix<double, PoseFilter::kStates, kSize>& gain,
                            const Eigen::Matrix<double, kSize, PoseFilter::kStates>& rows,
                            double variance) noexcept {
  const Matrix kept = Matrix::Identity() - gain.lazyProduct(rows);
  const Matrix after = congruent(kept, covariance) + variance * gain.lazyProduct(gain.transpose());
  return 0.5 * (after + after.transpose());
}

// One measured state.
void take_scalar(int state, double innovation, double variance, Vector& mean,
                 Matrix& covariance) noexcept {
  Eigen::Matrix<double, 1, PoseFilter::kStates> row;
  row.setZero();
  row[state] = 1.0;
  const Vector gain = covariance.col(state) / (covariance(state, state) + variance);
  mean += gain * innovation;
  covariance = joseph<1>(covariance, gain, row, variance);
}

void forget_where(Matrix& covariance, const Eigen::Matrix2d& position_covariance) noexcept {
  covariance.topRows<2>().setZero();
  covariance.leftCols<2>().setZero();
  covariance.topLeftCorner<2, 2>() = position_covariance;
}

}  // namespace

PoseFilter::PoseFilter(const PoseFilterOptions& options) noexcept
    : options_{options}, model_{options.vehicle, options.speeds}, gate_{options.gate} {}

void PoseFilter::begin_anew() noexcept {
  gate_.begin_anew();
  count_ = 0;
  heading_of_ = {};
  nis_ = 0.0;
}

void PoseFilter::set_out(Time now, const Attitude& attitude) noexcept {
  Entry& first = entry(count_++);
  first = {};
  first.at = now;
  first.mean[kHeading] = attitude.heading_rad;
  first.mean[kYawRate] = attitude.yaw_rate_rad_s;
  Vector sigmas;
  sigmas << kAnywhere_m, kAnywhere_m, options_.heading_sigma_rad, kSurgeAtFirst_m_s,
      kSwayAtFirst_m_s, options_.yaw_rate_sigma_rad_s, options_.current_sigma_m_s,
      options_.current_sigma_m_s;
  first.covariance = sigmas.cwiseAbs2().asDiagonal();
  heading_of_ = attitude.measured;
}

void PoseFilter::advance(Time now, int surge_ref, int head_ref, const Attitude& attitude) noexcept {
  if (count_ > 0 && (now < newest().at || now - newest().at > kLongestStep)) {
    begin_anew();
  }
  if (count_ == 0) {
    set_out(now, attitude);
    return;
  }
  Entry next;
  next.at = now;
  next.forces = model_.forces(surge_ref, head_ref);
  if (attitude.measured > heading_of_) {
    heading_of_ = attitude.measured;
    next.has_heading = true;
    next.yaw_rate_rad_s = attitude.yaw_rate_rad_s;
    next.heading_rad =
        attitude.heading_rad + to_seconds(now - attitude.measured) * attitude.yaw_rate_rad_s;
  }
  add(next);
}

void PoseFilter::coast(Time now, int surge_ref, int head_ref, bool thrust_is_known) noexcept {
  if (count_ == 0 || now <= newest().at || now - newest().at > kLongestStep) {
    return;
  }
  Entry next;
  next.at = now;
  next.forces = model_.forces(surge_ref, head_ref);
  if (!thrust_is_known) {
    next.doubt_m2_s2 = kUnknownThrust_m2_s3 * to_seconds(now - newest().at);
  }
  add(next);
}

// Moves on from the newest entry to the next one.
void PoseFilter::add(Entry& next) noexcept {
  const Entry& before = newest();
  next.mean = before.mean;
  next.covariance = before.covariance;
  const double dt_s = to_seconds(next.at - before.at);
  predict(next.mean, next.covariance, next.forces, dt_s);
  next.covariance(kSurge, kSurge) += next.doubt_m2_s2;
  odometry_.xy_m += next.mean.head<2>() - before.mean.head<2>();
  way_m_ += std::abs(before.mean[kSurge]) * dt_s;
  if (next.has_heading) {
    take_heading(next, next.mean, next.covariance);
  }
  entry(count_++) = next;
  if (!next.mean.allFinite() || !next.covariance.allFinite() || !odometry_.xy_m.allFinite()) {
    odometry_ = {};
    aligned_ = false;
    begin_anew();
  }
}

// Any numbers may stand in shared memory: what is no covariance is no memory.
bool PoseFilter::resume(const EstimatorMemory& memory) noexcept {
  if (!memory.has_filter || memory.fix_believed == Time{}) {
    return false;
  }
  Entry first;
  first.at = memory.at;
  first.mean = Eigen::Map<const Vector>{memory.mean.data()};
  first.mean[kHeading] = wrap_to_pi(first.mean[kHeading]);
  const Matrix covariance = Eigen::Map<const Matrix>{memory.covariance.data()};
  first.covariance = 0.5 * (covariance + covariance.transpose());
  const Eigen::LLT<Matrix> root{first.covariance};
  if (root.info() != Eigen::Success || !first.mean.allFinite()) {
    return false;
  }
  begin_anew();
  gate_.resume(memory);
  heading_of_ = memory.at;
  odometry_.xy_m = {memory.odometry_x_m, memory.odometry_y_m};
  aligned_ = true;
  way_m_ = memory.way_m;
  entry(count_++) = first;
  return true;
}

void PoseFilter::remember(EstimatorMemory& memory) const noexcept {
  memory.has_filter = count_ > 0 && aligned_;
  if (!memory.has_filter) {
    return;
  }
  memory.at = newest().at;
  Eigen::Map<Vector>{memory.mean.data()} = newest().mean;
  Eigen::Map<Matrix>{memory.covariance.data()} = newest().covariance;
  memory.odometry_x_m = odometry_.xy_m.x();
  memory.odometry_y_m = odometry_.xy_m.y();
  memory.way_m = way_m_;
  gate_.remember(memory);
}

void PoseFilter::predict(Vector& mean, Matrix& covariance, const ThrustForces& forces,
                         double dt_s) const noexcept {
  const int steps = std::max(1, static_cast<int>(std::ceil(dt_s / VehicleModel::kStepMax_s)));
  const double h_s = dt_s / steps;
  const auto squared = [h_s](double noise) noexcept { return noise * noise * h_s; };
  Vector noise = Vector::Zero();
  noise[kSurge] = squared(options_.surge_noise_m_s_per_sqrt_s);
  noise[kSway] = squared(options_.sway_noise_m_s_per_sqrt_s);
  noise[kYawRate] = squared(options_.yaw_noise_rad_s_per_sqrt_s);
  noise[kCurrentX] = noise[kCurrentY] = squared(options_.current_noise_m_s_per_sqrt_s);
  for (int i = 0; i < steps; ++i) {
    const BodyVelocity velocity = mean.segment<3>(kSurge);
    const double s = std::sin(mean[kHeading]);
    const double c = std::cos(mean[kHeading]);
    Matrix slope = Matrix::Identity();
    slope(kX, kHeading) = h_s * (velocity[0] * c - velocity[1] * s);
    slope(kY, kHeading) = h_s * (-velocity[0] * s - velocity[1] * c);
    slope(kX, kSurge) = h_s * s;
    slope(kX, kSway) = h_s * c;
    slope(kY, kSurge) = h_s * c;
    slope(kY, kSway) = -h_s * s;
    slope(kX, kCurrentX) = slope(kY, kCurrentY) = h_s;
    slope(kHeading, kYawRate) = h_s;
    slope.block<3, 3>(kSurge, kSurge) += h_s * model_.acceleration_slope(velocity);
    const VehicleMotion moved = model_.advanced({{mean.head<2>()}, mean[kHeading], velocity},
                                                forces, mean.segment<2>(kCurrentX), h_s);
    mean.head<2>() = moved.position.xy_m;
    mean[kHeading] = wrap_to_pi(moved.heading_rad);
    mean.segment<3>(kSurge) = moved.velocity;
    covariance = congruent(slope, covariance);
    covariance.diagonal() += noise;
  }
}

void PoseFilter::take_heading(const Entry& measured, Vector& mean,
                              Matrix& covariance) const noexcept {
  const auto squared = [](double sigma) noexcept { return sigma * sigma; };
  take_scalar(kHeading, wrap_to_pi(measured.heading_rad - mean[kHeading]),
              squared(options_.heading_sigma_rad), mean, covariance);
  take_scalar(kYawRate, measured.yaw_rate_rad_s - mean[kYawRate],
              squared(options_.yaw_rate_sigma_rad_s), mean, covariance);
  mean[kHeading] = wrap_to_pi(mean[kHeading]);
}

void PoseFilter::carry_on(const Entry& from, Entry& to) const noexcept {
  to.mean = from.mean;
  to.covariance = from.covariance;
  predict(to.mean, to.covariance, to.forces, to_seconds(to.at - from.at));
  to.covariance(kSurge, kSurge) += to.doubt_m2_s2;
  if (to.has_heading) {
    take_heading(to, to.mean, to.covariance);
  }
}

void PoseFilter::filter_again(std::size_t from) noexcept {
  for (std::size_t i = from + 1; i < count_; ++i) {
    carry_on(entry(i - 1), entry(i));
  }
}

FixVerdict PoseFilter::fix(const WorldPoint& position, double sigma_m, Time measured) noexcept {
  if (!position.xy_m.allFinite() || !std::isfinite(sigma_m)) {
    return FixVerdict::kSenseless;
  }
  if (count_ == 0 || measured > newest().at || measured + kBeforeOldest < entry(oldest()).at) {
    return FixVerdict::kUntimely;
  }
  const std::size_t number = entry_before(measured);
  Entry& then = entry(number);
  FixGate::Look look;
  look.position = position;
  look.sigma_m = gate_.believable_sigma_m(sigma_m);
  look.measured = measured;
  look.way_m = way_m_;
  const Eigen::Vector2d over_ground_m_s = velocity_over_ground(
      then.mean[kHeading], then.mean.segment<3>(kSurge), then.mean.segment<2>(kCurrentX));
  const Eigen::Vector2d moved_m = to_seconds(measured - then.at) * over_ground_m_s;
  look.innovation_m = position.xy_m - moved_m - then.mean.head<2>();
  const Eigen::Matrix2d scatter = then.covariance.topLeftCorner<2, 2>() +
                                  look.sigma_m * look.sigma_m * Eigen::Matrix2d::Identity();
  look.mahalanobis_squared = look.innovation_m.dot(scatter.inverse() * look.innovation_m);
  const FixVerdict verdict = gate_.judge(look);
  switch (verdict) {
    case FixVerdict::kBelieved:
      nis_ = look.mahalanobis_squared;
      believe(then, look.innovation_m, look.sigma_m);
      break;
    case FixVerdict::kFirst: place(then, {position.xy_m - moved_m}, look.sigma_m); break;
    case FixVerdict::kApproach: approach(then, look.innovation_m, look.sigma_m); break;
    default: return verdict;
  }
  filter_again(number);
  if (!aligned_) {
    aligned_ = true;
    odometry_.xy_m = newest().mean.head<2>();
  }
  return verdict;
}

std::size_t PoseFilter::entry_before(Time measured) const noexcept {
  std::size_t number = count_ - 1;
  while (number > oldest() && entry(number).at > measured) {
    --number;
  }
  return number;
}

void PoseFilter::believe(Entry& then, const Eigen::Vector2d& innovation_m,
                         double sigma_m) noexcept {
  Eigen::Matrix<double, 2, kStates> rows;
  rows.setZero();
  rows.leftCols<2>().setIdentity();
  const double variance_m2 = sigma_m * sigma_m;
  const Eigen::Matrix2d scatter =
      then.covariance.topLeftCorner<2, 2>() + variance_m2 * Eigen::Matrix2d::Identity();
  const Eigen::Matrix<double, kStates, 2> gain = then.covariance.leftCols<2>() * scatter.inverse();
  then.mean += gain * innovation_m;
  then.mean[kHeading] = wrap_to_pi(then.mean[kHeading]);
  then.covariance = joseph<2>(then.covariance, gain, rows, variance_m2);
}

void PoseFilter::place(Entry& then, const WorldPoint& position, double sigma_m) noexcept {
  then.mean.head<2>() = position.xy_m;
  forget_where(then.covariance, sigma_m * sigma_m * Eigen::Matrix2d::Identity());
}

// The position moves: a leap of the receiver says nothing of speed or current, but where the fixes
// drift away as well, that is taken for current. What is left of the way is doubt.
void PoseFilter::approach(Entry& then, const Eigen::Vector2d& innovation_m,
                          double sigma_m) noexcept {
  const double far_m = std::max(innovation_m.norm(), 1e-9);
  const Eigen::Vector2d step_m = std::min(1.0, gate_.approach_step_m() / far_m) * innovation_m;
  const Eigen::Vector2d left_m = innovation_m - step_m;
  then.mean.head<2>() += step_m;
  forget_where(then.covariance,
               sigma_m * sigma_m * Eigen::Matrix2d::Identity() + left_m * left_m.transpose());
  if (gate_.drift_m_s().norm() > 0.0) {
    const double sigma_m_s = std::max(options_.current_sigma_m_s, gate_.drift_sigma_m_s());
    then.mean.tail<2>() += gate_.drift_m_s();
    then.covariance.bottomRows<2>().setZero();
    then.covariance.rightCols<2>().setZero();
    then.covariance.bottomRightCorner<2, 2>() = sigma_m_s * sigma_m_s * Eigen::Matrix2d::Identity();
  }
}

bool PoseFilter::knows_position() const noexcept {
  return count_ > 0 && gate_.knows_position(newest().at);
}

VehicleState PoseFilter::state() const noexcept {
  VehicleState state;
  if (count_ == 0) {
    state.trust = PositionTrust::kLost;
    return state;
  }
  const Entry& now = newest();
  state.valid_at = now.at;
  state.x_m = now.mean[kX];
  state.y_m = now.mean[kY];
  state.heading_rad = wrap_to_pi(now.mean[kHeading]);
  state.surge_m_s = now.mean[kSurge];
  state.sway_m_s = now.mean[kSway];
  state.yaw_rate_rad_s = now.mean[kYawRate];
  state.current_x_m_s = now.mean[kCurrentX];
  state.current_y_m_s = now.mean[kCurrentY];
  state.position_xx_m2 = now.covariance(kX, kX);
  state.position_xy_m2 = now.covariance(kX, kY);
  state.position_yy_m2 = now.covariance(kY, kY);
  state.heading_variance_rad2 = now.covariance(kHeading, kHeading);
  state.current_xx_m2_s2 = now.covariance(kCurrentX, kCurrentX);
  state.current_xy_m2_s2 = now.covariance(kCurrentX, kCurrentY);
  state.current_yy_m2_s2 = now.covariance(kCurrentY, kCurrentY);
  state.odometry_x_m = odometry_.xy_m.x();
  state.odometry_y_m = odometry_.xy_m.y();
  state.trust = gate_.trust(now.at);
  state.fix_measured = gate_.last_believed();
  return state;
}

}  // namespace lodesman
