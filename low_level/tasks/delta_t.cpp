// SPDX-License-Identifier: Apache-2.0
#include "low_level/tasks/delta_t.h"

#include <utility>

#include "low_level/sonar/known_obstacles.h"
#include "low_level/tracking/seen_water.h"
#include "mid_level/geometry/moving_obstacle.h"

namespace lodesman {
namespace {

// A ping and the attitude of its time come together, so that the estimate comes a moment later.
// Without it so long after the ping, the newest one does.
constexpr Duration kEstimatePatience = std::chrono::milliseconds{10};

[[nodiscard]] DeviceFault fault_of(PingTrouble trouble) noexcept {
  switch (trouble) {
    case PingTrouble::kNone: break;
    case PingTrouble::kSaturated: return DeviceFault::kSaturated;
    case PingTrouble::kFrozen: return DeviceFault::kFrozen;
    case PingTrouble::kDeaf: return DeviceFault::kDeaf;
    case PingTrouble::kWeed: return DeviceFault::kWeed;
    case PingTrouble::kBlindSector: return DeviceFault::kBlindSector;
    case PingTrouble::kInterference: return DeviceFault::kInterference;
  }
  return DeviceFault::kNone;
}

void move_tracks(Tracks& tracks, const Eigen::Vector2d& by_m) noexcept {
  for (Track& track : std::span{tracks.tracks}.first(tracks.count)) {
    track.shape = translated(track.shape, by_m.x(), by_m.y());
  }
}

}  // namespace

DeltaTTask::DeltaTTask(Blackboard& board, Role role, ImagingSonar& sonar, DeltaTOptions options)
    : sonar_{sonar},
      options_{std::move(options)},
      detector_{options_.segmentation},
      vehicle_state_{board.vehicle_state},
      every_state_{board.vehicle_state},
      mission_status_{board.mission_status},
      pings_{writer_of(board, board.sonar_ping, role)},
      obstacles_{writer_of(board, board.sonar_obstacles, role)},
      coverage_{writer_of(board, board.coverage, role)},
      tracks_{writer_of(board, board.tracks, role)},
      tracks_before_{board.tracks},
      device_{board, role, DeviceId::kSonar, max_age::kSonarFrame} {
  if (!options_.known_scene) {
    tracker_.emplace(options_.segmentation.min_range_m);
  } else {
    oracle_.emplace(*options_.known_scene, options_.track_oracle);
    Reader<Tracks> before{board.tracks};
    if (const auto* last = before.latest(); last != nullptr) {
      oracle_->resume(last->value);
    }
  }
}

void DeltaTTask::step(Time now) noexcept {
  while (const auto* state = every_state_.next()) {
    if (state->value.valid_at <= now + kEstimatePatience) {  // one from the future would stay
      poses_.add(state->value);
    }
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
  const bool believed = status == ReadStatus::kFresh && sane(*ping_) && ping_->captured <= now;
  device_.keeper().polled(status, believed, now);
  const bool is_news = believed && tells_of_water();
  device_.keeper().ails(ailment());
  if (believed) {
    pings_.publish(*ping_, now);
  }
  return is_news;
}

bool DeltaTTask::tells_of_water() noexcept {
  if (options_.known_scene) {
    return true;
  }
  watch_.look(*ping_);
  return watch_.tells_of_water();
}

// What its pings show is the graver as long as they come, and is past once they do not.
DeviceFault DeltaTTask::ailment() noexcept {
  const bool pings_come = device_.keeper().health().status == DeviceStatus::kWorking;
  const DeviceFault by_pings = pings_come ? fault_of(watch_.trouble()) : DeviceFault::kNone;
  return by_pings != DeviceFault::kNone ? by_pings : sonar_.fault();
}

bool DeltaTTask::awaits_estimate(Time now) noexcept {
  const auto* state = vehicle_state_.fresh(now, max_age::kVehicleState);
  return state != nullptr && state->value.valid_at < ping_->captured &&
         now - ping_->captured < kEstimatePatience;
}

void DeltaTTask::publish_what_it_shows(Time now) noexcept {
  bool tracked = true;
  if (options_.known_scene) {
    if (!see_known_scene(now)) {
      return;
    }
  } else {
    detector_.detect(*ping_, *seen_);
    tracked = track_echoes(now);
    move_to_vehicle(options_.mounting, *seen_);
  }
  if (options_.own_zones) {
    make_own_zones(*options_.own_zones, *seen_);
  }
  obstacles_.publish(*seen_, now);
  if (tracked) {
    if (tracker_) {
      coverage_.publish(*water_, now);  // before what wakes its reader
    }
    tracks_.publish(*known_, now);
  }
}

// In the odometry frame: in the world an estimate may have moved between two pings, by a fix.
bool DeltaTTask::track_echoes(Time now) noexcept {
  const auto then = vehicle_state_.fresh(now, max_age::kVehicleState) != nullptr
                        ? poses_.odometry_at(ping_->captured)
                        : std::nullopt;
  if (!then) {
    return false;
  }
  const SonarMounting& mounting = options_.mounting;
  const VehiclePose head{then->to_world({{mounting.x_m, mounting.y_m}}),
                         Heading::clockwise_from_y_rad(then->heading.rad() + mounting.turn_rad)};
  resume_tracks(head);
  tracker_->see(*ping_, *seen_, head, *known_, watch_.blind());
  describe_water(tracker_->water(), head.p_WV.xy_m, to_seconds(ping_->captured.time_since_epoch()),
                 heard_from_m(options_.segmentation.min_range_m, ping_->range_m), *water_);
  water_->frame = ping_->number;
  water_->captured = ping_->captured;
  move_to_world(poses_.world_from_odometry_m());
  return true;
}

void DeltaTTask::move_to_world(const Eigen::Vector2d& from_odometry_m) noexcept {
  move_tracks(*known_, from_odometry_m);
  water_->west_x_m += from_odometry_m.x();
  water_->south_y_m += from_odometry_m.y();
}

void DeltaTTask::resume_tracks(const VehiclePose& head) noexcept {
  if (resumed_) {
    return;
  }
  resumed_ = true;
  const auto* last = tracks_before_.latest();
  if (last != nullptr && sane(last->value)) {
    *known_ = last->value;
    move_tracks(*known_, -poses_.world_from_odometry_m());
    tracker_->resume(*known_, head, ping_->captured);
  }
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
