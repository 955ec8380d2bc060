// SPDX-License-Identifier: Apache-2.0
// World and devices in their steps: whole seconds of them take nothing from the heap.
#include <memory>

#include "hal_sim/devices/sim_heading_sensor.h"
#include "hal_sim/devices/sim_position_sensor.h"
#include "hal_sim/devices/sim_sonar.h"
#include "hal_sim/devices/sim_thruster_pair.h"
#include "hal_sim/world/world_task.h"
#include "tests/support/allocations.h"
#include "tests/support/catch.h"

namespace lodesman {
namespace {

[[nodiscard]] MovingObstacle mover(ObstacleShape shape) {
  MovingObstacle obstacle;
  obstacle.at_start.shape = shape;
  obstacle.at_start.centre_y_m = 10.0;
  obstacle.at_start.semi_axis_first_m = 2.0;
  obstacle.at_start.semi_axis_second_m = 0.5;
  obstacle.at_start.vertex_count = 3;
  obstacle.at_start.vertices[0] = {-5.0, 12.0};
  obstacle.at_start.vertices[1] = {5.0, 13.0};
  obstacle.at_start.vertices[2] = {0.0, 15.0};
  obstacle.velocity_x_m_s = 0.1;
  return obstacle;
}

TEST_CASE("world and simulated devices allocate nothing once made", "[hal_sim][devices]") {
  const SonarScene scene = GENERATE(SonarScene::kBeams, SonarScene::kDetections);
  Scenario scenario;
  scenario.sonar.scene = scene;
  scenario.sonar.detections = {.missed = 0.2, .split = 0.5, .false_per_ping = 1.0};
  scenario.obstacles = {mover(ObstacleShape::kEllipse), mover(ObstacleShape::kPolyline),
                        mover(ObstacleShape::kPolygon)};
  scenario.faults = {{FaultDevice::kSonar, FaultKind::kCorrupt, 1.0, 0.5}};
  const auto board = std::make_unique<Blackboard>();
  const auto link = std::make_unique<SimLink>();
  const auto ping = std::make_unique<SonarPing>();
  WorldTask world{scenario, load_vessel(LODESMAN_VESSEL), *board, *link};
  SimHeadingSensor heading{scenario, *link};
  SimPositionSensor position{scenario, *link};
  SimSonar sonar{scenario, *link};
  SimThrusterPair box{scenario, *link};
  Writer<MissionStatus> mission{board->mission_status, Role::kHigh, "mission_status"};
  Time now{std::chrono::seconds{1}};
  MissionStatus sails;
  sails.state = MissionState::kUnderWay;
  sails.first_started = sails.started = now;
  mission.publish(sails, now);
  bool taken = true;
  int fresh = 0;
  const testing::AllocationScope scope;
  for (int i = 0; i < 150; ++i) {
    now += std::chrono::milliseconds{20};
    world.step(now);
    fresh += heading.poll(now).status == ReadStatus::kFresh ? 1 : 0;
    fresh += position.poll(now).status == ReadStatus::kFresh ? 1 : 0;
    fresh += sonar.poll(now, *ping) == ReadStatus::kFresh ? 1 : 0;
    taken = box.command({200, 180}, now) == CommandStatus::kTaken && taken;
  }
  const std::uint64_t allocations = scope.count();
  CHECK(allocations == 0);
  CHECK(taken);
  CHECK(fresh == 150 + 15 + 25);
}

}  // namespace
}  // namespace lodesman
