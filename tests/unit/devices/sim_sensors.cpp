// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "hal_sim/devices/sim_heading_sensor.h"
#include "hal_sim/devices/sim_position_sensor.h"
#include "hal_sim/devices/sim_thruster_pair.h"
#include "tests/support/catch.h"
#include "tests/unit/devices/support.h"

namespace lodesman {
namespace {

using std::chrono::milliseconds;
using testing::HandWorld;

TEST_CASE("sim heading: heading and rate are as coarse as the wire's", "[hal_sim][devices]") {
  HandWorld world;
  SimHeadingSensor sensor{{}, world.link()};
  for (const double rad : {0.0, 1.0, -1.0, 3.14159, -3.14159, 1e-5}) {
    world.state.heading_rad = rad;
    world.state.yaw_rate_rad_s = rad / 10.0;
    world.step();
    const auto reading = sensor.poll(world.now());
    REQUIRE(reading.status == ReadStatus::kFresh);
    const double counts = to_deg(reading.sample.heading_rad) * 65536.0 / 360.0;
    CHECK(counts == Approx(std::round(counts)).margin(1e-6));
    CHECK(std::abs(wrap_to_pi(reading.sample.heading_rad - rad)) <= to_rad(180.0 / 65536.0) + 1e-9);
    CHECK(std::abs(reading.sample.heading_rad) <= to_rad(180.0) + 1e-12);
    CHECK(std::abs(reading.sample.yaw_rate_rad_s - rad / 10.0) <= to_rad(630.0 / 65536.0) + 1e-9);
  }
}

TEST_CASE("sim sensors: a world that woke after the poller does not starve it",
          "[hal_sim][devices]") {
  HandWorld world;
  SimHeadingSensor sensor{{}, world.link()};
  world.step();
  Time last{};
  for (int i = 0; i < 50; ++i) {
    world.step();
    const Time now = world.now() - milliseconds{1};  // the newest sample is of the poller's future
    const auto reading = sensor.poll(now);
    REQUIRE(reading.status == ReadStatus::kFresh);
    CHECK(reading.sample.measured <= now);
    CHECK(reading.sample.measured > last);
    last = reading.sample.measured;
  }
}

TEST_CASE("sim sensors: jitter of the world's steps costs no sample", "[hal_sim][devices]") {
  HandWorld world;
  SimHeadingSensor sensor{{}, world.link()};
  int fresh = 0;
  for (int i = 0; i < 100; ++i) {
    world.step(milliseconds{i % 3 == 0 ? 17 : i % 3 == 1 ? 23 : 20});
    fresh += sensor.poll(world.now()).status == ReadStatus::kFresh ? 1 : 0;
  }
  CHECK(fresh == 100);
}

TEST_CASE("sim position: fixes scatter about the truth by sigma, at 5 Hz", "[hal_sim][devices]") {
  HandWorld world;
  Scenario scenario;
  scenario.position.gps_sigma_m = 1.5;
  SimPositionSensor sensor{scenario, world.link()};
  const LocalFrame frame{
      {scenario.environment.origin_latitude_deg, scenario.environment.origin_longitude_deg}};
  world.state.x_m = 100.0;
  world.state.y_m = -50.0;
  double squares = 0.0;
  int fixes = 0;
  for (int i = 0; i < 20000; ++i) {
    world.step();
    const auto reading = sensor.poll(world.now());
    if (reading.status == ReadStatus::kFresh) {
      const WorldPoint p =
          frame.to_world({reading.sample.latitude_deg, reading.sample.longitude_deg});
      squares += (p.xy_m - Eigen::Vector2d{100.0, -50.0}).squaredNorm();
      CHECK(reading.sample.sigma_m == Approx(1.5));
      ++fixes;
    }
  }
  CHECK(fixes == 2000);
  CHECK(std::sqrt(squares / fixes / 2.0) == Approx(1.5).epsilon(0.05));
}

TEST_CASE("sim position: without scatter a fix is within the last digit of the text",
          "[hal_sim][devices]") {
  HandWorld world;
  Scenario scenario;
  scenario.position.gps_sigma_m = 0.0;
  SimPositionSensor sensor{scenario, world.link()};
  const LocalFrame frame{{35.0, 139.0}};
  world.state.x_m = 12.3;
  world.state.y_m = 45.6;
  world.step();
  const auto reading = sensor.poll(world.now());
  REQUIRE(reading.status == ReadStatus::kFresh);
  const double counts = reading.sample.latitude_deg * 60.0 * 1e5;
  CHECK(counts == Approx(std::round(counts)).margin(1e-3));
  const WorldPoint p = frame.to_world({reading.sample.latitude_deg, reading.sample.longitude_deg});
  CHECK((p.xy_m - Eigen::Vector2d{12.3, 45.6}).norm() < 0.02);
}

TEST_CASE("sim thrusters: a stalled box takes commands and lets them fall", "[hal_sim][devices]") {
  HandWorld world;
  Scenario scenario;
  scenario.faults = {{FaultDevice::kThruster, FaultKind::kStall, 1.0, 2.0}};
  SimThrusterPair box{scenario, world.link()};
  Reader<SimThrust> taken{world.link().thrust};
  world.step(milliseconds{500});
  REQUIRE(box.command({200, 180}, world.now()) == CommandStatus::kTaken);
  CHECK(thrust_at(taken, world.now()) == ThrustCommand{200, 180});
  world.step(milliseconds{700});
  REQUIRE(box.command({10, 20}, world.now()) == CommandStatus::kTaken);
  CHECK(thrust_at(taken, world.now()) == ThrustCommand{200, 180});
  world.step(milliseconds{400});
  REQUIRE(box.command({10, 20}, world.now()) == CommandStatus::kTaken);
  CHECK(thrust_at(taken, world.now()) == kNeutralThrust);
  world.step(milliseconds{2000});
  REQUIRE(box.command({10, 20}, world.now()) == CommandStatus::kTaken);
  CHECK(thrust_at(taken, world.now()) == ThrustCommand{10, 20});
}

TEST_CASE("sim devices: faults wait for the mission", "[hal_sim][devices]") {
  SimLink link;
  Writer<WorldSample> out{link.world, Role::kLow, "world sample"};
  Scenario scenario;
  scenario.faults = {{FaultDevice::kAhrs, FaultKind::kDisconnect, 0.0, 2.0}};
  SimHeadingSensor sensor{scenario, link};
  WorldSample sample;
  sample.stamp = Time{milliseconds{20}};
  out.publish(sample, sample.stamp);
  CHECK(sensor.poll(sample.stamp).status == ReadStatus::kFresh);
  sample.stamp += milliseconds{20};
  sample.started = 1;
  out.publish(sample, sample.stamp);
  CHECK(sensor.poll(sample.stamp).status == ReadStatus::kDisconnected);
}

}  // namespace
}  // namespace lodesman
