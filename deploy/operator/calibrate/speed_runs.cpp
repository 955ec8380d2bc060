// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/calibrate/speed_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mid_level/base/heading.h"

namespace lodesman::cli {
namespace {

constexpr std::size_t kLeastPlaces = 8;
constexpr double kLeastSpeed_m_s = 0.02;
// Of the difference of two unit vectors: there and back within 60 degrees.
constexpr double kLeastTurn = 1.7;

}  // namespace

void StraightRun::add(double time_s, double x_m, double y_m, double heading_rad) {
  first_s_ = count_ == 0 ? time_s : first_s_;
  const double t = time_s - first_s_;
  ++count_;
  sum_t_ += t;
  sum_tt_ += t * t;
  sum_x_ += x_m;
  sum_tx_ += t * x_m;
  sum_y_ += y_m;
  sum_ty_ += t * y_m;
  sum_sine_ += std::sin(heading_rad);
  sum_cosine_ += std::cos(heading_rad);
}

double StraightRun::slope(double sum_product, double sum) const noexcept {
  const double n = static_cast<double>(count_);
  const double spread = n * sum_tt_ - sum_t_ * sum_t_;
  return spread > 1e-9 ? (n * sum_product - sum_t_ * sum) / spread : 0.0;
}

double StraightRun::heading_x() const noexcept {
  const double length = std::hypot(sum_sine_, sum_cosine_);
  return length > 0.0 ? sum_sine_ / length : 0.0;
}

double StraightRun::heading_y() const noexcept {
  const double length = std::hypot(sum_sine_, sum_cosine_);
  return length > 0.0 ? sum_cosine_ / length : 0.0;
}

std::optional<PairOfRuns> compare(int surge_ref, const StraightRun& there,
                                  const StraightRun& back) noexcept {
  const double turn_x = there.heading_x() - back.heading_x();
  const double turn_y = there.heading_y() - back.heading_y();
  const double turn = std::hypot(turn_x, turn_y);
  const double change_x_m_s = there.x_m_s() - back.x_m_s();
  const double change_y_m_s = there.y_m_s() - back.y_m_s();
  PairOfRuns pair;
  pair.surge_ref = surge_ref;
  if (std::min(there.count(), back.count()) < kLeastPlaces || turn < kLeastTurn) {
    return std::nullopt;
  }
  pair.speed_m_s = std::hypot(change_x_m_s, change_y_m_s) / turn;
  if (pair.speed_m_s < kLeastSpeed_m_s) {
    return std::nullopt;
  }
  pair.heading_offset_rad =
      wrap_to_pi(std::atan2(turn_x, turn_y) - std::atan2(change_x_m_s, change_y_m_s));
  // The boat's own part of what both runs have in common, where they were not quite opposite.
  const Heading sailed = Heading::clockwise_from_y_rad(
      std::atan2(there.heading_x() + back.heading_x(), there.heading_y() + back.heading_y()) -
      pair.heading_offset_rad);
  const double common =
      std::hypot(there.heading_x() + back.heading_x(), there.heading_y() + back.heading_y()) / 2.0 *
      pair.speed_m_s;
  pair.current_x_m_s = (there.x_m_s() + back.x_m_s()) / 2.0 - common * std::sin(sailed.rad());
  pair.current_y_m_s = (there.y_m_s() + back.y_m_s()) / 2.0 - common * std::cos(sailed.rad());
  return pair;
}

Calibration calibration_of(std::vector<PairOfRuns> pairs) {
  std::sort(pairs.begin(), pairs.end(),
            [](const PairOfRuns& a, const PairOfRuns& b) { return a.surge_ref < b.surge_ref; });
  Calibration result;
  double sine = 0.0;
  double cosine = 0.0;
  for (const PairOfRuns& pair : pairs) {
    sine += pair.speed_m_s * std::sin(pair.heading_offset_rad);
    cosine += pair.speed_m_s * std::cos(pair.heading_offset_rad);
    if (result.pairs.empty() || pair.speed_m_s > result.pairs.back().speed_m_s) {
      result.pairs.push_back(pair);
    }
  }
  result.heading_offset_rad = std::atan2(sine, cosine);
  return result;
}

std::string to_toml(const Calibration& calibration, bool has_mounting) {
  std::string points;
  for (const PairOfRuns& pair : calibration.pairs) {
    points +=
        fmt::format("{}[{}, {:.3f}]", points.empty() ? "" : ", ", pair.surge_ref, pair.speed_m_s);
  }
  const char* mark = has_mounting ? "" : "# ";
  return fmt::format("[vehicle]\nspeed_table = [{}]\n\n{}[mounting]\n{}heading_deg = {:.1f}\n",
                     points, mark, mark, to_deg(calibration.heading_offset_rad));
}

}  // namespace lodesman::cli
