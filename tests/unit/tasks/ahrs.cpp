// SPDX-License-Identifier: Apache-2.0
#include "low_level/tasks/sensors.h"
#include "tests/support/catch.h"
#include "tests/unit/tasks/support.h"

namespace lodesman::testing {
namespace {

struct Ahrs {
  explicit Ahrs(double turned_rad = 0.0) : turn_rad{turned_rad} {}

  std::unique_ptr<Blackboard> board = std::make_unique<Blackboard>();
  ScriptedHeading sensor;
  double turn_rad = 0.0;
  AhrsTask task{*board, Role::kLow, sensor, turn_rad};
  Reader<Attitude> attitudes{board->attitude};

  [[nodiscard]] std::vector<double> headings_after_step() {
    task.step(kStart);
    std::vector<double> headings;
    for (const Attitude& attitude : all_of(attitudes)) {
      headings.push_back(attitude.heading_rad);
    }
    return headings;
  }
};

[[nodiscard]] Attitude heading(double rad) { return {kStart, rad, 0.0}; }

using Headings = std::vector<double>;

TEST_CASE("ahrs task: every sample is published once and in order", "[low_level][tasks]") {
  Ahrs ahrs;
  CHECK(ahrs.headings_after_step().empty());
  for (const double rad : {0.1, 0.2, 0.3}) {
    ahrs.sensor.give(heading(rad));
  }
  CHECK(ahrs.headings_after_step() == Headings{0.1, 0.2, 0.3});
  CHECK(ahrs.headings_after_step().empty());
}

TEST_CASE("ahrs task: a corrupt sample is skipped and a device that is gone publishes nothing",
          "[low_level][tasks]") {
  Ahrs ahrs;
  ahrs.sensor.give(ReadStatus::kCorrupt);
  ahrs.sensor.give(heading(0.1));
  ahrs.sensor.give(ReadStatus::kDisconnected);
  ahrs.sensor.give(heading(0.2));
  CHECK(ahrs.headings_after_step() == Headings{0.1});
  CHECK(ahrs.headings_after_step() == Headings{0.2});  // it came back
}

TEST_CASE("ahrs task: a sample that is no heading is as if it had not come", "[low_level][tasks]") {
  Ahrs ahrs;
  for (const double rad : {kNaN, std::numeric_limits<double>::infinity(), 1e300}) {
    ahrs.sensor.give(heading(rad));
  }
  ahrs.sensor.give(Attitude{kStart, 0.1, kNaN});
  ahrs.sensor.give(heading(0.4));
  CHECK(ahrs.headings_after_step() == Headings{0.4});
}

TEST_CASE("ahrs task: a sensor that is turned to starboard reads that much too much",
          "[low_level][tasks]") {
  Ahrs ahrs{0.1};
  ahrs.sensor.give(heading(0.5));
  ahrs.sensor.give(heading(-3.1));
  ahrs.sensor.give(heading(0.0));
  const Headings vehicle = ahrs.headings_after_step();
  REQUIRE(vehicle.size() == 3);
  CHECK(vehicle[0] == Approx(0.4));
  CHECK(vehicle[1] == Approx(3.0831853));  // over south
  CHECK(vehicle[2] == Approx(-0.1));
}

TEST_CASE("ahrs task: one step takes no end of samples", "[low_level][tasks]") {
  Ahrs ahrs;
  for (int i = 0; i < 100; ++i) {
    ahrs.sensor.give(heading(0.01 * i));
  }
  CHECK(ahrs.headings_after_step().size() < 100);
  CHECK_FALSE(ahrs.sensor.readings.empty());
}

}  // namespace
}  // namespace lodesman::testing
