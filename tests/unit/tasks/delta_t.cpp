// SPDX-License-Identifier: Apache-2.0
#include "low_level/tasks/delta_t.h"
#include "deploy/boat/level_options.h"

#include "low_level/tasks/low_level.h"
#include "tests/support/catch.h"
#include "tests/unit/tasks/support.h"

namespace lodesman::testing {
namespace {

[[nodiscard]] DeltaTOptions shipped_options() {
  return read_low_level_options(TomlDocument::from_file(LODESMAN_DEFAULT_CONFIG).root()).delta_t;
}

[[nodiscard]] DeltaTOptions with_known_scene() {
  MovingObstacle obstacle;
  obstacle.at_start.id = 1;
  obstacle.at_start.centre_y_m = 10.0;
  obstacle.at_start.semi_axis_first_m = obstacle.at_start.semi_axis_second_m = 0.5;
  DeltaTOptions options = shipped_options();
  options.known_scene = {obstacle};
  return options;
}

struct DeltaT {
  explicit DeltaT(const DeltaTOptions& options) : task{*board, Role::kLow, sonar, options} {}

  void estimate(Time at) {
    VehicleState here;
    here.valid_at = at;
    state.publish(here, at);
  }
  // How many frames of obstacles a step at that time published.
  [[nodiscard]] std::size_t frames_after_step(Time now) {
    task.step(now);
    return all_of(obstacles).size();
  }

  std::unique_ptr<Blackboard> board = std::make_unique<Blackboard>();
  ScriptedSonar sonar;
  DeltaTTask task;
  Writer<VehicleState> state{board->vehicle_state, Role::kHigh, "vehicle_state"};
  Reader<SonarPing> pings{board->sonar_ping};
  Reader<SonarObstacles> obstacles{board->sonar_obstacles};
  Reader<Tracks> tracks{board->tracks};
};

TEST_CASE("delta_t task: a ping is published with what was found in it", "[low_level][tasks]") {
  DeltaT delta_t{shipped_options()};
  delta_t.estimate(kStart);
  CHECK(delta_t.frames_after_step(kStart) == 1);
  CHECK(all_of(delta_t.pings).size() == 1);
  CHECK(all_of(delta_t.tracks).size() == 1);
}

TEST_CASE("delta_t task: returns of a profile become obstacles, as echoes of an image do",
          "[low_level][tasks]") {
  DeltaTOptions options = shipped_options();
  options.segmentation.profile.min_points = 1;
  DeltaT delta_t{options};
  delta_t.sonar.profile_m = 7.0;
  delta_t.estimate(kStart);
  delta_t.task.step(kStart);
  CHECK(all_of(delta_t.pings).size() == 1);
  const auto seen = all_of(delta_t.obstacles);
  REQUIRE(seen.size() == 1);
  const SonarObstacles& newest = seen.front();
  REQUIRE(newest.count == 2);  // 57 degrees apart
  for (std::uint32_t i = 0; i < newest.count; ++i) {
    CHECK(std::hypot(newest.obstacles[i].centre_x_m, newest.obstacles[i].centre_y_m) ==
          Approx(7.0).margin(0.05));
  }
}

TEST_CASE("delta_t task: without a ping nothing is published", "[low_level][tasks]") {
  for (const auto status :
       {ReadStatus::kNothingNew, ReadStatus::kCorrupt, ReadStatus::kDisconnected}) {
    DeltaT delta_t{shipped_options()};
    delta_t.sonar.status = status;
    CHECK(delta_t.frames_after_step(kStart) == 0);
    CHECK(all_of(delta_t.pings).empty());
    delta_t.sonar.status = ReadStatus::kFresh;
    CHECK(delta_t.frames_after_step(kStart) == 1);  // it came back
  }
}

TEST_CASE("delta_t task: what is seen has a place in the world only where the estimate is fresh",
          "[low_level][tasks]") {
  DeltaT delta_t{shipped_options()};
  CHECK(delta_t.frames_after_step(kStart) == 1);
  CHECK(all_of(delta_t.tracks).empty());  // no estimate yet
  delta_t.estimate(kStart);
  CHECK(delta_t.frames_after_step(kStart + max_age::kVehicleState + Duration{1}) == 1);
  CHECK(all_of(delta_t.tracks).empty());  // it is stale
}

// One ping with a single echo ahead, sent so long before it is read.
class EchoSonar final : public ImagingSonar {
 public:
  explicit EchoSonar(Duration age) : age_{age} {}
  [[nodiscard]] ReadStatus poll(Time now, SonarPing& out) noexcept override {
    if (given_) {
      return ReadStatus::kNothingNew;
    }
    given_ = true;
    out.number = 1;
    out.captured = now - age_;
    out.range_m = 30.0;
    out.make_image(64, 150, 2.0);
    out.echo.fill(0);
    for (std::uint32_t beam = 30; beam < 34; ++beam) {
      for (std::uint32_t bin = 70; bin < 75; ++bin) {
        out.echo[beam * out.bins + bin] = 255;
      }
    }
    return ReadStatus::kFresh;
  }

 private:
  Duration age_;
  bool given_ = false;
};

// How far north the echo is placed: sailed at 1 m/s, and a fix leapt by 5 m at the very end.
[[nodiscard]] double echo_placed_at_m(Duration age, double leap_m) {
  auto board = std::make_unique<Blackboard>();
  EchoSonar sonar{age};
  DeltaTTask task{*board, Role::kLow, sonar, shipped_options()};
  Writer<VehicleState> states{board->vehicle_state, Role::kHigh, "vehicle_state"};
  Reader<Tracks> tracks{board->tracks};
  for (int i = 0; i <= 20; ++i) {
    VehicleState here;
    here.valid_at = kStart + i * milliseconds{20};
    here.odometry_y_m = 0.02 * i;
    here.y_m = here.odometry_y_m + (i == 20 ? leap_m : 0.0);
    states.publish(here, here.valid_at);
  }
  task.step(kStart + milliseconds{400});
  const auto placed = all_of(tracks);
  REQUIRE(placed.size() == 1);
  REQUIRE(placed.front().count == 1);
  return placed.front().tracks[0].shape.centre_y_m;
}

TEST_CASE("delta_t task: an echo is placed by the odometry at its own time", "[low_level][tasks]") {
  const double at_once_m = echo_placed_at_m(Duration{}, 0.0);
  CHECK(at_once_m > 13.0);
  CHECK(echo_placed_at_m(milliseconds{300}, 0.0) == Approx(at_once_m - 0.3));
  // The newest estimate says where the world is, the odometry how far the boat has gone since.
  CHECK(echo_placed_at_m(milliseconds{300}, 5.0) == Approx(at_once_m - 0.3 + 5.0));
}

TEST_CASE("delta_t task: what was seen of the water is told in the world, before the tracks",
          "[low_level][tasks]") {
  DeltaT delta_t{shipped_options()};
  Reader<Coverage> coverage{delta_t.board->coverage};
  VehicleState here;
  here.valid_at = kStart;
  here.x_m = here.odometry_x_m + 300.0;
  here.y_m = here.odometry_y_m - 50.0;
  delta_t.state.publish(here, kStart);
  delta_t.task.step(kStart);
  const auto* water = coverage.latest();
  REQUIRE(water != nullptr);
  CHECK(water->value.frame == delta_t.tracks.latest()->value.frame);
  CHECK(water->value.captured == delta_t.tracks.latest()->value.captured);
  CHECK(water->value.at(300.0, -49.5) == WaterState::kFree);
  CHECK(water->value.at(0.0, 0.5) == WaterState::kUnknown);
}

TEST_CASE("delta_t task: of a known scene nothing is unseen", "[low_level][tasks]") {
  DeltaT delta_t{with_known_scene()};
  delta_t.estimate(kStart);
  REQUIRE(delta_t.frames_after_step(kStart) == 1);
  CHECK(Reader<Coverage>{delta_t.board->coverage}.latest() == nullptr);
}

TEST_CASE("delta_t task: a known scene is drawn at a fresh estimate or not at all",
          "[low_level][tasks]") {
  DeltaT delta_t{with_known_scene()};
  CHECK(delta_t.frames_after_step(kStart) == 0);
  delta_t.estimate(kStart + seconds{3600});  // of the future
  CHECK(delta_t.frames_after_step(kStart) == 0);
  delta_t.estimate(kStart);
  CHECK(delta_t.frames_after_step(kStart) == 1);
  CHECK(delta_t.obstacles.latest()->value.count == 1);
  CHECK(delta_t.frames_after_step(kStart + max_age::kVehicleState + Duration{1}) == 0);
}

TEST_CASE("delta_t task: a ping waits a moment for the estimate of its own time",
          "[low_level][tasks]") {
  for (const auto& options : {shipped_options(), with_known_scene()}) {
    DeltaT delta_t{options};
    delta_t.estimate(kStart - milliseconds{20});
    CHECK(delta_t.frames_after_step(kStart) == 0);
    CHECK(all_of(delta_t.pings).size() == 1);
    delta_t.sonar.status = ReadStatus::kNothingNew;
    CHECK(delta_t.frames_after_step(kStart + Duration{1}) == 0);
    delta_t.estimate(kStart + Duration{2});
    CHECK(delta_t.frames_after_step(kStart + Duration{3}) == 1);
    CHECK(all_of(delta_t.tracks).size() == 1);
    CHECK(delta_t.frames_after_step(kStart + milliseconds{20}) == 0);
    CHECK(all_of(delta_t.pings).empty());

    // Where it does not come, the last one has to do.
    delta_t.sonar.status = ReadStatus::kFresh;
    CHECK(delta_t.frames_after_step(kStart + milliseconds{100}) == 0);
    delta_t.sonar.status = ReadStatus::kNothingNew;
    CHECK(delta_t.frames_after_step(kStart + milliseconds{120}) == 1);
  }
}

}  // namespace
}  // namespace lodesman::testing
