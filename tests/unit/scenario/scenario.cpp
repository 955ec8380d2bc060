// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/scenario/scenario.h"

#include <array>
#include <vector>

#include "tests/support/catch.h"
#include "tests/support/shipped_vessel.h"

namespace lodesman {
namespace {

using testing::kGoodScenario;
using testing::replaced;
using testing::scenario_of;
using testing::shipped_speeds;

const std::vector<std::string> kShipped = {
    "paper-static",        "paper-multiple",   "paper-moving",     "paper-radius-0.2",
    "paper-radius-0.5",    "paper-radius-1.0", "paper-radius-1.5", "paper-speed-0.11",
    "paper-speed-0.22",    "paper-speed-0.42", "paper-speed-0.74", "paper-speed-1.12",
    "tank-straight",       "tank-static",      "tank-moving",      "paper-local-minimum",
    "start-in-four-zones", "goal-abeam",       "goal-astern",      "goal-in-mover",
    "closing-channel",     "ring-opens",       "wide-wall",        "twenty-movers"};

TEST_CASE("scenario: every key of the format arrives where it belongs", "[hal_sim][scenario]") {
  const Scenario s = scenario_of(kGoodScenario);
  CHECK(s.name == "a-good.one");
  CHECK(s.seed == 1);
  CHECK(s.time_limit_s == Approx(200.0));
  CHECK(s.mission.goal().xy_m.y() == Approx(20.0));
  CHECK(s.mission.definition.goal_radius_m == Approx(0.5));
  CHECK(s.mission.waypoints().empty());
  CHECK(s.surge_ref == 16);
  CHECK(s.speed_m_s == Approx(0.22).epsilon(kSpeedTolerance));
  CHECK(s.vehicle_radius_m == Approx(0.5));
  CHECK(s.environment.current_x_m_s == Approx(0.1));
  CHECK(s.environment.lift);
  CHECK(s.environment.origin_latitude_deg == Approx(36.0));
  CHECK(s.environment.origin_longitude_deg == Approx(138.0));
  CHECK(s.position.source == PositionSource::kGps);
  CHECK(s.position.gps_sigma_m == Approx(2.0));
  CHECK(s.sonar.scene == SonarScene::kBeams);
  CHECK(s.sonar.range_m == Approx(20.0));
  CHECK(s.sonar.sector_rad == Approx(to_rad(90.0)));
  CHECK(s.sonar.beams == 240);
  CHECK(s.sonar.bins == 400);
  CHECK(s.sonar.ping_hz == Approx(5.0));
  REQUIRE(s.faults.size() == 1);
  CHECK(s.faults[0].device == FaultDevice::kThruster);
  CHECK(s.faults[0].kind == FaultKind::kDisconnect);
  CHECK(s.faults[0].at_s == Approx(20.0));
  CHECK(s.faults[0].duration_s == Approx(5.0));
}

TEST_CASE("scenario: obstacles keep their shapes, zones and courses", "[hal_sim][scenario]") {
  const Scenario s = scenario_of(kGoodScenario);
  REQUIRE(s.obstacles.size() == 3);
  const MovingObstacle& circle = s.obstacles[0];
  CHECK(circle.at_start.id == 1);
  CHECK(circle.at_start.shape == ObstacleShape::kEllipse);
  CHECK(circle.at_start.semi_axis_second_m == Approx(0.5));
  CHECK(circle.at_start.protection_second_m == Approx(3.5));
  CHECK(circle.stops_at_s == Approx(10.0 / 0.11));
  CHECK(circle.at(1e4).centre_y_m == Approx(0.0).margin(1e-9));
  CHECK_FALSE(circle.exists(4.9));
  CHECK(circle.exists(5.0));
  CHECK_FALSE(circle.exists(60.0));
  const Obstacle& ellipse = s.obstacles[1].at_start;
  CHECK(ellipse.id == 2);
  CHECK(ellipse.semi_axis_first_m == Approx(1.5));
  CHECK(ellipse.semi_axis_second_m == Approx(0.4));
  CHECK(ellipse.protection_first_m == Approx(4.0));
  CHECK(ellipse.protection_second_m == Approx(2.0));
  CHECK(ellipse.angle_rad == Approx(to_rad(30.0)));
  CHECK(s.obstacles[1].exists(1e5));
  const Obstacle& wall = s.obstacles[2].at_start;
  CHECK(wall.shape == ObstacleShape::kPolyline);
  REQUIRE(wall.vertex_count == 2);
  CHECK(wall.vertices[1].x_m == Approx(10.0));
  CHECK(wall.protection_first_m == Approx(1.0));
}

TEST_CASE("scenario: what is optional has the contract's values", "[hal_sim][scenario]") {
  const Scenario s = scenario_of(kGoodScenario.substr(0, kGoodScenario.find("[[obstacle]]")));
  CHECK(s.obstacles.empty());
  CHECK(s.faults.empty());
  CHECK(s.environment.current_x_m_s == Approx(0.0));
  CHECK(s.environment.current_y_m_s == Approx(0.0));
  CHECK_FALSE(s.environment.lift);
  CHECK(s.environment.origin_latitude_deg == Approx(35.0));
  CHECK(s.environment.origin_longitude_deg == Approx(139.0));
  CHECK(s.position.source == PositionSource::kTruth);
  CHECK(s.position.gps_sigma_m == Approx(1.0));
  CHECK(s.sonar.scene == SonarScene::kObstacles);
  CHECK(s.sonar.noise == SonarNoise::kNone);
  CHECK(s.sonar.range_m == Approx(30.0));
  CHECK(s.sonar.sector_rad == Approx(to_rad(120.0)));
  CHECK(s.sonar.beams == 120);
  CHECK(s.sonar.bins == 500);
  CHECK(s.sonar.ping_hz == Approx(10.0));
}

TEST_CASE("scenario: detections have the errors that are given, and no others",
          "[hal_sim][scenario]") {
  const std::string detections = replaced(kGoodScenario, "\"beams\"", "\"detections\"");
  const Scenario clean = scenario_of(detections);
  CHECK(clean.sonar.scene == SonarScene::kDetections);
  CHECK_FALSE(clean.sonar.detections.any());
  const DetectionErrors some =
      scenario_of(replaced(detections, "[[fault]]",
                           "[sonar.detections]\nmissed = 0.1\nnoise_m = 0.05\n[[fault]]"))
          .sonar.detections;
  CHECK(some.missed == Approx(0.1));
  CHECK(some.noise_m == Approx(0.05));
  CHECK(some.split == Approx(0.0));
  const DetectionErrors all =
      scenario_of(replaced(detections, "[[fault]]",
                           "[sonar.detections]\nmissed = 0.1\nsplit = 0.2\ndisplaced_m = 0.3\n"
                           "false_per_ping = 0.4\nnoise_m = 0.5\n[[fault]]"))
          .sonar.detections;
  CHECK(all.any());
  CHECK(all.split == Approx(0.2));
  CHECK(all.displaced_m == Approx(0.3));
  CHECK(all.false_per_ping == Approx(0.4));
  CHECK(all.noise_m == Approx(0.5));
}

TEST_CASE("scenario: surge_ref stands for its steady speed, waypoints come in order",
          "[hal_sim][scenario]") {
  std::string text = replaced(kGoodScenario, "speed_m_s = 0.22", "surge_ref = 31");
  text = replaced(text, "goal_radius_m", "waypoints_m = [[2.0, 5.0], [0.0, 9.0]]\ngoal_radius_m");
  const Scenario s = scenario_of(text);
  CHECK(s.surge_ref == 31);
  CHECK(s.speed_m_s == Approx(0.42).epsilon(kSpeedTolerance));
  REQUIRE(s.mission.waypoints().size() == 2);
  CHECK(s.mission.waypoints()[0].x_m == Approx(2.0));
  CHECK(s.mission.waypoints()[1].y_m == Approx(9.0));
}

TEST_CASE("scenario: walls move by their first vertex and polygons close", "[hal_sim][scenario]") {
  const Scenario s = scenario_of(
      replaced(kGoodScenario, "shape = \"polyline\"\npoints_m = [[-10.0, 25.0], [10.0, 25.0]]",
               "shape = \"polygon\"\npoints_m = [[1.0, 1.0], [2.0, 1.0], [2.0, 2.0]]\n"
               "velocity_m_s = [3.0, 4.0]\nstop_at_m = [4.0, 5.0]"));
  const MovingObstacle& raft = s.obstacles[2];
  CHECK(raft.at_start.shape == ObstacleShape::kPolygon);
  CHECK(raft.stops_at_s == Approx(1.0));
  CHECK(raft.at(2.0).vertices[2].y_m == Approx(6.0));
}

TEST_CASE("scenario: each shipped scenario is read, and is named as its file",
          "[hal_sim][scenario]") {
  const std::array<std::filesystem::path, 2> directories = {"no-such-directory",
                                                            LODESMAN_SCENARIOS};
  for (const std::string& name : kShipped) {
    INFO(name);
    const Scenario s = load_scenario(find_scenario(name, directories), shipped_speeds());
    CHECK(s.name == name);
    CHECK(s.position.source ==
          (name.starts_with("tank") ? PositionSource::kDeadReckoning : PositionSource::kTruth));
    CHECK(s.environment.lift == name.starts_with("tank"));
  }
}

TEST_CASE("scenario: the folder holds no scenario that the list does not name",
          "[hal_sim][scenario]") {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(LODESMAN_SCENARIOS)) {
    INFO(entry.path());
    CHECK(std::count(kShipped.begin(), kShipped.end(), entry.path().stem().string()) == 1);
    ++files;
  }
  CHECK(files == kShipped.size());
}

TEST_CASE("scenario: a path is taken as it is, an unknown name is refused", "[hal_sim][scenario]") {
  const std::array<std::filesystem::path, 1> directories = {LODESMAN_SCENARIOS};
  const std::string path = std::string{LODESMAN_SCENARIOS} + "/paper-static.toml";
  CHECK(find_scenario(path, {}) == path);
  CHECK_THROWS_AS(find_scenario("no-such-scenario", directories), StartupError);
}

TEST_CASE("scenario: the help text names every kind of fault", "[hal_sim][scenario]") {
  const std::string help = fault_kinds_help();
  for (const char* word :
       {"ahrs", "sonar", "position", "thruster", "stall", "corrupt", "disconnect"}) {
    CHECK(help.find(word) != std::string::npos);
  }
}

TEST_CASE("fault schedule: a device has its own faults, from at_s to before the end",
          "[hal_sim][scenario]") {
  const std::vector<Fault> faults = {{FaultDevice::kAhrs, FaultKind::kStall, 1.0, 2.0},
                                     {FaultDevice::kSonar, FaultKind::kCorrupt, 0.0, 9.0},
                                     {FaultDevice::kAhrs, FaultKind::kDisconnect, 2.0, 2.0}};
  const FaultSchedule ahrs{faults, FaultDevice::kAhrs};
  CHECK(ahrs.at(0.99) == FaultKind::kNone);
  CHECK(ahrs.at(1.0) == FaultKind::kStall);
  CHECK(ahrs.at(2.5) == FaultKind::kStall);
  CHECK(ahrs.at(3.0) == FaultKind::kDisconnect);
  CHECK(ahrs.at(4.0) == FaultKind::kNone);
}

}  // namespace
}  // namespace lodesman
