// SPDX-License-Identifier: Apache-2.0
#include "low_level/tasks/delta_t.h"

#include <utility>

#include "low_level/sonar/frame_tracks.h"
#include "low_level/sonar/known_obstacles.h"

namespace lodesman {

DeltaTTask::DeltaTTask(Blackboard& board, Role role, ImagingSonar& sonar, DeltaTOptions options)
    : sonar_{sonar},
      options_{std::move(options)},
      segmenter_{options_.segmentation},
      vehicle_state_{board.vehicle_state},
      mission_status_{board.mission_status},
      pings_{board.sonar_ping, role, "sonar_ping"},
      obstacles_{board.sonar_obstacles, role, "sonar_obstacles"},
      tracks_{board.tracks, role, "tracks"},
      device_{board, role, DeviceId::kSonar, max_age::kSonarFrame} {
  if (options_.known_scene) {
    oracle_.emplace(*options_.known_scene, options_.track_oracle);
  }
}

void DeltaTTask::step(Time now) noexcept {
  const bool taken = take_ping(now);
  device_.publish(now);
  if (!taken) {
    return;
  }
  pings_.publish(*ping_, now);
  if (options_.known_scene) {
    if (!see_known_scene(now)) {
      return;
    }
  } else {
    segmenter_.segment(*ping_, *seen_);
  }
  if (options_.own_zones) {
    make_own_zones(*options_.own_zones, *seen_);
  }
  obstacles_.publish(*seen_, now);
  if (oracle_ || place_frame(now)) {
    tracks_.publish(*known_, now);
  }
}

bool DeltaTTask::take_ping(Time now) noexcept {
  const ReadStatus status = sonar_.poll(now, *ping_);
  const bool believed = status == ReadStatus::kFresh && sane(*ping_);
  device_.keeper().polled(status, believed, now);
  return believed;
}

bool DeltaTTask::place_frame(Time now) noexcept {
  const auto* state = vehicle_state_.fresh(now, max_age::kVehicleState);
  if (state == nullptr) {
    return false;
  }
  const VehicleState& at = state->value;
  tracks_of_frame(*seen_, {{{at.x_m, at.y_m}}, Heading::clockwise_from_y_rad(at.heading_rad)},
                  *known_);
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
