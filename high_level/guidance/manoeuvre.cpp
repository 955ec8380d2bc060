// SPDX-License-Identifier: Apache-2.0
#include "high_level/guidance/manoeuvre.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mid_level/messages/obstacle_distance.h"

namespace lodesman {
namespace {

using Vec = Eigen::Vector2d;

// How far it looks ahead, and how finely.
constexpr double kHorizon_m = 20.0;
constexpr double kHorizonMin_s = 25.0;
constexpr double kHorizonMax_s = 90.0;
constexpr double kStep_m = 0.25;  // of the fastest approach
constexpr int kSteps_max = 240;

// The manoeuvres: courses off the route, each held for a length of way, at a speed.
constexpr std::array kOffsets_deg{15.0,  -15.0, 30.0,  -30.0, 45.0,   -45.0, 65.0,
                                  -65.0, 90.0,  -90.0, 130.0, -130.0, 180.0};
constexpr std::array kLengths_m{2.0, 5.0, 12.0};
constexpr std::array kSpeedShares{1.0, 0.5};
constexpr std::array kSlowShares{0.6, 0.3, 0.0, -0.4};

// Costs, as seconds of delay.
constexpr double kCollision_s = 1000.0;
constexpr double kCloseness_s = 15.0;  // a second at no clearance at all
constexpr double kFading_s = 40.0;     // what is far ahead may turn out otherwise
constexpr double kAhead_s = 6.0;       // crossing close ahead of something that moves
constexpr double kAheadRange_m = 8.0;
constexpr double kMoving_m_s = 0.05;
constexpr double kToPort_s = 0.5;  // to starboard where nothing else decides

[[nodiscard]] Vec direction(double heading_rad) noexcept {
  return {std::sin(heading_rad), std::cos(heading_rad)};
}

[[nodiscard]] double heading_of(const Vec& way) noexcept { return std::atan2(way.x(), way.y()); }

[[nodiscard]] double larger_sigma(double xx, double xy, double yy) noexcept {
  const double mean = 0.5 * (xx + yy);
  const double spread = std::hypot(0.5 * (xx - yy), xy);
  return std::sqrt(std::max(0.0, mean + spread));
}

// A disc round the shape: its centre, and how far its farthest point lies.
void enclose(const Obstacle& shape, Vec& centre, double& radius_m) noexcept {
  if (shape.shape == ObstacleShape::kEllipse) {
    centre = {shape.centre_x_m, shape.centre_y_m};
    radius_m = std::max(shape.semi_axis_first_m, shape.semi_axis_second_m);
    return;
  }
  centre.setZero();
  const std::uint32_t count = std::max(1U, shape.vertex_count);
  for (std::uint32_t i = 0; i < shape.vertex_count; ++i) {
    centre += Vec{shape.vertices[i].x_m, shape.vertices[i].y_m} / count;
  }
  radius_m = 0.0;
  for (std::uint32_t i = 0; i < shape.vertex_count; ++i) {
    radius_m =
        std::max(radius_m, (Vec{shape.vertices[i].x_m, shape.vertices[i].y_m} - centre).norm());
  }
}

}  // namespace

const ManoeuvreChooser::Choice& ManoeuvreChooser::choose(Time now, const OwnMotion& own,
                                                         const Route& route, const Tracks& tracks,
                                                         double speed_share_max,
                                                         bool stay_at_end) noexcept {
  own_ = own;
  route_ = &route;
  speed_share_max_ = speed_share_max;
  stay_at_end_ = stay_at_end;
  foresee_hazards(now, tracks);
  choice_.manoeuvre = {0.0, 0.0, speed_share_max};
  choice_.of_route = foresee(choice_.manoeuvre, nullptr);
  choice_.foresight = choice_.of_route;
  // With nothing in the way no other manoeuvre is there sooner.
  if (choice_.of_route.delay_s > 0.0) {
    consider_all();
    stay_with_last();
  }
  choice_.changed = !(choice_.manoeuvre == kept_);
  kept_ = choice_.manoeuvre;
  choice_.way.clear();
  (void)foresee(choice_.manoeuvre, &choice_.way);
  return choice_;
}

void ManoeuvreChooser::consider_all() noexcept {
  for (const double share : kSlowShares) {
    for (const double length_m : kLengths_m) {
      consider({0.0, length_m / response_.speed_max_m_s, std::min(share, speed_share_max_)});
    }
  }
  for (const double offset_deg : kOffsets_deg) {
    for (const double length_m : kLengths_m) {
      for (const double share : kSpeedShares) {
        consider({to_rad(offset_deg), length_m / response_.speed_max_m_s,
                  std::min(share, speed_share_max_)});
      }
    }
  }
}

void ManoeuvreChooser::stay_with_last() noexcept {
  // The manoeuvre under way is left only for one that is better by the stated gain.
  Manoeuvre kept = kept_;
  kept.speed_share = std::min(kept.speed_share, speed_share_max_);
  const Foresight of_kept = foresee(kept, nullptr);
  if (of_kept.cost_s <= choice_.foresight.cost_s + options_.switch_gain_s) {
    choice_.manoeuvre = kept;
    choice_.foresight = of_kept;
  }
}

void ManoeuvreChooser::foresee_hazards(Time now, const Tracks& tracks) noexcept {
  hazard_count_ = 0;
  double fastest_m_s = 0.0;
  for (std::uint32_t i = 0; i < std::min<std::uint32_t>(tracks.count, kMaxObstacles); ++i) {
    const Track& track = tracks.tracks[i];
    Hazard& hazard = hazards_[hazard_count_++];
    hazard.track = &track;
    hazard.velocity_m_s = {track.velocity_x_m_s, track.velocity_y_m_s};
    hazard.age_s = to_seconds(now - track.last_seen);
    hazard.place_sigma_m = larger_sigma(track.place_xx_m2, track.place_xy_m2, track.place_yy_m2);
    hazard.velocity_sigma_m_s =
        larger_sigma(track.velocity_xx_m2_s2, track.velocity_xy_m2_s2, track.velocity_yy_m2_s2);
    enclose(track.shape, hazard.centre, hazard.around_m);
    fastest_m_s = std::max(fastest_m_s, hazard.velocity_m_s.norm());
  }
  horizon_s_ = std::clamp(kHorizon_m / response_.speed_max_m_s, kHorizonMin_s, kHorizonMax_s);
  step_s_ = std::max(kStep_m / (response_.speed_max_m_s + fastest_m_s), horizon_s_ / kSteps_max);
}

void ManoeuvreChooser::consider(const Manoeuvre& manoeuvre) noexcept {
  const Foresight foresight = foresee(manoeuvre, nullptr);
  if (foresight.cost_s < choice_.foresight.cost_s) {
    choice_.foresight = foresight;
    choice_.manoeuvre = manoeuvre;
  }
}

Foresight ManoeuvreChooser::foresee(const Manoeuvre& manoeuvre, Route* way) const noexcept {
  Foresight out;
  out.least_clearance_m = std::numeric_limits<double>::infinity();
  const Route& route = *route_;
  const VehicleResponse& r = response_;
  // Two discs of this radius, so far before and behind the centre, cover the hull.
  const double disc_at_m = 0.5 * r.hull_half_length_m;
  const double disc_m = std::hypot(disc_at_m, r.hull_half_beam_m);
  OwnMotion own = own_;
  RoutePlace place = nearest_place(route, own.p_W, {}, std::numeric_limits<double>::infinity());
  const Vec start_aim = point_ahead(route, place, r.look_ahead_m) - own.p_W;
  const double course_rad =
      (start_aim.norm() > 0.2 ? heading_of(start_aim) : own.heading_rad) + manoeuvre.offset_rad;
  double cost_s = manoeuvre.offset_rad < 0.0 ? kToPort_s : 0.0;
  std::array<bool, kMaxObstacles> hit{};
  double t_s = 0.0;
  double since_point_m = 0.0;
  if (way != nullptr) {
    way->add(own.p_W);
  }
  bool arrived = false;
  for (int step = 0; step < kSteps_max && t_s < horizon_s_; ++step) {
    const bool aside = t_s < manoeuvre.for_s;
    place = nearest_place(route, own.p_W, place, 6.0 * r.look_ahead_m);
    const double left_m = (route.end() - own.p_W).norm();
    const bool at_end = left_m < 0.4 && place.leg + 2 >= route.count;
    if (at_end && !stay_at_end_) {
      arrived = true;
      break;
    }
    const Vec aim = point_ahead(route, place, r.look_ahead_m) - own.p_W;
    const double wanted_rad = aside ? course_rad : heading_of(aim);
    const double deviation_rad = wrap_to_pi(wanted_rad - own.heading_rad);
    double speed_m_s = (aside ? manoeuvre.speed_share : speed_share_max_) * r.speed_max_m_s;
    if (!aside && at_end) {
      speed_m_s = 0.0;
    } else if (std::abs(deviation_rad) > 0.8 && speed_m_s > 0.0) {
      speed_m_s *= 0.3;  // as the controller does before a sharp turn
    }
    const double turn_rad_s = std::clamp(r.heading_gain_per_s * deviation_rad,
                                         -r.turn_rate_max_rad_s, r.turn_rate_max_rad_s);
    const bool still = at_end && !aside;
    own.heading_rad += still ? 0.0 : turn_rad_s * step_s_;
    own.surge_m_s += (speed_m_s - own.surge_m_s) * (1.0 - std::exp(-step_s_ / r.surge_time_s));
    const Vec ahead = direction(own.heading_rad);
    own.p_W += own.surge_m_s * step_s_ * ahead;
    t_s += step_s_;
    const double fading = std::exp(-t_s / kFading_s);
    for (std::size_t i = 0; i < hazard_count_; ++i) {
      const Hazard& h = hazards_[i];
      const Vec moved = (t_s + h.age_s) * h.velocity_m_s;
      const Vec relative = own.p_W - moved;
      const double doubt_m = std::min(
          options_.doubt_max_m,
          options_.doubt_sigmas * (h.place_sigma_m + h.velocity_sigma_m_s * (t_s + h.age_s)));
      const double wanted_m = options_.clearance_m + doubt_m;
      const double bound_m = (relative - h.centre).norm() - h.around_m - disc_at_m - disc_m;
      if (bound_m > wanted_m && bound_m >= out.least_clearance_m) {
        continue;
      }
      const double clearance_m =
          std::min(edge_distance_m(h.track->shape, {relative + disc_at_m * ahead}),
                   edge_distance_m(h.track->shape, {relative - disc_at_m * ahead})) -
          disc_m;
      if (clearance_m < out.least_clearance_m) {
        out.least_clearance_m = clearance_m;
        out.least_after_s = t_s;
        out.least_track = h.track->id;
      }
      if (clearance_m >= wanted_m) {
        continue;
      }
      const double lack = (wanted_m - clearance_m) / wanted_m;
      cost_s += kCloseness_s * lack * lack * fading * step_s_;
      if (clearance_m < options_.core_m && !hit[i]) {
        hit[i] = true;
        out.collides = true;
        cost_s += kCollision_s * fading;
      }
    }
    for (std::size_t i = 0; i < hazard_count_; ++i) {
      const Hazard& h = hazards_[i];
      const double speed = h.velocity_m_s.norm();
      if (speed < kMoving_m_s) {
        continue;
      }
      // Close ahead of it, in its way.
      const Vec from_it = own.p_W - (t_s + h.age_s) * h.velocity_m_s - h.centre;
      const Vec its_way = h.velocity_m_s / speed;
      const double along_m = from_it.dot(its_way) - h.around_m;
      const double across_m = std::abs(from_it.x() * its_way.y() - from_it.y() * its_way.x());
      if (along_m > 0.0 && along_m < kAheadRange_m && across_m < h.around_m + 1.0) {
        cost_s += kAhead_s * (1.0 - along_m / kAheadRange_m) * fading * step_s_;
      }
    }
    since_point_m += std::abs(own.surge_m_s) * step_s_;
    if (way != nullptr && aside && since_point_m >= 0.5) {
      since_point_m = 0.0;
      way->add(own.p_W);
    }
  }
  const double left_m =
      arrived ? 0.0 : (point_at(route, place) - own.p_W).norm() + remaining_m(route, place);
  out.delay_s = cost_s;
  out.cost_s = cost_s + t_s + left_m / r.speed_max_m_s;
  if (way != nullptr) {
    // Back on the route, ahead of where it was left.
    const RoutePlace back = nearest_place(route, way->end(), {}, 1e9);
    for (std::uint32_t leg = back.leg; leg + 1 < route.count; ++leg) {
      way->add(route.points[leg + 1]);
    }
  }
  return out;
}

}  // namespace lodesman
