// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/console/board_picture.h"

#include <algorithm>
#include <vector>

namespace lodesman::console {
namespace {

[[nodiscard]] bool same_way(const Plan& one, const Plan& other) noexcept {
  const auto same = [](const Waypoint& a, const Waypoint& b) {
    constexpr double kNear_m = 1e-3;
    return std::abs(a.x_m - b.x_m) < kNear_m && std::abs(a.y_m - b.y_m) < kNear_m;
  };
  return one.waypoint_count == other.waypoint_count &&
         std::equal(one.waypoints.begin(), one.waypoints.begin() + one.waypoint_count,
                    other.waypoints.begin(), same);
}

}  // namespace

struct BoardReaders::Impl {
  explicit Impl(const Blackboard& board)
      : attitude{board.attitude},
        fix{board.position_fix},
        state{board.vehicle_state},
        ping{board.sonar_ping},
        obstacles{board.sonar_obstacles},
        coverage{board.coverage},
        tracks{board.tracks},
        request{board.path_request},
        path{board.sonar_path},
        plan{board.plan},
        definition{board.mission_definition},
        mission{board.mission_status},
        helm{board.helm_command},
        tunables{board.tunables},
        thrust_status{board.thrust_status},
        thrust{board.thrust_applied},
        guard{board.guard_status},
        battery{board.battery_status} {
    for (const auto& channel : board.device_health) {
      devices.emplace_back(channel);
    }
  }

  [[nodiscard]] const Stamped<Plan>* take_plan() {
    const Stamped<Plan>* newest = plan.latest();
    if (newest != nullptr && held_plan && held_plan->sequence != newest->sequence &&
        !same_way(newest->value, held_plan->value)) {
      previous_plan = held_plan;
    }
    if (newest != nullptr) {
      held_plan = *newest;
    }
    return newest;
  }

  Reader<Attitude> attitude;
  Reader<PositionFix> fix;
  Reader<VehicleState> state;
  Reader<SonarPing> ping;
  Reader<SonarObstacles> obstacles;
  Reader<Coverage> coverage;
  Reader<Tracks> tracks;
  Reader<PathRequest> request;
  Reader<SonarPath> path;
  Reader<Plan> plan;
  Reader<MissionDefinition> definition;
  Reader<MissionStatus> mission;
  Reader<HelmCommand> helm;
  Reader<Tunables> tunables;
  Reader<ThrustStatus> thrust_status;
  Reader<ThrustApplied> thrust;
  Reader<GuardStatus> guard;
  Reader<BatteryStatus> battery;
  std::vector<Reader<DeviceHealth>> devices;
  std::optional<Stamped<Plan>> held_plan;
  std::optional<Stamped<Plan>> previous_plan;
};

BoardReaders::BoardReaders(const Blackboard& board) : impl_{std::make_unique<Impl>(board)} {}
BoardReaders::~BoardReaders() = default;

BoardPicture BoardReaders::look(Time now) {
  BoardPicture picture{.now = now,
                       .attitude = impl_->attitude.latest(),
                       .fix = impl_->fix.latest(),
                       .state = impl_->state.latest(),
                       .ping = impl_->ping.latest(),
                       .obstacles = impl_->obstacles.latest(),
                       .coverage = impl_->coverage.latest(),
                       .tracks = impl_->tracks.latest(),
                       .request = impl_->request.latest(),
                       .path = impl_->path.latest(),
                       .plan = impl_->take_plan(),
                       .definition = impl_->definition.latest(),
                       .mission = impl_->mission.latest(),
                       .helm = impl_->helm.latest(),
                       .tunables = impl_->tunables.latest(),
                       .thrust_status = impl_->thrust_status.latest(),
                       .thrust = impl_->thrust.latest(),
                       .guard = impl_->guard.latest(),
                       .battery = impl_->battery.latest()};
  picture.previous_plan = impl_->previous_plan ? &*impl_->previous_plan : nullptr;
  for (std::size_t i = 0; i < impl_->devices.size(); ++i) {
    picture.devices[i] = impl_->devices[i].latest();
  }
  return picture;
}

}  // namespace lodesman::console
