// SPDX-License-Identifier: Apache-2.0
// A blackboard with a boat under way on it: one obstacle ahead that moves and has a zone, a mission
// of two goals in a fence, a plan, a ping.
#pragma once

#include <memory>
#include <numbers>

#include "deploy/operator/console/board_picture.h"

namespace lodesman::testing {

using std::chrono::milliseconds;
using std::chrono::seconds;

class SmallBoard {
 public:
  static constexpr Time kNow{seconds{100}};

  SmallBoard() {
    attitude.publish({kNow - milliseconds{20}, 0.5 * std::numbers::pi, 0.0}, kNow);
    VehicleState state;
    state.valid_at = kNow - milliseconds{50};
    state.x_m = 10.0;
    state.y_m = 20.0;
    state.heading_rad = 0.5 * std::numbers::pi;
    state.surge_m_s = 0.42;
    state.yaw_rate_rad_s = 0.1;
    state.position_xx_m2 = 0.09;
    state.position_yy_m2 = 0.16;
    vehicle_state.publish(state, kNow);
    publish_obstacle();
    publish_mission();
    publish_plan();
    ThrustApplied applied;
    applied.reason = ThrustReason::kCommanded;
    applied.left = 255;
    applied.right = 0;
    applied.surge_ref = 31;
    thrust.publish(applied, kNow);
    ThrustStatus armed;
    armed.state = ThrustState::kArmed;
    thrust_status.publish(armed, kNow);
  }

  [[nodiscard]] console::BoardPicture look(Time now = kNow) {
    console::BoardPicture picture = readers.look(now);
    picture.low_alive = picture.high_alive = true;
    return picture;
  }

  std::unique_ptr<Blackboard> board = std::make_unique<Blackboard>();
  Writer<Attitude> attitude{board->attitude, Role::kLow, "attitude"};
  Writer<VehicleState> vehicle_state{board->vehicle_state, Role::kHigh, "vehicle_state"};
  Writer<SonarPing> sonar_ping{board->sonar_ping, Role::kLow, "sonar_ping"};
  Writer<SonarObstacles> sonar_obstacles{board->sonar_obstacles, Role::kLow, "sonar_obstacles"};
  Writer<Coverage> coverage{board->coverage, Role::kLow, "coverage"};
  Writer<Tracks> tracks{board->tracks, Role::kLow, "tracks"};
  Writer<PathRequest> request{board->path_request, Role::kHigh, "path_request"};
  Writer<Plan> plan{board->plan, Role::kHigh, "plan"};
  Writer<MissionDefinition> definition{board->mission_definition, Role::kHigh,
                                       "mission_definition"};
  Writer<MissionStatus> mission{board->mission_status, Role::kHigh, "mission_status"};
  Writer<HelmCommand> helm{board->helm_command, Role::kHigh, "helm_command"};
  Writer<ThrustStatus> thrust_status{board->thrust_status, Role::kLow, "thrust_status"};
  Writer<ThrustApplied> thrust{board->thrust_applied, Role::kLow, "thrust_applied"};
  Writer<GuardStatus> guard{board->guard_status, Role::kLow, "guard_status"};
  console::BoardReaders readers{*board};

  void publish_plan(double last_y_m = 25.0) {
    auto way = std::make_unique<Plan>();
    way->captured = kNow;
    way->rung = PlanRung::kOnRoute;
    way->source = WaypointSource::kCurrent;
    way->waypoint_count = 2;
    way->waypoints[0] = {15.0, 20.0};
    way->waypoints[1] = {20.0, last_y_m};
    plan.publish(*way, kNow);
    HelmCommand steered;
    steered.reason = HelmReason::kTracking;
    steered.waypoint_x_m = 15.0;
    steered.waypoint_y_m = 20.0;
    helm.publish(steered, kNow);
  }

  void publish_mission(MissionState state = MissionState::kUnderWay,
                       MissionCause cause = MissionCause::kOrder) {
    auto ordered = std::make_unique<MissionDefinition>();
    ordered->id = 7;
    ordered->speed_m_s = 0.42;
    ordered->goal_radius_m = 0.5;
    ordered->goal_count = 2;
    ordered->goals[0] = {15.0, 20.0};
    ordered->goals[1] = {30.0, 40.0};
    ordered->area_count = 2;
    ordered->areas[0].kind = AreaKind::kFence;
    ordered->areas[1].kind = AreaKind::kKeepOut;
    for (auto& area : {&ordered->areas[0], &ordered->areas[1]}) {
      area->corner_count = 3;
      area->corners[1] = {50.0, 0.0};
      area->corners[2] = {0.0, 50.0};
    }
    definition.publish(*ordered, kNow);
    MissionStatus status;
    status.state = state;
    status.cause = cause;
    status.mission = 7;
    status.started = kNow - seconds{30};
    status.goal_index = 0;
    status.goal_x_m = 15.0;
    status.goal_y_m = 20.0;
    status.home_x_m = 1.0;
    status.home_y_m = 2.0;
    mission.publish(status, kNow);
  }

 private:
  void publish_obstacle() {
    auto seen = std::make_unique<Tracks>();
    seen->captured = kNow - milliseconds{100};
    seen->count = 1;
    Track& track = seen->tracks[0];
    track.id = 5;
    track.last_seen = kNow;
    track.shape.centre_x_m = 16.0;
    track.shape.centre_y_m = 20.0;
    track.shape.semi_axis_first_m = track.shape.semi_axis_second_m = 1.0;
    track.velocity_x_m_s = 0.0;
    track.velocity_y_m_s = -0.5;
    track.velocity_xx_m2_s2 = track.velocity_yy_m2_s2 = 1e-4;
    tracks.publish(*seen, kNow);
    auto asked = std::make_unique<PathRequest>();
    asked->space = PathSpace::kWorld;
    asked->zone_count = 1;
    asked->zones[0].shape = track.shape;
    asked->zones[0].shape.id = 5;
    asked->zones[0].shape.protection_first_m = asked->zones[0].shape.protection_second_m = 2.0;
    request.publish(*asked, kNow);
    auto frame = std::make_unique<SonarObstacles>();
    frame->captured = kNow;
    frame->range_m = 20.0;
    sonar_obstacles.publish(*frame, kNow);
  }
};

}  // namespace lodesman::testing
