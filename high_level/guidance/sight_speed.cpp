// SPDX-License-Identifier: Apache-2.0
#include "high_level/guidance/sight_speed.h"

#include <algorithm>

namespace lodesman {
namespace {

constexpr double kLookEvery_m = 0.5 * Coverage::kCell_m;
constexpr int kHalvings = 12;  // of the speed that is searched: to a mm/s

[[nodiscard]] bool is_seen(const Coverage& water, const Eigen::Vector2d& at) noexcept {
  return water.at(at.x(), at.y()) != WaterState::kUnknown;
}

}  // namespace

double seen_ahead_m(const Coverage& water, const Route& way, RoutePlace from, double half_width_m,
                    double far_m) noexcept {
  Eigen::Vector2d last = point_at(way, from);
  for (double ahead_m = 0.0; ahead_m < far_m; ahead_m += kLookEvery_m) {
    const Eigen::Vector2d at = point_ahead(way, from, ahead_m + kLookEvery_m);
    const Eigen::Vector2d along = at - last;
    if (!(along.norm() > 0.0)) {
      return far_m;
    }
    const Eigen::Vector2d beside =
        half_width_m / along.norm() * Eigen::Vector2d{along.y(), -along.x()};
    if (!is_seen(water, at) || !is_seen(water, at + beside) || !is_seen(water, at - beside)) {
      return ahead_m;
    }
    last = at;
  }
  return far_m;
}

double sight_needed_m(const SightSpeedOptions& options, const VehicleModel& vehicle,
                      double speed_m_s) noexcept {
  return options.bow_m + options.latency_s * speed_m_s + vehicle.stopping_way_m(speed_m_s);
}

double speed_by_sight_m_s(const SightSpeedOptions& options, const VehicleModel& vehicle,
                          double seen_m, double most_m_s) noexcept {
  if (sight_needed_m(options, vehicle, most_m_s) <= seen_m) {
    return most_m_s;
  }
  double slow_m_s = std::min(options.unseen_speed_m_s, most_m_s);
  double fast_m_s = most_m_s;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle_m_s = 0.5 * (slow_m_s + fast_m_s);
    if (sight_needed_m(options, vehicle, middle_m_s) <= seen_m) {
      slow_m_s = middle_m_s;
    } else {
      fast_m_s = middle_m_s;
    }
  }
  return slow_m_s;
}

}  // namespace lodesman
