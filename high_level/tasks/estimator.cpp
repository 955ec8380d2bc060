// SPDX-License-Identifier: Apache-2.0
#include "high_level/tasks/estimator.h"

#include <cmath>

namespace lodesman {
namespace {

// No longer than between two steps: nothing was missed.
constexpr Duration kStepped = std::chrono::milliseconds{150};

}  // namespace

EstimatorTask::EstimatorTask(Blackboard& board, Role role, const EstimatorOptions& options)
    : options_{options},
      origin_search_{options.origin_search},
      dead_reckoning_{options.dead_reckoning, options.start},
      surge_{VehicleModel{options.filter.vehicle, options.filter.speeds}},
      drift_{options.current_time},
      filter_{options.filter},
      attitude_{board.attitude},
      position_fix_{board.position_fix},
      world_truth_{board.world_truth},
      thrust_applied_{board.thrust_applied},
      states_{writer_of(board, board.vehicle_state, role)},
      origins_{writer_of(board, board.world_origin, role)},
      memories_{writer_of(board, board.estimator_memory, role)},
      past_{board} {
  Reader<WorldOrigin> before{board.world_origin};
  const auto* found = before.latest();
  if (options_.origin) {
    local_frame_.move_to(*options_.origin);
  } else if (found != nullptr && found->value.source == OriginSource::kFirstFix) {
    local_frame_.move_to({found->value.latitude_deg, found->value.longitude_deg});
    origin_is_told_ = true;
  }
  Reader<EstimatorMemory> memories{board.estimator_memory};
  if (const auto* last = memories.latest(); last != nullptr) {
    legacy_ = last->value;
  }
}

void EstimatorTask::step(Time now) noexcept {
  tell_origin(now);
  take_up(now);
  catch_up(now);
  const auto* attitude = attitude_.fresh(now, max_age::kAttitude);
  // What was not applied did not happen.
  const auto* thrust = thrust_applied_.fresh(now, max_age::kThrustApplied);
  if (attitude == nullptr) {
    coast(now, thrust);
    return;
  }
  const ThrustApplied applied = thrust != nullptr ? thrust->value : ThrustApplied{};
  if (options_.source == PositionSource::kGps) {
    step_filter(now, attitude->value, applied);
  } else {
    step_reckoning(now, attitude->value, applied.surge_ref);
  }
}

void EstimatorTask::tell_origin(Time now) noexcept {
  if (origin_is_told_ || !options_.origin) {
    return;
  }
  origin_is_told_ = true;
  origins_.publish({options_.origin->latitude_deg, options_.origin->longitude_deg}, now);
}

// Where the boat is, and not its antenna: that is what a person takes the place of the start for.
bool EstimatorTask::has_origin(const PositionFix& fix, Heading heading, Time now) noexcept {
  if (local_frame_.is_fixed()) {
    return true;
  }
  if (!origin_search_.take(fix)) {
    return false;
  }
  local_frame_.move_to({fix.latitude_deg, fix.longitude_deg});
  const VehiclePose antenna{WorldPoint{}, heading};
  const GeoPoint boat = local_frame_.to_geo(antenna.to_world({-options_.antenna.xy_m}));
  local_frame_.move_to(boat);
  origins_.publish({boat.latitude_deg, boat.longitude_deg, OriginSource::kFirstFix, fix.sigma_m,
                    fix.measured, fix.utc_ns},
                   now);
  origin_is_told_ = true;
  return true;
}

void EstimatorTask::take_up(Time now) noexcept {
  if (!legacy_) {
    return;
  }
  const EstimatorMemory memory = *legacy_;
  legacy_.reset();
  if (memory.at > now || now - memory.at > kLongestGap) {
    return;
  }
  if (options_.source == PositionSource::kGps) {
    (void)filter_.resume(memory);
    return;
  }
  reckoned_to_ = memory.at;
  if (options_.source == PositionSource::kDeadReckoning) {
    dead_reckoning_.resume(memory.at, {{memory.x_m, memory.y_m}});
  }
  surge_.resume(memory.at, memory.surge_m_s);
  drift_.resume({memory.mean[PoseFilter::kCurrentX], memory.mean[PoseFilter::kCurrentY]});
}

void EstimatorTask::catch_up(Time now) noexcept {
  const bool filters = options_.source == PositionSource::kGps;
  const bool has_begun = filters ? filter_.has_begun() : reckoned_to_ != Time{};
  if (!has_begun) {
    return;
  }
  const Time from = filters ? filter_.advanced_to() : reckoned_to_;
  if (now - from <= kStepped || now - from > kLongestGap) {
    return;
  }
  past_.replay(from, now, [&](const PastInputs::Moment& then) noexcept {
    if (filters && then.attitude != nullptr && then.attitude->measured > filter_.heading_of()) {
      filter_.advance(then.at, then.applied.surge_ref, then.applied.head_ref, *then.attitude);
    } else if (filters) {
      filter_.coast(then.at, then.applied.surge_ref, then.applied.head_ref, then.thrust_is_known);
    } else if (then.attitude != nullptr) {
      (void)surge_.follow(then.at, then.applied.surge_ref);
      if (options_.source == PositionSource::kDeadReckoning) {
        dead_reckoning_.advance(then.at, then.applied.surge_ref,
                                Heading::clockwise_from_y_rad(then.attitude->heading_rad));
      }
    }
  });
}

void EstimatorTask::coast(Time now, const Stamped<ThrustApplied>* thrust) noexcept {
  if (filter_.has_begun() && now - filter_.heading_of() <= kLongestGap) {
    filter_.coast(now, thrust != nullptr ? thrust->value.surge_ref : 0,
                  thrust != nullptr ? thrust->value.head_ref : 0, thrust != nullptr);
  }
}

void EstimatorTask::step_filter(Time now, const Attitude& attitude,
                                const ThrustApplied& applied) noexcept {
  if (filter_.has_begun() && attitude.measured - filter_.heading_of() > kLongestGap) {
    filter_.begin_anew();
  }
  filter_.advance(now, applied.surge_ref, applied.head_ref, attitude);
  take_fixes(now, Heading::clockwise_from_y_rad(attitude.heading_rad));
  if (filter_.knows_position()) {
    publish(filter_.state(), now);
  }
}

void EstimatorTask::take_fixes(Time now, Heading heading) noexcept {
  while (const auto* fix = position_fix_.next()) {
    const PositionFix& f = fix->value;
    if (now - f.measured <= max_age::kPositionFix && has_origin(f, heading, now)) {
      const VehiclePose antenna{local_frame_.to_world({f.latitude_deg, f.longitude_deg}), heading};
      (void)filter_.fix(antenna.to_world({-options_.antenna.xy_m}), f.sigma_m, f.measured);
    }
  }
}

void EstimatorTask::step_reckoning(Time now, const Attitude& attitude, int surge_ref) noexcept {
  const Heading heading = Heading::clockwise_from_y_rad(attitude.heading_rad);
  const double surge_m_s =
      options_.surge_at_once ? dead_reckoning_.speed_m_s(surge_ref) : surge_.follow(now, surge_ref);
  reckoned_to_ = now;
  if (!update_position(now, heading, surge_ref)) {
    return;
  }
  VehicleState state;
  state.valid_at = now;
  const WorldPoint position = dead_reckoning_.position_at(now, surge_ref, heading);
  state.x_m = position.xy_m.x();
  state.y_m = position.xy_m.y();
  state.heading_rad = heading.rad();
  state.surge_m_s = surge_m_s;
  state.yaw_rate_rad_s = attitude.yaw_rate_rad_s;
  state.odometry_x_m = state.x_m;
  state.odometry_y_m = state.y_m;
  state.trust = options_.source == PositionSource::kDeadReckoning ? PositionTrust::kReckoned
                                                                  : PositionTrust::kTracked;
  if (options_.source != PositionSource::kDeadReckoning &&
      options_.current_time > Duration::zero()) {
    const Eigen::Vector2d current_m_s =
        drift_.follow(now, position,
                      surge_m_s * Eigen::Vector2d{std::sin(heading.rad()), std::cos(heading.rad())},
                      attitude.yaw_rate_rad_s);
    state.current_x_m_s = current_m_s.x();
    state.current_y_m_s = current_m_s.y();
  }
  publish(state, now);
}

void EstimatorTask::publish(const VehicleState& state, Time now) noexcept {
  if (sane(state)) {
    states_.publish(state, now);
    remember(state, now);
  } else {
    begin_anew();
  }
}

void EstimatorTask::remember(const VehicleState& state, Time now) noexcept {
  EstimatorMemory memory;
  memory.at = state.valid_at;
  memory.x_m = state.x_m;
  memory.y_m = state.y_m;
  memory.surge_m_s = state.surge_m_s;
  memory.mean[PoseFilter::kCurrentX] = state.current_x_m_s;
  memory.mean[PoseFilter::kCurrentY] = state.current_y_m_s;
  if (options_.source == PositionSource::kGps) {
    filter_.remember(memory);
  }
  memories_.publish(memory, now);
}

void EstimatorTask::begin_anew() noexcept {
  dead_reckoning_ = DeadReckoning{options_.dead_reckoning, options_.start};
  surge_ = Surge{VehicleModel{options_.filter.vehicle, options_.filter.speeds}};
  drift_ = DriftEstimate{options_.current_time};
  filter_.begin_anew();
  reckoned_to_ = Time{};
}

bool EstimatorTask::update_position(Time now, Heading heading, int surge_ref) noexcept {
  if (options_.source == PositionSource::kTruth) {
    const auto* truth = world_truth_.fresh(now, max_age::kWorldTruth);
    if (truth == nullptr) {
      return false;
    }
    dead_reckoning_.correct({{truth->value.x_m, truth->value.y_m}}, 1.0);
    return true;
  }
  dead_reckoning_.advance(now, surge_ref, heading);
  return true;
}

}  // namespace lodesman
