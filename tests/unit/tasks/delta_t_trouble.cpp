// SPDX-License-Identifier: Apache-2.0
// What becomes of pings that tell nothing of the water, or of a part of it.
#include <cmath>

#include "deploy/boat/level_options.h"
#include "hal_sim/sonar/ping_fault.h"
#include "low_level/tasks/delta_t.h"
#include "low_level/tasks/low_level.h"
#include "mid_level/geometry/obstacle_distance.h"
#include "tests/support/catch.h"
#include "tests/support/speckled_water.h"
#include "tests/unit/tasks/support.h"

namespace lodesman::testing {
namespace {

// A ping a poll, of speckled water with a stone ahead or none, and what is wrong with it.
class WaterSonar final : public ImagingSonar {
 public:
  [[nodiscard]] ReadStatus poll(Time now, SonarPing& out) noexcept override {
    if (is_silent) {
      return ReadStatus::kNothingNew;
    }
    out.number = ++number_;
    out.captured = now;
    out.range_m = 30.0;
    out.make_image(120, 500, to_rad(120.0));
    water.fill(out);
    for (std::uint32_t beam = 54; has_stone && beam < 66; ++beam) {
      for_cells(out, beam, 9.0, 10.0, [this](auto& echo) { echo = water.speckled(150.0); });
    }
    altered.alter(what, 1.0, image_of(out));
    return ReadStatus::kFresh;
  }
  [[nodiscard]] DeviceFault fault() const noexcept override { return by_driver; }

  SpeckledWater water;
  PingFault altered{1};
  Fault what{FaultDevice::kSonar, FaultKind::kNone};
  bool has_stone = true;
  bool is_silent = false;
  DeviceFault by_driver = DeviceFault::kNone;

 private:
  std::uint64_t number_ = 0;
};

[[nodiscard]] DeltaTOptions delta_t_options() {
  return read_low_level_options(TomlDocument::from_file(LODESMAN_DEFAULT_CONFIG).root()).delta_t;
}

struct TroubledDeltaT {
  explicit TroubledDeltaT(const DeltaTOptions& options = delta_t_options())
      : task{*board, Role::kLow, sonar, options} {}

  struct Heard {
    std::size_t pings = 0;
    std::size_t obstacles = 0;
    std::size_t tracks = 0;
  };
  Heard run(int pings) {
    Heard heard;
    for (int i = 0; i < pings; ++i) {
      now += milliseconds{100};
      VehicleState here;
      here.valid_at = now;
      states.publish(here, now);
      task.step(now);
      heard.pings += all_of(pings_out).size();
      heard.obstacles += all_of(obstacles).size();
      heard.tracks += all_of(tracks).size();
    }
    return heard;
  }
  void go_wrong(FaultKind kind, double value = 0.0) {
    sonar.what = {FaultDevice::kSonar, kind, 0.0, 1e5, 0.0, value};
  }
  [[nodiscard]] const DeviceHealth& device() { return health.latest()->value; }
  [[nodiscard]] bool knows_the_stone() {
    const Tracks& known = tracks.latest()->value;
    for (std::uint32_t i = 0; i < known.count; ++i) {
      if (edge_distance_m(known.tracks[i].shape, {{0.0, 9.3}}) < 0.5) {
        return true;
      }
    }
    return false;
  }

  std::unique_ptr<Blackboard> board = std::make_unique<Blackboard>();
  WaterSonar sonar;
  DeltaTTask task;
  Writer<VehicleState> states{board->vehicle_state, Role::kHigh, "vehicle_state"};
  Reader<SonarPing> pings_out{board->sonar_ping};
  Reader<SonarObstacles> obstacles{board->sonar_obstacles};
  Reader<Tracks> tracks{board->tracks};
  Reader<DeviceHealth> health{board->device_health[static_cast<std::size_t>(DeviceId::kSonar)]};
  Time now = kStart;
};

TEST_CASE("delta_t task: from pings that tell nothing come neither obstacles nor tracks",
          "[low_level][tasks]") {
  struct Case {
    FaultKind kind;
    double value;
    DeviceFault told;
  };
  for (const Case& one : {Case{FaultKind::kSaturated, 0.0, DeviceFault::kSaturated},
                          Case{FaultKind::kFrozen, 0.0, DeviceFault::kFrozen},
                          Case{FaultKind::kBlinded, 360.0, DeviceFault::kDeaf}}) {
    CAPTURE(name_of(one.kind));
    TroubledDeltaT delta_t;
    const auto before = delta_t.run(30);
    CHECK(before.obstacles == 30);
    CHECK(before.tracks == 30);
    CHECK(delta_t.device().fault == DeviceFault::kNone);
    delta_t.go_wrong(one.kind, one.value);
    static_cast<void>(delta_t.run(6));  // until it is recognised
    const auto during = delta_t.run(20);
    CHECK(during.pings == 20);
    CHECK(during.obstacles == 0);
    CHECK(during.tracks == 0);
    CHECK(delta_t.device().fault == one.told);
    CHECK(delta_t.device().status == DeviceStatus::kWorking);
    delta_t.go_wrong(FaultKind::kNone);
    const auto after = delta_t.run(12);
    CHECK(after.obstacles == 12);
    CHECK(after.tracks == 12);
    CHECK(delta_t.knows_the_stone());
    CHECK(delta_t.device().fault == DeviceFault::kNone);
  }
}

TEST_CASE("delta_t task: what was seen is remembered where a sector is blind, and that is told",
          "[low_level][tasks]") {
  for (const auto& [kind, told] : {std::pair{FaultKind::kBlinded, DeviceFault::kBlindSector},
                                   std::pair{FaultKind::kNone, DeviceFault::kNone}}) {
    TroubledDeltaT delta_t;
    delta_t.run(30);
    REQUIRE(delta_t.knows_the_stone());
    delta_t.go_wrong(kind, 60.0);
    delta_t.sonar.has_stone = false;
    const auto during = delta_t.run(50);
    CHECK(during.obstacles == 50);
    CHECK(during.tracks == 50);
    CHECK(delta_t.device().fault == told);
    CHECK(delta_t.knows_the_stone() == (kind == FaultKind::kBlinded));
  }
}

TEST_CASE("delta_t task: weed on the head is something near, and is told", "[low_level][tasks]") {
  TroubledDeltaT delta_t;
  delta_t.run(30);
  delta_t.go_wrong(FaultKind::kWeed);
  delta_t.run(20);
  CHECK(delta_t.device().fault == DeviceFault::kWeed);
  const SonarObstacles& seen = delta_t.obstacles.latest()->value;
  REQUIRE(seen.count > 0);
  CHECK(std::hypot(seen.obstacles[0].centre_x_m, seen.obstacles[0].centre_y_m) < 2.0);
}

TEST_CASE("delta_t task: once the pings cease, what they showed is past", "[low_level][tasks]") {
  TroubledDeltaT delta_t;
  delta_t.run(30);
  delta_t.go_wrong(FaultKind::kSaturated);
  delta_t.sonar.by_driver = DeviceFault::kUnusualBeams;  // the lesser trouble
  delta_t.run(10);
  CHECK(delta_t.device().fault == DeviceFault::kSaturated);
  delta_t.sonar.is_silent = true;
  delta_t.sonar.by_driver = DeviceFault::kNoAnswer;
  delta_t.run(40);
  CHECK(delta_t.device().status == DeviceStatus::kSilent);
  CHECK(delta_t.device().fault == DeviceFault::kNoAnswer);
}

TEST_CASE("delta_t task: a known scene needs no echoes, and knows no trouble of them",
          "[low_level][tasks]") {
  DeltaTOptions options = delta_t_options();
  MovingObstacle stone;
  stone.at_start.centre_y_m = 10.0;
  stone.at_start.semi_axis_first_m = stone.at_start.semi_axis_second_m = 0.5;
  options.known_scene = {stone};
  TroubledDeltaT delta_t{options};
  delta_t.go_wrong(FaultKind::kSaturated);
  const auto heard = delta_t.run(20);
  CHECK(heard.obstacles == 20);
  CHECK(heard.tracks == 20);
  CHECK(delta_t.device().fault == DeviceFault::kNone);
}

}  // namespace
}  // namespace lodesman::testing
