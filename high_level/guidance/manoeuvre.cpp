// SPDX-License-Identifier: Apache-2.0
#include "high_level/guidance/manoeuvre.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

constexpr double kStraight = 0.01;   // slower [m/s] sideways and [rad/s] in turning is straight on
constexpr double kWayPoint_m = 0.5;  // between points of the way that is shown

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
  // With nothing in the way no other manoeuvre is there sooner, but where it cannot turn to it.
  if (choice_.of_route.delay_s > 0.0 || choice_.of_route.circles) {
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
      consider({0.0, length_m / response_.cruise.speed_m_s, std::min(share, speed_share_max_)});
    }
  }
  for (const double offset_deg : kOffsets_deg) {
    for (const double length_m : kLengths_m) {
      for (const double share : kSpeedShares) {
        consider({to_rad(offset_deg), length_m / response_.cruise.speed_m_s,
                  std::min(share, speed_share_max_)});
      }
    }
  }
}

// Faster than the mission goes, ahead or astern.
void ManoeuvreChooser::consider_flight() noexcept {
  const double share = options_.flight_speed_m_s / response_.cruise.speed_m_s;
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
  horizon_s_ = std::clamp(kHorizon_m / response_.cruise.speed_m_s, kHorizonMin_s, kHorizonMax_s);
  step_s_ = std::max(kStep_m / (response_.cruise.speed_m_s + fastest_m_s), horizon_s_ / kSteps_max);
  parts_ = static_cast<int>(std::ceil(step_s_ / Rollout::kPartMax_s));
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
  Rollout sailed;
  double cost_s = 0.0;                          // beside the time
  std::array<double, kMaxObstacles> depth_m{};  // the deepest yet, of each hazard
  Foresight seen;
};

Foresight ManoeuvreChooser::foresee(const Manoeuvre& manoeuvre, double cost_max_s,
                                    Route* way) const noexcept {
  const Route& route = *route_;
  Voyage voyage = set_out(manoeuvre);
  double since_point_m = 0.0;
  if (way != nullptr) {
    (void)way->add(voyage.sailed.p_W());
  }
  for (int step = 0; step < kSteps_max && voyage.sailed.after_s() < horizon_s_; ++step) {
    const bool aside = voyage.sailed.is_aside();
    sail_on(voyage);
    if (voyage.sailed.has_arrived()) {
      break;
    }
    meet_hazards(voyage);
    // No cheaper any more than what is known already, however it goes on.
    const double least_left_m = (route.end() - voyage.sailed.p_W()).norm();
    const double fastest_m_s = response_.cruise.speed_m_s + own_.current_m_s.norm();
    if (voyage.cost_s + voyage.sailed.after_s() + least_left_m / fastest_m_s > cost_max_s) {
      voyage.seen.cost_s = kNoLimit_s;
      return voyage.seen;
    }
    since_point_m += std::abs(voyage.sailed.motion().velocity[0]) * step_s_;
    if (way != nullptr && aside && since_point_m >= kWayPoint_m) {
      since_point_m = 0.0;
      (void)way->add(voyage.sailed.p_W());
    }
  }
  const Vec back = point_at(route, voyage.sailed.place());
  const double left_m = voyage.sailed.has_arrived() ? 0.0
                                                    : (back - voyage.sailed.p_W()).norm() +
                                                          remaining_m(route, voyage.sailed.place());
  voyage.seen.circles =
      !voyage.sailed.has_arrived() && !stay_at_end_ &&
      2.0 * route.length_m() < voyage.sailed.after_s() * response_.cruise.speed_m_s;
  voyage.seen.delay_s = voyage.cost_s;
  voyage.seen.cost_s =
      voyage.cost_s + voyage.sailed.after_s() + left_m / response_.cruise.speed_m_s;
  if (way != nullptr) {
    return_to_route(*way);
  }
  return voyage.seen;
}

ManoeuvreChooser::Voyage ManoeuvreChooser::set_out(const Manoeuvre& manoeuvre) const noexcept {
  Voyage voyage{{response_, *route_, own_, manoeuvre, speed_share_max_, stay_at_end_}, 0.0, {}, {}};
  voyage.seen.least_clearance_m = std::numeric_limits<double>::infinity();
  voyage.cost_s = manoeuvre.offset_rad < 0.0 ? kToPort_s : 0.0;
  return voyage;
}

// One step of the vehicle: in parts while it turns or slips.
void ManoeuvreChooser::sail_on(Voyage& voyage) const noexcept {
  Rollout& sailed = voyage.sailed;
  const BodyVelocity& velocity = sailed.motion().velocity;
  const bool straight = std::max(std::abs(velocity[1]), std::abs(velocity[2])) < kStraight;
  // A place that it keeps it may go back to stern first.
  const bool keeps_place = stay_at_end_ && !sailed.is_aside() &&
                           (route_->end() - sailed.p_W()).norm() < response_.look_ahead_m;
  const int parts = straight ? 1 : parts_;
  const double part_s = step_s_ / parts;
  for (int i = 0; i < parts; ++i) {
    sailed.sail(part_s);
    voyage.cost_s += keeps_place ? 0.0 : kBlind_s * std::max(0.0, -velocity[0]) * part_s;
  }
}

// What the obstacles cost where the vehicle is now, wherever they are by then.
void ManoeuvreChooser::meet_hazards(Voyage& voyage) const noexcept {
  const double fading = std::exp(-voyage.sailed.after_s() / kFading_s);
  for (std::size_t i = 0; i < hazard_count_; ++i) {
    const Hazard& hazard = hazards_[i];
    const double after_s = voyage.sailed.after_s() + hazard.age_s;
    const double doubt_m = std::min(
        options_.doubt_max_m,
        options_.doubt_sigmas * (hazard.place_sigma_m + hazard.velocity_sigma_m_s * after_s));
    const double wanted_m = options_.clearance_m + doubt_m;
    const double clearance_m = hull_clearance_m(hazard, after_s, voyage.sailed.motion(), wanted_m);
    if (clearance_m < voyage.seen.least_clearance_m) {
      voyage.seen.least_clearance_m = clearance_m;
      voyage.seen.least_after_s = voyage.sailed.after_s();
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
    voyage.cost_s +=
        cost_of_crossing_ahead_s(hazard, after_s, voyage.sailed.motion()) * fading * step_s_;
  }
}

// From the hull, which two discs cover, to an obstacle; beyond wanted_m a lower bound.
double ManoeuvreChooser::hull_clearance_m(const Hazard& hazard, double after_s,
                                          const VehicleMotion& own,
                                          double wanted_m) const noexcept {
  const double disc_at_m = 0.5 * response_.hull_half_length_m;
  const double disc_m = std::hypot(disc_at_m, response_.hull_half_beam_m);
  const Vec relative = own.position.xy_m - after_s * hazard.velocity_m_s;
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
                                                  const VehicleMotion& own) noexcept {
  const double speed_m_s = hazard.velocity_m_s.norm();
  if (speed_m_s < kMoving_m_s) {
    return 0.0;
  }
  const Vec from_it = own.position.xy_m - after_s * hazard.velocity_m_s - hazard.centre;
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
