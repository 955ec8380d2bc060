// SPDX-License-Identifier: Apache-2.0
// The DeltaT task: takes pings from the sonar, publishes them, and publishes the obstacles in them;
// or, for a known scene, draws its obstacles at the estimated pose as the paper did in its tank.
// Stepped by its runner's thread.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "drivers/hal/devices.h"
#include "low_level/sonar/detector.h"
#include "low_level/sonar/mounting.h"
#include "low_level/sonar/ping_watch.h"
#include "low_level/sonar/protection.h"
#include "low_level/sonar/track_oracle.h"
#include "low_level/tasks/device_report.h"
#include "low_level/tracking/tracker.h"
#include "mid_level/geometry/moving_obstacle.h"
#include "mid_level/geometry/pose_history.h"
#include "mid_level/runtime/task.h"

namespace lodesman {

struct DeltaTOptions {
  SegmentationOptions segmentation{};
  std::optional<OwnZones> own_zones;  // empty: the protection zones that came with the obstacles
  TrackOracleOptions track_oracle{};
  SonarMounting mounting{};  // of the head; a known scene is drawn round the vehicle itself
  // The scenario's obstacles, for the known-obstacle source; empty: obstacles come from echoes.
  std::optional<std::vector<MovingObstacle>> known_scene;
};

class DeltaTTask final : public Task {
 public:
  DeltaTTask(Blackboard& board, Role role, ImagingSonar& sonar, DeltaTOptions options);
  void step(Time now) noexcept override;
  [[nodiscard]] std::uint64_t refused() const noexcept override {
    return device_.refused() + refused_by(vehicle_state_, mission_status_);
  }
  [[nodiscard]] std::span<ChannelLook<>* const> inputs() noexcept override { return inputs_; }

 private:
  // Whether there is a new ping that can be believed and tells of the water.
  [[nodiscard]] bool take_ping(Time now) noexcept;
  // Whether a ping that was published tells of the water, as far as that matters: a known scene
  // needs no echoes.
  [[nodiscard]] bool tells_of_water() noexcept;
  // What its pings show or its driver says.
  [[nodiscard]] DeviceFault ailment() noexcept;
  // Whether the estimate of the ping's own time is about to come.
  [[nodiscard]] bool awaits_estimate(Time now) noexcept;
  void publish_what_it_shows(Time now) noexcept;
  // False when the estimate is stale: then nothing is known of where the obstacles are.
  [[nodiscard]] bool see_known_scene(Time now) noexcept;
  // Obstacles in the head's frame to tracks, by the odometry at the time of the ping; false when
  // the estimate is stale or that time is not remembered.
  [[nodiscard]] bool track_echoes(Time now) noexcept;
  void move_to_world(const Eigen::Vector2d& from_odometry_m) noexcept;
  // What one that was here before knew last.
  void resume_tracks(const VehiclePose& head) noexcept;

  ImagingSonar& sonar_;
  DeltaTOptions options_;
  PingWatch watch_;
  Detector detector_;
  Reader<VehicleState> vehicle_state_;
  Reader<VehicleState> every_state_;  // the same, one after the other
  PoseHistory poses_;
  Reader<MissionStatus> mission_status_;
  std::array<ChannelLook<>*, 3> inputs_{&every_state_, &vehicle_state_, &mission_status_};
  Writer<SonarPing> pings_;
  Writer<SonarObstacles> obstacles_;
  Writer<Coverage> coverage_;
  Writer<Tracks> tracks_;
  std::optional<TrackOracle> oracle_;
  std::optional<Tracker> tracker_;
  Reader<Tracks> tracks_before_;
  bool resumed_ = false;
  DeviceReport device_;
  bool holds_ping_ = false;  // published, and waits for its estimate
  // Too large for a stack.
  std::unique_ptr<SonarPing> ping_ = std::make_unique<SonarPing>();
  std::unique_ptr<SonarObstacles> seen_ = std::make_unique<SonarObstacles>();
  std::unique_ptr<Coverage> water_ = std::make_unique<Coverage>();
  std::unique_ptr<Tracks> known_ = std::make_unique<Tracks>();
};

}  // namespace lodesman
