// SPDX-License-Identifier: Apache-2.0
#include "high_level/tasks/estimator.h"

#include <cmath>

namespace lodesman {

EstimatorTask::EstimatorTask(Blackboard& board, Role role, const EstimatorOptions& options)
    : options_{options},
      local_frame_{options.origin},
      dead_reckoning_{options.dead_reckoning, options.start},
      surge_{options.surge_lag},
      drift_{options.current_time},
      attitude_{board.attitude},
      position_fix_{board.position_fix},
      world_truth_{board.world_truth},
      thrust_applied_{board.thrust_applied},
      states_{writer_of(board, board.vehicle_state, role)} {}

void EstimatorTask::step(Time now) noexcept {
  const auto* attitude = attitude_.fresh(now, max_age::kAttitude);
  if (attitude == nullptr) {
    return;
  }
  const Heading heading = Heading::clockwise_from_y_rad(attitude->value.heading_rad);
  const auto* thrust = thrust_applied_.fresh(now, max_age::kThrustApplied);
  const int surge_ref = thrust != nullptr ? thrust->value.surge_ref : 0;
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
  if (options_.source != PositionSource::kDeadReckoning &&
      options_.current_time > Duration::zero()) {
    const Eigen::Vector2d current_m_s = drift_.follow(
        now, position,
        surge_m_s * Eigen::Vector2d{std::sin(heading.rad()), std::cos(heading.rad())});
    state.current_x_m_s = current_m_s.x();
    state.current_y_m_s = current_m_s.y();
  }
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
  has_fix_ = false;
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
  if (options_.source == PositionSource::kDeadReckoning) {
    return true;
  }
  const auto* fix = position_fix_.fresh(now, max_age::kPositionFix);
  if (fix == nullptr) {
    return false;
  }
  if (fix->sequence != used_fix_) {
    used_fix_ = fix->sequence;
    const GeoPoint geodetic{fix->value.latitude_deg, fix->value.longitude_deg};
    const VehiclePose antenna{local_frame_.to_world(geodetic), heading};
    const WorldPoint at = antenna.to_world({-options_.antenna.xy_m});
    dead_reckoning_.correct(at, has_fix_ ? options_.gps_correction : 1.0);
    has_fix_ = true;
  }
  return true;
}

}  // namespace lodesman
