// SPDX-License-Identifier: Apache-2.0
#include "high_level/guidance/replanner.h"

#include <chrono>
#include <limits>

#include "high_level/guidance/waypoints.h"

namespace lodesman {
namespace {

// A frame that comes so early is due: frames come with the jitter of the threads that bring them.
constexpr Duration kEarly_max = std::chrono::milliseconds{5};
// Without frames it plans anew so often.
constexpr Duration kAgain = std::chrono::milliseconds{200};
constexpr double kStops_s = 0.4;   // at the way that it has on, what it takes to stop
constexpr double kWay_m_s = 0.25;  // more than that is taken off by thrust astern
constexpr double kAstray_m = 5.0;  // farther than this it is not gone back blindly

[[nodiscard]] VehiclePose pose_of(const VehicleState& state) noexcept {
  return {{{state.x_m, state.y_m}}, Heading::clockwise_from_y_rad(state.heading_rad)};
}

}  // namespace

Replanner::Replanner(const ReplannerOptions& options, std::uint64_t first_id)
    : options_{options}, next_id_{first_id} {
  if (options.pilot) {
    pilot_.emplace(*options.pilot);
  }
}

void Replanner::start(Time now) noexcept {
  if (pilot_) {
    pilot_->start();
  }
  heard_ = now;
  pending_.reset();
  asked_.reset();
  planned_frame_ = 0;
  silence_said_ = false;
  sight_.start();
  stops_at_.reset();
  plan_ = Plan{};
}

void Replanner::keep_sides_of(const PathRequest& last) noexcept {
  if (pilot_) {
    pilot_->keep_sides_of(last);
  }
}

bool Replanner::is_due(Time now, std::uint64_t frame) const noexcept {
  const bool due = !asked_ || now - *asked_ + kEarly_max >= options_.replan_period;
  return due && !pending_ && frame != planned_frame_;
}

bool Replanner::is_due_again(Time now) const noexcept {
  return !pending_ && (!asked_ || now - *asked_ >= kAgain);
}

Destination Replanner::in_sight(Sight sight, const VehicleState& state,
                                const Destination& destination) noexcept {
  Destination there = destination;
  there.slowly = sight != Sight::kNew;
  if (sight != Sight::kLost || destination.stay) {
    stops_at_.reset();
    return there;
  }
  const Eigen::Vector2d p{state.x_m, state.y_m};
  if (!stops_at_ || (stops_at_->xy_m - p).norm() > kAstray_m) {
    stops_at_ = WorldPoint{
        p + kStops_s * velocity_over_ground(state.heading_rad,
                                            {state.surge_m_s, state.sway_m_s, state.yaw_rate_rad_s},
                                            {state.current_x_m_s, state.current_y_m_s})};
  }
  there.goal = *stops_at_;
  there.stay = true;
  there.leg.reset();
  return there;
}

void Replanner::ask(const Pending& pending) noexcept {
  pending_ = pending;
  // Phase is kept against the plan's own clock, so that a late tick does not stretch the period.
  const Time now = pending.asked;
  const bool in_step =
      pending.sight == Sight::kNew && asked_ && now - *asked_ < 2 * options_.replan_period;
  asked_ = in_step ? *asked_ + options_.replan_period : now;
  planned_frame_ = pending.frame;
}

void Replanner::sail_at(const Cruise& cruise) noexcept {
  if (pilot_) {
    pilot_->sail_at(cruise);
  }
}

void Replanner::tune(const Tunables& tunables) noexcept {
  if (pilot_) {
    pilot_->tune(tunables);
  }
}

const PathRequest* Replanner::request(Time now, std::uint64_t frame, Time frame_captured,
                                      const WorldPoint& goal, const PoseHistory& poses) noexcept {
  const auto pose = poses.at(frame_captured);
  if (!is_due(now, frame) || !pose) {
    return nullptr;
  }
  const VehiclePoint goal_V = pose->to_vehicle(goal);  // eqs 3-4
  request_->id = next_id_++;
  request_->frame = frame;
  request_->space = PathSpace::kSonarView;
  request_->goal_x_m = goal_V.xy_m.x();
  request_->goal_y_m = goal_V.xy_m.y();
  ask({request_->id, frame, now, frame_captured, *pose, goal, Sight::kNew});
  return request_.get();
}

const PathRequest* Replanner::request(Time now, const Tracks& tracks, Time seen,
                                      const VehicleState& state,
                                      const Destination& destination) noexcept {
  const Sight sight = sight_.look(now, seen);
  const bool due = sight == Sight::kNew ? is_due(now, tracks.frame) : is_due_again(now);
  if (!pilot_ || !due) {
    return nullptr;
  }
  const Destination there = in_sight(sight, state, destination);
  request_->id = next_id_++;
  request_->frame = tracks.frame;
  pilot_->ask(now, tracks, state, there, *request_);
  ask({request_->id, tracks.frame, now, tracks.captured, pose_of(state), there.goal, sight});
  return request_.get();
}

const Plan* Replanner::answer(Time now, const SonarPath& path) noexcept {
  if (!pending_ || path.request != pending_->id) {
    return nullptr;
  }
  const Pending pending = take_answer(now);
  describe(pending, path.reason);
  if (path.reason == PathReason::kFound) {
    place_waypoints({path.pixels.data(), path.pixel_count}, SonarView{path.range_m}, pending.pose,
                    pending.goal, options_.waypoint_interval_m, plan_);
    plan_.source = WaypointSource::kCurrent;
    plan_.rung = PlanRung::kOnRoute;
    plan_.path_id = plan_.id;
    plan_.path_captured = pending.captured;
  } else {
    keep_previous(now);
  }
  return &plan_;
}

const Plan* Replanner::answer(Time now, const SonarPath& path, const Tracks& tracks,
                              const Coverage* water, const VehicleState& state) noexcept {
  if (!pilot_ || !pending_ || path.request != pending_->id) {
    return nullptr;
  }
  const Pending pending = take_answer(now);
  describe(pending, path.reason);
  pilot_->decide(now, path, tracks, water, state, plan_);
  if (pending.sight != Sight::kNew) {
    plan_.lost_since = pending.captured;
  }
  if (pending.sight == Sight::kLost) {
    plan_.reason = PathReason::kNoFrame;
    take_way_off(state);
  }
  plan_.path_id = plan_.id;
  plan_.path_captured = pending.captured;
  return &plan_;
}

// To where it stops by thrust, but where it makes way for something.
void Replanner::take_way_off(const VehicleState& state) noexcept {
  if (plan_.steer_by == SteerBy::kLine && state.surge_m_s > kWay_m_s) {
    plan_.steer_by = SteerBy::kCourse;
    plan_.course_rad = state.heading_rad;
    plan_.speed_share = -pilot_->most_share();
    plan_.rung = PlanRung::kStop;
  }
}

Replanner::Pending Replanner::take_answer(Time now) noexcept {
  Pending pending = *pending_;
  pending_.reset();
  heard_ = now;
  silence_said_ = false;
  return pending;
}

const Plan* Replanner::silence(Time now, const Missing& missing) noexcept {
  if (pending_ && now - pending_->asked > options_.answer_patience) {
    pending_.reset();
  }
  if (silence_said_ || now - heard_ <= options_.silence_limit) {
    return nullptr;
  }
  silence_said_ = true;
  plan_ = Plan{};
  plan_.id = next_id_++;
  plan_.reason = missing.what;
  plan_.lost_since = missing.since;
  plan_.rung = PlanRung::kNothing;
  if (pilot_) {
    // A pilot's plan is steered by while holding too.
    plan_.steer_by = SteerBy::kLine;
    plan_.clearance_m = std::numeric_limits<double>::infinity();
  }
  return &plan_;
}

void Replanner::keep_previous(Time now) noexcept {
  const bool young =
      plan_.path_id != 0 && now - plan_.path_captured <= options_.previous_path_max_age;
  plan_.rung = young ? PlanRung::kPrevious : PlanRung::kNothing;
  plan_.source = young ? WaypointSource::kPrevious : WaypointSource::kNone;
  if (!young) {
    plan_.waypoint_count = 0;
  }
}

void Replanner::describe(const Pending& pending, PathReason reason) noexcept {
  plan_.id = pending.id;
  plan_.frame = pending.frame;
  plan_.captured = pending.captured;
  plan_.pose_x_m = pending.pose.p_WV.xy_m.x();
  plan_.pose_y_m = pending.pose.p_WV.xy_m.y();
  plan_.pose_heading_rad = pending.pose.heading.rad();
  plan_.goal_x_m = pending.goal.xy_m.x();
  plan_.goal_y_m = pending.goal.xy_m.y();
  plan_.reason = reason;
  plan_.lost_since = Time{};
}

}  // namespace lodesman
