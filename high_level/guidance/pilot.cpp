// SPDX-License-Identifier: Apache-2.0
#include "high_level/guidance/pilot.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mid_level/geometry/obstacle_distance.h"

namespace lodesman {
namespace {

using Vec = Eigen::Vector2d;

constexpr double kOutside_m = 0.02;  // a start nearer than this to a zone is put outside it
constexpr double kAtPlace_m = 0.8;   // so near to a place to wait at is there
constexpr double kClose_m = 4.0;     // so near to a goal that zones made room for it is slow
constexpr double kSeenEnough_m = std::numeric_limits<double>::infinity();
constexpr double kFar_m = 0.95 * kPathReach_m;  // farther goals are asked for on the way

// A goal, or where the straight way to one that is far comes through.
[[nodiscard]] Vec within_reach(const Vec& from, const Vec& goal) noexcept {
  const double distance_m = (goal - from).norm();
  return distance_m > kFar_m ? from + kFar_m / distance_m * (goal - from) : goal;
}

// Along the axis that it is the least known on.
[[nodiscard]] double largest_sigma_m(const VehicleState& state) noexcept {
  const double middle_m2 = 0.5 * (state.position_xx_m2 + state.position_yy_m2);
  const double apart_m2 =
      std::hypot(0.5 * (state.position_xx_m2 - state.position_yy_m2), state.position_xy_m2);
  return std::sqrt(middle_m2 + apart_m2);
}

}  // namespace

Pilot::Pilot(const PilotOptions& options)
    : options_{options},
      look_ahead_at_rest_m_{options.response.look_ahead_m},
      chooser_{options.response, options.manoeuvres} {}

void Pilot::start() noexcept {
  chooser_.forget();
  side_count_ = 0;
  holding_ = false;
  best_.reset();
  line_.reset();
  last_line_ = {};
  free_asks_ = 0;
  route_.clear();
}

void Pilot::keep_sides_of(const PathRequest& last) noexcept {
  for (std::uint32_t i = 0; i < last.zone_count; ++i) {
    const PathZone& zone = last.zones[i];
    if (zone.shape.id != 0 && zone.may_keep_to_port != zone.may_keep_to_starboard) {
      sides_[side_count_++] = {zone.shape.id,
                               zone.may_keep_to_port ? Side::kPort : Side::kStarboard};
    }
  }
}

void Pilot::sail_at(const Cruise& cruise) noexcept {
  options_.response.cruise = cruise;
  options_.response.look_ahead_m = look_ahead_at_rest_m_ + options_.look_ahead_s * cruise.speed_m_s;
  chooser_.set(options_.response, options_.manoeuvres);
}

void Pilot::tune(const Tunables& tunables) noexcept {
  options_.zones.margin_m = tunables.margin_m;
  options_.side_gain_m = tunables.side_gain_m;
  options_.manoeuvres.switch_gain_s = tunables.manoeuvre_gain_s;
  options_.response.steering.heading_gain_per_deg = tunables.heading_gain_per_deg;
  chooser_.set(options_.response, options_.manoeuvres);
}

OwnMotion Pilot::when_it_takes_effect(Time now, const VehicleState& state) const noexcept {
  OwnMotion own{{state.x_m, state.y_m},
                state.heading_rad,
                state.surge_m_s,
                state.sway_m_s,
                state.yaw_rate_rad_s,
                {state.current_x_m_s, state.current_y_m_s},
                options_.zones.own_doubt_share * largest_sigma_m(state)};
  const double ahead_s = to_seconds(now - state.valid_at + options_.latency);
  own.p_W += ahead_s * velocity_over_ground(own.heading_rad,
                                            {own.surge_m_s, own.sway_m_s, own.yaw_rate_rad_s},
                                            own.current_m_s);
  own.heading_rad += ahead_s * own.yaw_rate_rad_s;
  return own;
}

void Pilot::ask(Time now, const Tracks& tracks, const VehicleState& state,
                const Destination& destination, PathRequest& request) noexcept {
  const Vec& goal = destination.goal.xy_m;
  if (goal != best_for_W_) {
    // Another waypoint, or a place to hold: all this stood for the last goal.
    best_.reset();
    route_.clear();
    last_line_ = {};
    free_asks_ = 0;
    best_for_W_ = goal;
  }
  const OwnMotion own = when_it_takes_effect(now, state);
  own_W_ = own.p_W;
  request.space = PathSpace::kWorld;
  request.side_gain_m = options_.side_gain_m;
  make_zones(options_.zones, options_.response.model, tracks, now, own_W_,
             options_.response.cruise.speed_m_s, request, own.place_sigma_m);
  Vec start = own_W_;
  escaping_ = false;
  const double clear_m = zone_clearance_m(request, start);
  if (clear_m < kOutside_m) {
    if (const auto out = way_out(request, start)) {
      start = *out;
      escaping_ = clear_m < -kSlightly_m;
    }
  }
  asked_for_best_ = asks_for_best();
  keep_line(destination, clear_m >= kOutside_m, request);
  if (line_ && line_->line.leave_m > line_->line.along_m) {
    start = line_->leg.at(line_->line.leave_m);
  }
  const Vec end = end_of_ask(destination, start, request);
  request.start_x_m = start.x();
  request.start_y_m = start.y();
  request.goal_x_m = end.x();
  request.goal_y_m = end.y();
  ask_for_sides(request);
  *asked_ = request;
}

void Pilot::keep_line(const Destination& destination, bool start_is_free,
                      const PathRequest& request) noexcept {
  line_.reset();
  if (!destination.leg || best_) {
    return;
  }
  if (free_asks_ > 0) {
    --free_asks_;
    return;
  }
  last_line_ = line_to_keep(*destination.leg, request, own_W_, last_line_);
  line_ = KeptLine{*destination.leg, last_line_, last_line_.rejoin_m < destination.leg->length_m()};
  if (!start_is_free) {
    line_->line.leave_m = line_->line.along_m;
    line_->line.is_clear = false;
  }
}

// The goal, what is near it where it lies in a zone, or on the way to it: where the line is gone
// back to, the best point that can be reached, or what is not too far.
Vec Pilot::end_of_ask(const Destination& destination, const Vec& start,
                      PathRequest& request) noexcept {
  const Vec& goal = destination.goal.xy_m;
  stay_ = destination.stay;
  slowly_ = destination.slowly;
  goal_moved_ = false;
  goal_is_close_ = false;
  if (asked_for_best_) {
    return *best_;
  }
  if (line_ && line_->rejoins) {
    return within_reach(own_W_, line_->leg.at(line_->line.rejoin_m));
  }
  Vec end = within_reach(own_W_, goal);
  const bool far = end != goal;
  stay_ = stay_ && !far;
  goal_is_close_ = make_room(request, end);
  if (zone_clearance_m(request, end) < 0.0) {
    // Where it waits it may turn: a zone leaves room for half the beam, not half the length.
    const double room_m = options_.response.hull_half_length_m - options_.zones.hull_radius_m;
    if (const auto free = nearest_free(request, end, start, std::max(kOutside_m, room_m))) {
      goal_moved_ = !far;
      return *free;
    }
  }
  return end;
}

void Pilot::ask_for_sides(PathRequest& request) const noexcept {
  for (std::uint32_t i = 0; i < request.zone_count; ++i) {
    PathZone& zone = request.zones[i];
    for (std::size_t k = 0; k < side_count_; ++k) {
      if (sides_[k].track == zone.shape.id) {
        zone.may_keep_to_port = sides_[k].side != Side::kStarboard;
        zone.may_keep_to_starboard = sides_[k].side != Side::kPort;
      }
    }
  }
}

void Pilot::decide(Time now, const SonarPath& path, const Tracks& tracks, const Coverage* water,
                   const VehicleState& state, Plan& plan) noexcept {
  const PathReason reason = take_route(path);
  const OwnMotion own = when_it_takes_effect(now, state);
  const RoutePlace place = nearest_place(route_, own.p_W, {}, 1e9);
  plan.narrow = route_is_narrow_ || (goal_is_close_ && (route_.end() - own.p_W).norm() < kClose_m);
  plan.seen_ahead_m = seen_along(water, route_, place);
  const double share = std::min(share_by_sight(plan.seen_ahead_m),
                                plan.narrow || slowly_ ? options_.narrow_speed_share : 1.0);
  const auto& choice = chooser_.choose(now, own, route_, tracks, share, stay_at_end_);
  plan.waypoint_count = 0;
  for (std::uint32_t i = 0; i < choice.way.count && plan.waypoint_count < kMaxWaypoints; ++i) {
    plan.waypoints[plan.waypoint_count++] = {choice.way.points[i].x(), choice.way.points[i].y()};
  }
  plan.source = WaypointSource::kCurrent;
  plan.stay_at_end = stay_at_end_;
  const bool aside = choice.manoeuvre.for_s > 0.0;
  if (line_ && !aside) {
    // From abeam, not from where the boat is: else it would never be off its line.
    const Vec abeam = point_at(route_, place);
    plan.waypoints[0] = {abeam.x(), abeam.y()};
  }
  const Vec aim = point_ahead(route_, place, options_.response.look_ahead_m) - own.p_W;
  const double route_rad = aim.norm() > kAim_m ? std::atan2(aim.x(), aim.y()) : own.heading_rad;
  plan.steer_by = aside ? SteerBy::kCourse : SteerBy::kLine;
  plan.course_rad = wrap_to_pi(route_rad + (aside ? choice.manoeuvre.offset_rad : 0.0));
  plan.speed_share = choice.manoeuvre.speed_share;
  if (aside && plan.speed_share > 0.0 && plan.speed_share <= 1.0) {  // what flees does not stop
    plan.seen_ahead_m = seen_along(water, choice.way, {});
    plan.speed_share = std::min(plan.speed_share, share_by_sight(plan.seen_ahead_m));
  }
  const double left_m = (route_.end() - own.p_W).norm();
  const bool held = holding_;
  holding_ = stay_at_end_ && !aside && left_m < (holding_ ? kDrifted_m : kAtPlace_m);
  if (holding_ && !held && reason == PathReason::kNoPath) {
    wait_here(own.p_W);
  }
  if (holding_) {
    // It faces what it waits for, so that it sees when that is clear.
    const Vec goal = Vec{plan.goal_x_m, plan.goal_y_m} - own.p_W;
    const double is_there_m =
        reason == PathReason::kFound && !goal_moved_ ? kDrifted_m : kAtPlace_m;
    plan.course_rad = goal.norm() > is_there_m ? std::atan2(goal.x(), goal.y()) : own.heading_rad;
  }
  explain(reason, path, choice, plan);
}

// Where nothing leads on any place near the best one does, and to stay is better than to move about
// for the last half metre: who waits looks at what it waits for.
void Pilot::wait_here(const Vec& place) noexcept {
  best_ = place;
  route_.clear();
  (void)route_.add(place);
  (void)route_.add(place);
}

double Pilot::seen_along(const Coverage* water, const Route& way, RoutePlace from) const noexcept {
  const double needed_m =
      sight_needed_m(options_.sight, options_.response.model, options_.response.cruise.speed_m_s);
  const double seen_m =
      water != nullptr && way.count > 1
          ? seen_ahead_m(*water, way, from, options_.response.hull_half_beam_m, needed_m)
          : needed_m;
  return seen_m < needed_m ? seen_m : kSeenEnough_m;
}

// [-] of the mission's speed, that so much of the way allows.
double Pilot::share_by_sight(double seen_m) const noexcept {
  const double most_m_s = options_.response.cruise.speed_m_s;
  return most_m_s > 0.0
             ? speed_by_sight_m_s(options_.sight, options_.response.model, seen_m, most_m_s) /
                   most_m_s
             : 1.0;
}

void Pilot::explain(PathReason reason, const SonarPath& path,
                    const ManoeuvreChooser::Choice& choice, Plan& plan) const noexcept {
  const PathReason found = asked_for_best_ ? PathReason::kNoPath : reason;
  plan.reason = escaping_                                    ? PathReason::kStartBlocked
                : goal_moved_ && found == PathReason::kFound ? PathReason::kGoalBlocked
                                                             : found;
  plan.changed = choice.changed || path.sides_changed;
  // Of a manoeuvre the cause is what following the route would come to.
  const Manoeuvre& manoeuvre = choice.manoeuvre;
  const Foresight& cause = manoeuvre.for_s > 0.0 ? choice.of_route : choice.foresight;
  plan.cause = cause.least_track;
  plan.clearance_m = cause.least_clearance_m;
  plan.clearance_after_s = cause.least_after_s;
  const bool must_slow = plan.narrow || slowly_ || plan.seen_ahead_m < kSeenEnough_m;
  const double full_share = plan.narrow || slowly_ ? options_.narrow_speed_share : 1.0;
  const bool aside = manoeuvre.for_s > 0.0;
  if (aside && manoeuvre.speed_share <= 0.0) {
    plan.rung = PlanRung::kStop;
  } else if (aside && std::abs(manoeuvre.offset_rad) > 0.0) {
    plan.rung = PlanRung::kAside;
  } else if (holding_) {
    plan.rung = PlanRung::kHold;
  } else if (manoeuvre.speed_share < full_share) {
    plan.rung = PlanRung::kSlow;
  } else if (escaping_) {
    plan.rung = PlanRung::kEscape;
  } else if (found != PathReason::kFound && stay_at_end_) {
    plan.rung = PlanRung::kBestPoint;
  } else if (goal_moved_) {
    plan.rung = PlanRung::kNearGoal;
  } else {
    plan.rung = must_slow ? PlanRung::kSlow : PlanRung::kOnRoute;
  }
}

}  // namespace lodesman
