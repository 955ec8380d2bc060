// SPDX-License-Identifier: Apache-2.0
#include "low_level/tasks/delta_t.h"

#include <utility>

#include "low_level/sonar/frame_tracks.h"
#include "low_level/sonar/known_obstacles.h"

namespace lodesman {
namespace {

// A ping and the attitude of its time come together, so that the estimate comes a moment later.
// Without it so long after the ping, the newest one does.
constexpr Duration kEstimatePatience = std::chrono::milliseconds{10};

}  // namespace

DeltaTTask::DeltaTTask(Blackboard& board, Role role, ImagingSonar& sonar, DeltaTOptions options)
    : sonar_{sonar},
      options_{std::move(options)},
      segmenter_{options_.segmentation},
      profile_detector_{options_.segmentation},
      vehicle_state_{board.vehicle_state},
      every_state_{board.vehicle_state},
      mission_status_{board.mission_status},
      pings_{writer_of(board, board.sonar_ping, role)},
      obstacles_{writer_of(board, board.sonar_obstacles, role)},
      tracks_{writer_of(board, board.tracks, role)},
      device_{board, role, DeviceId::kSonar, max_age::kSonarFrame} {
  if (options_.known_scene) {
    oracle_.emplace(*options_.known_scene, options_.track_oracle);
    Reader<Tracks> before{board.tracks};
    if (const auto* last = before.latest(); last != nullptr) {
      oracle_->resume(last->value);
    }
  }
}

void DeltaTTask::step(Time now) noexcept {
  while (const auto* state = every_state_.next()) {
    poses_.add(state->value);
  }
  holds_ping_ = holds_ping_ || take_ping(now);
  device_.publish(now);
  if (holds_ping_ && !awaits_estimate(now)) {
    holds_ping_ = false;
    publish_what_it_shows(now);
  }
}

bool DeltaTTask::take_ping(Time now) noexcept {
  const ReadStatus status = sonar_.poll(now, *ping_);
  const bool believed = status == ReadStatus::kFresh && sane(*ping_);
  device_.keeper().polled(status, believed, now);
  device_.keeper().ails(sonar_.fault());
  if (!believed) {
    return false;
  }
  pings_.publish(*ping_, now);
  return true;
}

bool DeltaTTask::awaits_estimate(Time now) noexcept {
  const auto* state = vehicle_state_.fresh(now, max_age::kVehicleState);
  return state != nullptr && state->value.valid_at < ping_->captured &&
         now - ping_->captured < kEstimatePatience;
}

void DeltaTTask::publish_what_it_shows(Time now) noexcept {
  if (options_.known_scene) {
    if (!see_known_scene(now)) {
      return;
    }
  } else if (ping_->kind == PingKind::kProfile) {
    profile_detector_.detect(*ping_, *seen_);
  } else {
    segmenter_.segment(*ping_, *seen_);
    move_to_vehicle(options_.mounting, *seen_);
  }
  if (options_.own_zones) {
    make_own_zones(*options_.own_zones, *seen_);
  }
  obstacles_.publish(*seen_, now);
  if (oracle_ || place_frame(now)) {
    tracks_.publish(*known_, now);
  }
}

// By the odometry: in the world an estimate may have moved between the ping and now, by a fix.
bool DeltaTTask::place_frame(Time now) noexcept {
  const auto then = vehicle_state_.fresh(now, max_age::kVehicleState) != nullptr
                        ? poses_.by_odometry_at(ping_->captured)
                        : std::nullopt;
  if (!then) {
    return false;
  }
  tracks_of_frame(*seen_, *then, *known_);
  return true;
}

bool DeltaTTask::see_known_scene(Time now) noexcept {
  const auto* state = vehicle_state_.fresh(now, max_age::kVehicleState);
  if (state == nullptr) {
    return false;
  }
  const auto* mission = mission_status_.latest();
  const bool started = mission != nullptr && mission->value.first_started != Time{};
  const VehicleState& at = state->value;
  KnownView view;
  view.frame = ping_->number;
  view.captured = at.valid_at;  // the pose they are drawn at is the pose they belong to
  view.scenario_time_s = started ? to_seconds(at.valid_at - mission->value.first_started) : 0.0;
  view.pose = {{{at.x_m, at.y_m}}, Heading::clockwise_from_y_rad(at.heading_rad)};
  view.range_m = ping_->range_m;
  see_known_obstacles(*options_.known_scene, view, *seen_);
  oracle_->see(view, *known_);
  return true;
}

}  // namespace lodesman
