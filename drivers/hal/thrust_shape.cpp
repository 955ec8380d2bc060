// SPDX-License-Identifier: Apache-2.0
#include "drivers/hal/thrust_shape.h"

#include <algorithm>
#include <cmath>

#include "mid_level/base/startup_error.h"

namespace lodesman {
namespace {

constexpr double kMaxDeadband = 0.9;
constexpr double kMaxSlew_per_s = 1000.0;
constexpr Duration kMaxPause = std::chrono::seconds{10};

[[nodiscard]] bool within(double value, double least, double most) noexcept {
  return value >= least && value <= most;  // what is no number is not
}

[[nodiscard]] bool is_zero(double value) noexcept { return std::fpclassify(value) == FP_ZERO; }

void check_curve(const ThrustShapeOptions& options) {
  if (options.curve_points > ThrustShapeOptions::kMaxCurvePoints) {
    throw StartupError("a thrust curve has at most 8 points");
  }
  for (std::size_t i = 0; i < options.curve_points; ++i) {
    const auto& [in, out] = options.curve.at(i);
    if (!within(in, -1.0, 1.0) || !within(out, -1.0, 1.0)) {
      throw StartupError("the points of a thrust curve must lie from -1 to 1");
    }
    if (in * out < 0.0 || (is_zero(in) && !is_zero(out))) {
      throw StartupError("a thrust curve must go through 0, 0 and keep ahead and astern apart");
    }
    if (i > 0 && (in <= options.curve.at(i - 1).in || out < options.curve.at(i - 1).out)) {
      throw StartupError("a thrust curve must rise from point to point");
    }
  }
}

[[nodiscard]] ThrustShapeOptions checked(const ThrustShapeOptions& options) {
  check_curve(options);
  if (!within(options.deadband, 0.0, kMaxDeadband)) {
    throw StartupError("the deadband of the thrust must be from 0 to 0.9");
  }
  if (!within(options.slew_per_s, 0.0, kMaxSlew_per_s)) {
    throw StartupError("the slew limit of the thrust must be from 0 to 1000 per second");
  }
  if (options.zero_pause < Duration::zero() || options.zero_pause > kMaxPause) {
    throw StartupError("the pause at zero thrust must be from 0 to 10 seconds");
  }
  return options;
}

[[nodiscard]] bool opposite(double a, double b) noexcept { return a * b < 0.0; }

}  // namespace

ThrustShape::ThrustShape(const ThrustShapeOptions& options) : options_{checked(options)} {}

double ThrustShape::shape(double share, Time now) noexcept {
  const double sane = std::isnan(share) ? 0.0 : std::clamp(share, -1.0, 1.0);
  const double wanted = beyond_deadband(curved(sane));
  const Duration step = std::clamp(now - called_at_, Duration::zero(), kLongestStep);
  called_at_ = now;
  const bool stops = is_zero(wanted) || must_pause(wanted, now);
  const double given = stops ? 0.0 : slewed(wanted, step);
  if (is_zero(given) && !is_zero(given_)) {
    stopped_at_ = now;
  }
  if (!is_zero(given)) {
    direction_ = std::copysign(1.0, given);
  }
  given_ = given;
  return given;
}

double ThrustShape::curved(double share) const noexcept {
  if (is_zero(share)) {
    return 0.0;
  }
  // The two points that the share lies between, from zero outwards on its own side.
  const double side = std::copysign(1.0, share);
  ThrustCurvePoint inner;
  ThrustCurvePoint outer;
  bool found = false;
  for (std::size_t i = 0; i < options_.curve_points && !found; ++i) {
    const ThrustCurvePoint& point =
        options_.curve.at(side > 0.0 ? i : options_.curve_points - 1 - i);
    if (point.in * side <= 0.0) {
      continue;
    }
    inner = outer;
    outer = point;
    found = std::abs(point.in) >= std::abs(share);
  }
  if (is_zero(outer.in)) {
    return share;
  }
  if (!found) {
    return outer.out;
  }
  return inner.out + (outer.out - inner.out) * (share - inner.in) / (outer.in - inner.in);
}

double ThrustShape::beyond_deadband(double share) const noexcept {
  if (is_zero(share)) {
    return 0.0;
  }
  return std::copysign(options_.deadband + (1.0 - options_.deadband) * std::abs(share), share);
}

bool ThrustShape::must_pause(double share, Time now) const noexcept {
  if (!opposite(share, direction_) || options_.zero_pause == Duration::zero()) {
    return false;
  }
  return !is_zero(given_) || now - stopped_at_ < options_.zero_pause;
}

double ThrustShape::slewed(double share, Duration step) const noexcept {
  if (is_zero(options_.slew_per_s)) {
    return share;
  }
  const double from = opposite(share, given_) ? 0.0 : std::abs(given_);
  const double most = std::max(from, options_.deadband) + options_.slew_per_s * to_seconds(step);
  return std::copysign(std::min(std::abs(share), most), share);
}

}  // namespace lodesman
