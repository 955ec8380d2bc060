// SPDX-License-Identifier: Apache-2.0
#include "high_level/tasks/estimator.h"

#include <cmath>

namespace lodesman {

EstimatorTask::EstimatorTask(Blackboard& board, Role role, const EstimatorOptions& options)
    : options_{options},
      origin_search_{options.origin_search},
      dead_reckoning_{options.dead_reckoning, options.start},
      surge_{options.surge_lag},
      drift_{options.current_time},
      filter_{options.filter},
      attitude_{board.attitude},
      position_fix_{board.position_fix},
      world_truth_{board.world_truth},
      thrust_applied_{board.thrust_applied},
      states_{writer_of(board, board.vehicle_state, role)},
      origins_{writer_of(board, board.world_origin, role)} {
  Reader<WorldOrigin> before{board.world_origin};
  const auto* found = before.latest();
  if (options_.origin) {
    local_frame_.move_to(*options_.origin);
  } else if (found != nullptr && found->value.source == OriginSource::kFirstFix) {
    local_frame_.move_to({found->value.latitude_deg, found->value.longitude_deg});
    origin_is_told_ = true;
  }
}

void EstimatorTask::step(Time now) noexcept {
  tell_origin(now);
  const auto* attitude = attitude_.fresh(now, max_age::kAttitude);
  if (attitude == nullptr) {
    return;
  }
  // What was not applied did not happen.
  const auto* thrust = thrust_applied_.fresh(now, max_age::kThrustApplied);
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

void EstimatorTask::step_filter(Time now, const Attitude& attitude,
                                const ThrustApplied& applied) noexcept {
  filter_.advance(now, applied.surge_ref, applied.head_ref, attitude);
  const Heading heading = Heading::clockwise_from_y_rad(attitude.heading_rad);
  while (const auto* fix = position_fix_.next()) {
    const PositionFix& f = fix->value;
    if (now - f.measured <= max_age::kPositionFix && has_origin(f, heading, now)) {
      const VehiclePose antenna{local_frame_.to_world({f.latitude_deg, f.longitude_deg}), heading};
      (void)filter_.fix(antenna.to_world({-options_.antenna.xy_m}), f.sigma_m, f.measured);
    }
  }
  if (filter_.knows_position()) {
    publish(filter_.state(), now);
  }
}

void EstimatorTask::step_reckoning(Time now, const Attitude& attitude, int surge_ref) noexcept {
  const Heading heading = Heading::clockwise_from_y_rad(attitude.heading_rad);
  const double surge_m_s = surge_.follow(now, dead_reckoning_.speed_m_s(surge_ref));
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
    const Eigen::Vector2d current_m_s = drift_.follow(
        now, position,
        surge_m_s * Eigen::Vector2d{std::sin(heading.rad()), std::cos(heading.rad())});
    state.current_x_m_s = current_m_s.x();
    state.current_y_m_s = current_m_s.y();
  }
  publish(state, now);
}

void EstimatorTask::publish(const VehicleState& state, Time now) noexcept {
  if (sane(state)) {
    states_.publish(state, now);
  } else {
    begin_anew();
  }
}

void EstimatorTask::begin_anew() noexcept {
  dead_reckoning_ = DeadReckoning{options_.dead_reckoning, options_.start};
  surge_ = Lag{options_.surge_lag};
  drift_ = DriftEstimate{options_.current_time};
  filter_.begin_anew();
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
