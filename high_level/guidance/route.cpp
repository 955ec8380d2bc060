// SPDX-License-Identifier: Apache-2.0
#include "high_level/guidance/route.h"

#include <algorithm>
#include <limits>

namespace lodesman {
namespace {

using Vec = Eigen::Vector2d;

[[nodiscard]] double leg_length_m(const Route& route, std::uint32_t leg) noexcept {
  return (route.points[leg + 1] - route.points[leg]).norm();
}

}  // namespace

double Route::length_m() const noexcept {
  double length_m = 0.0;
  for (std::uint32_t leg = 0; leg + 1 < count; ++leg) {
    length_m += leg_length_m(*this, leg);
  }
  return length_m;
}

RoutePlace nearest_place(const Route& route, const Vec& point, RoutePlace from,
                         double within_m) noexcept {
  RoutePlace best = from;
  double least_m = std::numeric_limits<double>::infinity();
  double walked_m = 0.0;
  for (std::uint32_t leg = from.leg; leg + 1 < route.count && walked_m <= within_m; ++leg) {
    const Vec& a = route.points[leg];
    const Vec way = route.points[leg + 1] - a;
    const double length_m = way.norm();
    const double first = leg == from.leg ? from.share : 0.0;
    const double wanted = length_m > 0.0 ? way.dot(point - a) / (length_m * length_m) : 1.0;
    const double share = std::clamp(wanted, first, 1.0);
    const double distance_m = (point - (a + share * way)).norm();
    if (distance_m < least_m) {
      least_m = distance_m;
      best = {leg, share};
    }
    walked_m += (1.0 - first) * length_m;
  }
  return best;
}

Vec point_at(const Route& route, RoutePlace place) noexcept {
  if (place.leg + 1 >= route.count) {
    return route.end();
  }
  const Vec& a = route.points[place.leg];
  return a + place.share * (route.points[place.leg + 1] - a);
}

Vec point_ahead(const Route& route, RoutePlace place, double ahead_m) noexcept {
  double share = place.share;
  for (std::uint32_t leg = place.leg; leg + 1 < route.count; ++leg) {
    const double length_m = leg_length_m(route, leg);
    const double left_m = (1.0 - share) * length_m;
    if (ahead_m <= left_m && length_m > 0.0) {
      return point_at(route, {leg, share + ahead_m / length_m});
    }
    ahead_m -= left_m;
    share = 0.0;
  }
  return route.end();
}

double remaining_m(const Route& route, RoutePlace place) noexcept {
  double length_m = 0.0;
  double share = place.share;
  for (std::uint32_t leg = place.leg; leg + 1 < route.count; ++leg) {
    length_m += (1.0 - share) * leg_length_m(route, leg);
    share = 0.0;
  }
  return length_m;
}

}  // namespace lodesman
