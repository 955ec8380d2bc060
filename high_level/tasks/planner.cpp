// SPDX-License-Identifier: Apache-2.0
#include "high_level/tasks/planner.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "high_level/guidance/areas.h"

namespace lodesman {
namespace {

constexpr double kStay_m = 1.5;  // a place to wait at is kept within this

[[nodiscard]] bool has_no_thrust(ThrustReason reason) noexcept {
  return reason == ThrustReason::kDeviceFailed || reason == ThrustReason::kNoThrusters;
}
[[nodiscard]] bool is_off(ThrustState state) noexcept {
  return state == ThrustState::kDisarmed || state == ThrustState::kStopped;
}
[[nodiscard]] bool is_for_mission(const OperatorCommand& order) noexcept {
  return order.order != OperatorOrder::kNone && order.order != OperatorOrder::kAbort;
}
[[nodiscard]] bool may_not_turn(ThrustReason reason) noexcept {
  return reason == ThrustReason::kDisarmed || reason == ThrustReason::kStopped;
}

// A frame is given its full age before its absence counts.
[[nodiscard]] ReplannerOptions with_silence_limit(ReplannerOptions options) noexcept {
  options.silence_limit = options.replan_period + max_age::kSonarFrame;
  return options;
}

// Above those of a program that was here before, so that a late answer to it fits no question.
[[nodiscard]] std::uint64_t first_free_id(const Blackboard& board) {
  Reader<Plan> plans{board.plan};
  Reader<PathRequest> requests{board.path_request};
  const auto* plan = plans.latest();
  const auto* request = requests.latest();
  return 1 +
         std::max(plan != nullptr ? plan->value.id : 0, request != nullptr ? request->value.id : 0);
}

}  // namespace

PlannerTask::PlannerTask(Blackboard& board, Role role, PlannerOptions options)
    : options_{std::move(options)},
      mission_{options_.mission},
      replanner_{with_silence_limit(options_.replanner), first_free_id(board)},
      progress_{options_.progress},
      definitions_{board.mission_definition},
      orders_{board.operator_command},
      link_{board.command_link},
      tunables_{board.tunables},
      vehicle_state_{board.vehicle_state},
      obstacles_{board.sonar_obstacles},
      tracks_{board.tracks},
      coverage_{board.coverage},
      sonar_path_{board.sonar_path},
      attitude_{board.attitude},
      position_fix_{board.position_fix},
      plan_{board.plan},
      helm_{board.helm_command},
      thrust_applied_{board.thrust_applied},
      thrust_status_{board.thrust_status},
      requests_{writer_of(board, board.path_request, role)},
      plans_{writer_of(board, board.plan, role)},
      statuses_{writer_of(board, board.mission_status, role)} {
  look_for_legacy(board);
}

void PlannerTask::look_for_legacy(Blackboard& board) {
  Reader<MissionStatus> before{board.mission_status};
  if (const auto* last = before.latest(); last != nullptr) {
    legacy_.said = last->value;
    legacy_said_ = last->stamp;
  }
  // Orders from before this program started are not for it, but an abort stands.
  std::uint64_t aborts = 0;
  while (const auto* order = orders_.next()) {
    aborts = std::max(aborts, order->value.aborts);
    legacy_.order_unanswered |=
        is_for_mission(order->value) && order->sequence > legacy_.said.order;
  }
  if (mission_.inherit(legacy_.said, aborts)) {
    legacy_said_ = Time{};
  }
  Reader<MissionDefinition> definitions{board.mission_definition};
  while (const auto* definition = definitions.next()) {
    if (definition->value.id == legacy_.said.mission && definition->value.goal_count > 0) {
      legacy_mission_ = std::make_unique<MissionDefinition>(definition->value);
      legacy_.policy = definition->value.on_restart;
      legacy_.mission_is_known = true;
    }
  }
  Reader<ThrustStatus> arming{board.thrust_status};
  Reader<ThrustApplied> applied{board.thrust_applied};
  const auto* thrust = arming.latest();
  const auto* told = applied.latest();
  legacy_.thrusters_are_off = thrust != nullptr && is_off(thrust->value.state) &&
                              (told == nullptr || told->value.reason != ThrustReason::kNoThrusters);
  Reader<PathRequest> requests{board.path_request};
  if (const auto* request = requests.latest(); request != nullptr) {
    legacy_request_ = std::make_unique<PathRequest>(request->value);
  }
  // What a frame shows is placed by the poses of before as by its own.
  Reader<VehicleState> poses{board.vehicle_state};
  while (const auto* state = poses.next()) {
    poses_.add(state->value);
  }
}

void PlannerTask::take_up(Time now) noexcept {
  if (legacy_said_ == Time{}) {
    return;
  }
  legacy_.silence = now - legacy_said_;
  legacy_said_ = Time{};
  const Succession next = succession_of(legacy_);
  if (next.state == MissionState::kIdle || !legacy_mission_) {
    return;
  }
  // The place to hold is where the boat is, once that is known; until then nothing is steered by.
  const bool to_be_held =
      legacy_.said.state == MissionState::kUnderWay && next.state == MissionState::kHolding;
  mission_.take_up(legacy_.said, *legacy_mission_,
                   to_be_held ? Succession{MissionState::kUnderWay, next.cause} : next, now);
  started_ = mission_.status().started;
  replanner_.start(now);
  if (legacy_request_) {
    replanner_.keep_sides_of(*legacy_request_);
  }
  progress_.start(now);
  was_absent_ = to_be_held;
  absent_by_ = next.cause;
}

void PlannerTask::step(Time now) noexcept {
  take_up(now);
  const auto* frame = obstacles_.latest();
  frame_is_new_ = frame != nullptr && frame->sequence != frame_sequence_;
  frame_sequence_ = frame != nullptr ? frame->sequence : 0;
  const auto* state = vehicle_state_.fresh(now, max_age::kVehicleState);
  if (state != nullptr) {
    poses_.add(state->value);
    position_ = {{state->value.x_m, state->value.y_m}};
  }
  hold_after_absence(now, state != nullptr);
  take_tunables();
  take_orders(now);
  watch_link(now);
  watch_thrusters(now);
  sail_as_the_mission_says(now);
  if (state != nullptr) {
    mission_.advance(position_, now);
    mission_.watch_blocked(goal_outlook(), position_, now);
  }
  // Places are held by the pilot alone; the paper knows nothing of it.
  const bool sails = mission_.under_way() && !was_absent_;
  if (sails || (mission_.holding() && options_.replanner.pilot)) {
    replan(now);
  }
  watch_progress(now);
  MissionStatus status = mission_.status();
  status.no_way = no_way_;
  status.no_way_since = no_way_ == NoWayCause::kNone ? Time{} : progress_.since();
  // What the program before this one said of its line is not to stand.
  const auto line = leg();
  status.keeps_line = line.has_value();
  status.line_begin_x_m = line ? line->from_W.x() : 0.0;
  status.line_begin_y_m = line ? line->from_W.y() : 0.0;
  status.cross_track_m = line ? line->cross_track_m(position_.xy_m) : 0.0;
  tell(status, now);
}

// Its state is news to who waits for it, that it still stands is none.
void PlannerTask::tell(const MissionStatus& status, Time now) noexcept {
  if (status.state == told_state_) {
    statuses_.publish_quietly(status, now);
  } else {
    statuses_.publish(status, now);
    told_state_ = status.state;
  }
}

void PlannerTask::hold_after_absence(Time now, bool estimate_is_fresh) noexcept {
  const bool absent = stepped_ != Time{} && now - stepped_ > kLongestAbsence;
  stepped_ = now;
  absent_by_ = absent ? MissionCause::kAbsence : absent_by_;
  was_absent_ = (was_absent_ || absent) && mission_.under_way();
  if (was_absent_ && estimate_is_fresh) {
    was_absent_ = false;
    mission_.hold(position_, absent_by_);
  }
}

void PlannerTask::take_orders(Time now) noexcept {
  while (const auto* order = orders_.next()) {
    // What an order names was published before it.
    if (const auto* definition = definitions_.latest(); definition != nullptr) {
      mission_.set_at_hand(definition->value);
    }
    mission_.take({order->value, order->sequence, order->stamp}, position_, now);
  }
}

void PlannerTask::take_tunables() noexcept {
  const auto* tunables = tunables_.latest();
  if (tunables == nullptr || tunables->value.version == tuned_) {
    return;
  }
  tuned_ = tunables->value.version;
  mission_.limit_speed(tunables->value.speed_limit_m_s);
  replanner_.tune(tunables->value);
}

void PlannerTask::watch_link(Time now) noexcept {
  if (const auto* link = link_.latest(); link != nullptr) {
    mission_.watch_link(link->value, position_, now);
  }
}

// What was off when the mission was started is armed by the start itself, or the boat sails dry.
void PlannerTask::watch_thrusters(Time now) noexcept {
  const auto* thrust = thrust_status_.latest();
  const auto* applied = thrust_applied_.latest();
  const bool none = applied != nullptr && applied->value.reason == ThrustReason::kNoThrusters;
  if (thrust != nullptr && !none && is_off(thrust->value.state) &&
      thrust->value.cause != ThrustCause::kOrder &&
      thrust->value.since > mission_.status().started) {
    mission_.end_disarmed(now);
  }
}

// Of a plan for that goal alone.
GoalOutlook PlannerTask::goal_outlook() noexcept {
  const auto* newest = plan_.latest();
  const WorldPoint goal = mission_.goal();
  if (newest == nullptr || newest->stamp < mission_.status().started ||
      Eigen::Vector2d{newest->value.goal_x_m, newest->value.goal_y_m} != goal.xy_m) {
    return GoalOutlook::kOpen;
  }
  const Plan& plan = newest->value;
  const bool no_way = plan.stay_at_end && (plan.reason == PathReason::kNoPath ||
                                           plan.reason == PathReason::kGoalBlocked);
  if (!no_way) {
    return GoalOutlook::kOpen;
  }
  return plan.rung == PlanRung::kHold ? GoalOutlook::kAwaited : GoalOutlook::kBlocked;
}

// A start, or another speed.
void PlannerTask::sail_as_the_mission_says(Time now) noexcept {
  const MissionStatus& status = mission_.status();
  if (status.surge_ref != surge_ref_) {
    surge_ref_ = status.surge_ref;
    replanner_.sail_at({status.surge_ref, status.speed_m_s});
    progress_.sail_at(status.speed_m_s);
  }
  if (status.started != started_) {
    started_ = status.started;
    was_absent_ = false;
    replanner_.start(now);
    progress_.start(now);
  }
}

void PlannerTask::replan(Time now) noexcept {
  if (options_.replanner.pilot) {
    replan_in_world(now);
  } else {
    replan_in_view(now);
  }
  publish(replanner_.silence(now, missing(now)), now);
}

void PlannerTask::replan_in_view(Time now) noexcept {
  if (const auto* path = sonar_path_.latest(); path != nullptr) {
    publish(replanner_.answer(now, path->value), now);
  }
  // One that has just come: what is planned in an older one is that much later on its way.
  const auto* frame = obstacles_.fresh(now, max_age::kSonarFrame);
  if (frame == nullptr || !frame_is_new_) {
    return;
  }
  const auto* request =
      replanner_.request(now, frame->value.frame, frame->value.captured, mission_.goal(), poses_);
  if (request != nullptr) {
    requests_.publish(*request, now);
  }
}

void PlannerTask::replan_in_world(Time now) noexcept {
  const auto* state = vehicle_state_.fresh(now, max_age::kVehicleState);
  const auto* tracks = tracks_.latest();
  if (state == nullptr || tracks == nullptr) {
    return;
  }
  const Tracks& water = with_areas(tracks->value, state->value, now);
  if (const auto* path = sonar_path_.latest(); path != nullptr) {
    publish(replanner_.answer(now, path->value, water, seen_water(), state->value), now);
  }
  const Destination there{mission_.goal(), mission_.holding(), leg()};
  const auto* request = replanner_.request(now, water, tracks->stamp, state->value, there);
  if (request != nullptr) {
    requests_.publish(*request, now);
  }
}

std::optional<Leg> PlannerTask::leg() const noexcept {
  const auto begin = mission_.line_begin();
  return begin && options_.replanner.pilot ? std::optional{Leg{begin->xy_m, mission_.goal().xy_m}}
                                           : std::nullopt;
}

const Tracks& PlannerTask::with_areas(const Tracks& t, const VehicleState& own, Time now) noexcept {
  const MissionDefinition& mission = mission_.definition();
  if (mission.area_count == 0) {
    return t;
  }
  *water_ = t;
  add_areas(areas_of(mission), now, own, *water_);
  return *water_;
}

Missing PlannerTask::missing(Time now) noexcept {
  const auto* attitude = attitude_.latest();
  if (attitude != nullptr && attitude_.fresh(now, max_age::kAttitude) == nullptr) {
    return {PathReason::kNoHeading, attitude_.latest()->value.measured};
  }
  const auto* state = vehicle_state_.latest();
  if (state != nullptr && vehicle_state_.fresh(now, max_age::kVehicleState) == nullptr) {
    const auto* fix = position_fix_.latest();
    return {PathReason::kNoPosition,
            fix != nullptr ? fix->value.measured : vehicle_state_.latest()->value.valid_at};
  }
  const auto* frame = obstacles_.latest();
  return {PathReason::kNoFrame, frame != nullptr ? frame->value.captured : Time{}};
}

void PlannerTask::watch_progress(Time now) noexcept {
  no_way_ = progress_.update(now, progress_sample(now));
}

ProgressSample PlannerTask::progress_sample(Time now) noexcept {
  ProgressSample sample;
  const auto* state = vehicle_state_.fresh(now, max_age::kVehicleState);
  const auto* plan = plan_.latest();
  const auto* helm = helm_.latest();
  const auto* thrust = thrust_applied_.fresh(now, max_age::kThrustApplied);
  if (state != nullptr) {
    sample.position = WorldPoint{{state->value.x_m, state->value.y_m}};
    sample.through_water_m_s = state->value.surge_m_s;
  }
  const bool planned = plan != nullptr && plan->stamp >= mission_.status().started;
  double to_waypoint_m = 0.0;
  if (planned && helm != nullptr && sample.position) {
    const Eigen::Vector2d way =
        Eigen::Vector2d{helm->value.waypoint_x_m, helm->value.waypoint_y_m} - sample.position->xy_m;
    to_waypoint_m = way.norm();
    sample.course =
        plan->value.steer_by == SteerBy::kCourse
            ? Eigen::Vector2d{std::sin(plan->value.course_rad), std::cos(plan->value.course_rad)}
            : way.normalized();
  }
  sample.wanted =
      mission_.under_way() && (!planned || wants_way(plan->value, sample, to_waypoint_m));
  if (attitude_.fresh(now, max_age::kAttitude) == nullptr) {
    sample.cause = NoWayCause::kNoHeading;
  } else if (state == nullptr) {
    sample.cause = NoWayCause::kNoPosition;
  } else if (thrust == nullptr || has_no_thrust(thrust->value.reason)) {
    sample.cause = NoWayCause::kThrusters;
  } else if (may_not_turn(thrust->value.reason)) {
    sample.cause = NoWayCause::kDisarmed;
  } else if (!planned || plan->value.waypoint_count == 0) {
    sample.cause = NoWayCause::kNoPlan;
  } else if (plan->value.reason == PathReason::kNoFrame) {
    sample.cause = NoWayCause::kNoSonar;
  }
  return sample;
}

// To wait is a decision: it may be a long one, and its reason stands in the plan. Without sonar it
// is none.
bool PlannerTask::wants_way(const Plan& plan, const ProgressSample& sample,
                            double to_waypoint_m) const noexcept {
  const bool waits = plan.rung == PlanRung::kStop || plan.rung == PlanRung::kHold ||
                     (plan.waypoint_count > 0 && plan.speed_share <= 0.0);
  const bool stays = plan.stay_at_end && sample.position && to_waypoint_m < kStay_m;
  return (!waits && !stays) || plan.reason == PathReason::kNoFrame;
}

void PlannerTask::publish(const Plan* plan, Time now) noexcept {
  if (plan != nullptr) {
    plans_.publish(*plan, now);
  }
}

}  // namespace lodesman
