// SPDX-License-Identifier: Apache-2.0
#include "high_level/guidance/manoeuvre.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "high_level/guidance/current.h"
#include "mid_level/geometry/obstacle_distance.h"

namespace lodesman {
namespace {

using Vec = Eigen::Vector2d;

// How far it looks ahead, and how finely.
constexpr double kHorizon_m = 20.0;
constexpr double kHorizonMin_s = 25.0;
constexpr double kHorizonMax_s = 90.0;
constexpr double kStep_m = 0.25;  // of the fastest approach
constexpr int kSteps_max = 240;

constexpr double kWayPoint_m = 0.5;  // between points of the way that is shown

// How the controller steers.
constexpr double kArrived_m = 0.4;
constexpr double kAim_m = 0.2;
constexpr double kSharpTurn_rad = 0.8;
constexpr double kSharpTurnShare = 0.3;
constexpr double kStillWater_m_s = 0.01;  // slower is none

// The manoeuvres: courses off the route, each held for a length of way, at a speed.
constexpr std::array kOffsets_deg{15.0,  -15.0, 30.0,  -30.0, 45.0,   -45.0, 65.0,
                                  -65.0, 90.0,  -90.0, 130.0, -130.0, 180.0};
constexpr std::array kLengths_m{2.0, 5.0, 12.0};
constexpr std::array kSpeedShares{1.0, 0.5};
constexpr std::array kSlowShares{0.6, 0.3, 0.0, -0.4};
constexpr std::array kFlightLengths_m{2.0, 5.0};

// Costs, as seconds of delay.
constexpr double kNoLimit_s = std::numeric_limits<double>::infinity();
constexpr double kCollision_s = 2000.0;  // a metre nearer than the core ...
constexpr double kCollisionMax_m = 0.5;  // ... up to this
constexpr double kCloseness_s = 15.0;    // a second at no clearance at all
constexpr double kFading_s = 40.0;       // what is far ahead may turn out otherwise
constexpr double kAhead_s = 6.0;         // crossing close ahead of something that moves
constexpr double kAheadRange_m = 8.0;
constexpr double kAheadBeside_m = 1.0;
constexpr double kMoving_m_s = 0.05;
constexpr double kBlind_s = 10.0;  // a metre astern, where no sonar looks
constexpr double kToPort_s = 0.5;  // to starboard where nothing else decides

[[nodiscard]] Vec direction(double heading_rad) noexcept {
  return {std::sin(heading_rad), std::cos(heading_rad)};
}

[[nodiscard]] bool is_flight(const Manoeuvre& manoeuvre) noexcept {
  return std::abs(manoeuvre.speed_share) > 1.0;
}

[[nodiscard]] double heading_of(const Vec& way) noexcept { return std::atan2(way.x(), way.y()); }

// The heading that leads along a way in the current, at that speed through the water.
[[nodiscard]] double steered_for(const Vec& way, const OwnMotion& own, double speed_m_s) noexcept {
  if (speed_m_s <= 0.0 || own.current_m_s.squaredNorm() < kStillWater_m_s * kStillWater_m_s) {
    return heading_of(way);
  }
  return heading_of(velocity_for_course(way.normalized(), speed_m_s, own.current_m_s));
}

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
  choice_.of_route = foresee(choice_.manoeuvre, kNoLimit_s, nullptr);
  choice_.foresight = choice_.of_route;
  // With nothing in the way no other manoeuvre is there sooner.
  if (choice_.of_route.delay_s > 0.0) {
    consider_all();
    if (choice_.foresight.run_down) {
      consider_flight();
    }
    stay_with_last();
  }
  choice_.changed = !(choice_.manoeuvre == kept_);
  kept_ = choice_.manoeuvre;
  choice_.way.clear();
  (void)foresee(choice_.manoeuvre, kNoLimit_s, &choice_.way);
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

// Faster than the mission goes, ahead or astern.
void ManoeuvreChooser::consider_flight() noexcept {
  const double share = options_.flight_speed_m_s / response_.speed_max_m_s;
  if (share <= 1.0) {
    return;
  }
  for (const double length_m : kFlightLengths_m) {
    const double for_s = length_m / options_.flight_speed_m_s;
    for (const double sign : {1.0, -1.0}) {
      consider({0.0, for_s, sign * share});
      for (const double offset_deg : kOffsets_deg) {
        consider({to_rad(offset_deg), for_s, sign * share});
      }
    }
  }
}

void ManoeuvreChooser::stay_with_last() noexcept {
  // The manoeuvre under way is left only for one that is better by the stated gain; a flight as
  // soon as anything calmer keeps clear.
  Manoeuvre kept = kept_;
  if (!is_flight(kept)) {
    kept.speed_share = std::min(kept.speed_share, speed_share_max_);
  } else if (!is_flight(choice_.manoeuvre)) {
    return;
  }
  const Foresight of_kept = foresee(kept, kNoLimit_s, nullptr);
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
    // What does not surely move is taken to rest: its doubt would grow for ever.
    hazard.velocity_m_s.setZero();
    hazard.velocity_sigma_m_s = 0.0;
    if (track.surely_moves()) {
      hazard.velocity_sigma_m_s =
          larger_sigma(track.velocity_xx_m2_s2, track.velocity_xy_m2_s2, track.velocity_yy_m2_s2);
      hazard.velocity_m_s = {track.velocity_x_m_s, track.velocity_y_m_s};
    }
    hazard.age_s = to_seconds(now - track.last_seen);
    hazard.place_sigma_m = std::hypot(
        larger_sigma(track.place_xx_m2, track.place_xy_m2, track.place_yy_m2), own_.place_sigma_m);
    enclose(track.shape, hazard.centre, hazard.around_m);
    fastest_m_s = std::max(fastest_m_s, hazard.velocity_m_s.norm());
  }
  horizon_s_ = std::clamp(kHorizon_m / response_.speed_max_m_s, kHorizonMin_s, kHorizonMax_s);
  step_s_ = std::max(kStep_m / (response_.speed_max_m_s + fastest_m_s), horizon_s_ / kSteps_max);
}

void ManoeuvreChooser::consider(const Manoeuvre& manoeuvre) noexcept {
  const Foresight foresight = foresee(manoeuvre, choice_.foresight.cost_s, nullptr);
  if (foresight.cost_s < choice_.foresight.cost_s) {
    choice_.foresight = foresight;
    choice_.manoeuvre = manoeuvre;
  }
}

// One manoeuvre on its way through the future: where the vehicle is, and what it has cost.
struct ManoeuvreChooser::Voyage {
  OwnMotion own;
  RoutePlace place;          // on the route
  double steered_rad = 0.0;  // while the manoeuvre lasts
  double t_s = 0.0;
  double cost_s = 0.0;  // beside the time
  bool arrived = false;
  std::array<double, kMaxObstacles> depth_m{};  // the deepest yet, of each hazard
  Foresight seen;
};

Foresight ManoeuvreChooser::foresee(const Manoeuvre& manoeuvre, double cost_max_s,
                                    Route* way) const noexcept {
  const Route& route = *route_;
  Voyage voyage = set_out(manoeuvre);
  double since_point_m = 0.0;
  if (way != nullptr) {
    (void)way->add(voyage.own.p_W);
  }
  for (int step = 0; step < kSteps_max && voyage.t_s < horizon_s_; ++step) {
    const bool aside = voyage.t_s < manoeuvre.for_s;
    sail_on(manoeuvre, voyage);
    if (voyage.arrived) {
      break;
    }
    meet_hazards(voyage);
    // No cheaper any more than what is known already, however it goes on.
    const double least_left_m = (route.end() - voyage.own.p_W).norm();
    const double fastest_m_s = response_.speed_max_m_s + own_.current_m_s.norm();
    if (voyage.cost_s + voyage.t_s + least_left_m / fastest_m_s > cost_max_s) {
      voyage.seen.cost_s = kNoLimit_s;
      return voyage.seen;
    }
    since_point_m += std::abs(voyage.own.surge_m_s) * step_s_;
    if (way != nullptr && aside && since_point_m >= kWayPoint_m) {
      since_point_m = 0.0;
      (void)way->add(voyage.own.p_W);
    }
  }
  const Vec back = point_at(route, voyage.place);
  const double left_m =
      voyage.arrived ? 0.0 : (back - voyage.own.p_W).norm() + remaining_m(route, voyage.place);
  voyage.seen.delay_s = voyage.cost_s;
  voyage.seen.cost_s = voyage.cost_s + voyage.t_s + left_m / response_.speed_max_m_s;
  if (way != nullptr) {
    return_to_route(*way);
  }
  return voyage.seen;
}

ManoeuvreChooser::Voyage ManoeuvreChooser::set_out(const Manoeuvre& manoeuvre) const noexcept {
  Voyage voyage;
  voyage.own = own_;
  voyage.seen.least_clearance_m = std::numeric_limits<double>::infinity();
  voyage.place = nearest_place(*route_, own_.p_W, {}, std::numeric_limits<double>::infinity());
  const Vec aim = point_ahead(*route_, voyage.place, response_.look_ahead_m) - own_.p_W;
  const double route_rad = aim.norm() > kAim_m ? heading_of(aim) : own_.heading_rad;
  voyage.steered_rad = steered_for(direction(route_rad + manoeuvre.offset_rad), own_,
                                   std::abs(manoeuvre.speed_share) * response_.speed_max_m_s);
  voyage.cost_s = manoeuvre.offset_rad < 0.0 ? kToPort_s : 0.0;
  return voyage;
}

// One step of the vehicle: the manoeuvre's course while it lasts, then along the route.
void ManoeuvreChooser::sail_on(const Manoeuvre& manoeuvre, Voyage& voyage) const noexcept {
  const Route& route = *route_;
  const VehicleResponse& r = response_;
  OwnMotion& own = voyage.own;
  const bool aside = voyage.t_s < manoeuvre.for_s;
  voyage.place = nearest_place(route, own.p_W, voyage.place, 6.0 * r.look_ahead_m);
  const bool at_end =
      (route.end() - own.p_W).norm() < kArrived_m && voyage.place.leg + 2 >= route.count;
  voyage.arrived = at_end && !stay_at_end_;
  if (voyage.arrived) {
    return;
  }
  const bool still = at_end && !aside;
  const Vec aim = point_ahead(route, voyage.place, r.look_ahead_m) - own.p_W;
  const double wanted_rad =
      aside ? voyage.steered_rad : steered_for(aim, own, speed_share_max_ * r.speed_max_m_s);
  const double deviation_rad = wrap_to_pi(wanted_rad - own.heading_rad);
  double speed_m_s = (aside ? manoeuvre.speed_share : speed_share_max_) * r.speed_max_m_s;
  if (still) {
    speed_m_s = 0.0;
  } else if (std::abs(deviation_rad) > kSharpTurn_rad && speed_m_s > 0.0) {
    speed_m_s *= kSharpTurnShare;  // as the controller does
  }
  const double turn_rad_s = std::clamp(r.heading_gain_per_s * deviation_rad, -r.turn_rate_max_rad_s,
                                       r.turn_rate_max_rad_s);
  voyage.t_s += step_s_;
  own.surge_m_s += (speed_m_s - own.surge_m_s) * (1.0 - std::exp(-step_s_ / r.surge_time_s));
  voyage.cost_s += kBlind_s * std::max(0.0, -own.surge_m_s) * step_s_;
  if (still) {
    own.p_W += own.surge_m_s * step_s_ * direction(own.heading_rad);  // held against the current
    return;
  }
  own.heading_rad += turn_rad_s * step_s_;
  own.p_W += step_s_ * (own.surge_m_s * direction(own.heading_rad) + own.current_m_s);
}

// What the obstacles cost where the vehicle is now, wherever they are by then.
void ManoeuvreChooser::meet_hazards(Voyage& voyage) const noexcept {
  const double fading = std::exp(-voyage.t_s / kFading_s);
  for (std::size_t i = 0; i < hazard_count_; ++i) {
    const Hazard& hazard = hazards_[i];
    const double after_s = voyage.t_s + hazard.age_s;
    const double doubt_m = std::min(
        options_.doubt_max_m,
        options_.doubt_sigmas * (hazard.place_sigma_m + hazard.velocity_sigma_m_s * after_s));
    const double wanted_m = options_.clearance_m + doubt_m;
    const double clearance_m = hull_clearance_m(hazard, after_s, voyage.own, wanted_m);
    if (clearance_m < voyage.seen.least_clearance_m) {
      voyage.seen.least_clearance_m = clearance_m;
      voyage.seen.least_after_s = voyage.t_s;
      voyage.seen.least_track = hazard.track->id;
    }
    if (clearance_m < wanted_m) {
      const double lack = (wanted_m - clearance_m) / wanted_m;
      voyage.cost_s += kCloseness_s * lack * lack * fading * step_s_;
    }
    // Graded by its depth, so that a little difference never decides everything.
    const double depth_m = std::min(options_.core_m - clearance_m, kCollisionMax_m);
    if (depth_m > voyage.depth_m[i]) {
      voyage.cost_s += kCollision_s * (depth_m - voyage.depth_m[i]) * fading;
      voyage.depth_m[i] = depth_m;
      voyage.seen.collides = true;
      voyage.seen.run_down |= hazard.velocity_m_s.norm() > kMoving_m_s;
    }
    voyage.cost_s += cost_of_crossing_ahead_s(hazard, after_s, voyage.own) * fading * step_s_;
  }
}

// From the hull, which two discs cover, to an obstacle; beyond wanted_m a lower bound.
double ManoeuvreChooser::hull_clearance_m(const Hazard& hazard, double after_s,
                                          const OwnMotion& own, double wanted_m) const noexcept {
  const double disc_at_m = 0.5 * response_.hull_half_length_m;
  const double disc_m = std::hypot(disc_at_m, response_.hull_half_beam_m);
  const Vec relative = own.p_W - after_s * hazard.velocity_m_s;
  const double bound_m = (relative - hazard.centre).norm() - hazard.around_m - disc_at_m - disc_m;
  if (bound_m > wanted_m) {
    return bound_m;
  }
  const Vec to_disc = disc_at_m * direction(own.heading_rad);
  const Obstacle& shape = hazard.track->shape;
  return std::min(edge_distance_m(shape, {relative + to_disc}),
                  edge_distance_m(shape, {relative - to_disc})) -
         disc_m;
}

// A second close ahead of something that moves, in its way.
double ManoeuvreChooser::cost_of_crossing_ahead_s(const Hazard& hazard, double after_s,
                                                  const OwnMotion& own) noexcept {
  const double speed_m_s = hazard.velocity_m_s.norm();
  if (speed_m_s < kMoving_m_s) {
    return 0.0;
  }
  const Vec from_it = own.p_W - after_s * hazard.velocity_m_s - hazard.centre;
  const Vec its_way = hazard.velocity_m_s / speed_m_s;
  const double along_m = from_it.dot(its_way) - hazard.around_m;
  const double across_m = std::abs(from_it.x() * its_way.y() - from_it.y() * its_way.x());
  const bool in_its_way =
      along_m > 0.0 && along_m < kAheadRange_m && across_m < hazard.around_m + kAheadBeside_m;
  return in_its_way ? kAhead_s * (1.0 - along_m / kAheadRange_m) : 0.0;
}

// From where it was left to the end.
void ManoeuvreChooser::return_to_route(Route& way) const noexcept {
  const RoutePlace back =
      nearest_place(*route_, way.end(), {}, std::numeric_limits<double>::infinity());
  for (std::uint32_t leg = back.leg; leg + 1 < route_->count; ++leg) {
    (void)way.add(route_->points[leg + 1]);
  }
}

}  // namespace lodesman
