// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/run/estimated_truth.h"

#include <cmath>
#include <memory>

#include "tests/support/catch.h"

using namespace lodesman;
using namespace lodesman::cli;
using std::chrono::milliseconds;
using std::chrono::seconds;

namespace {

Track round_stone(std::uint32_t id, double x_m, double y_m, Time last_seen) {
  Track track;
  track.id = id;
  track.last_seen = last_seen;
  track.shape.centre_x_m = x_m;
  track.shape.centre_y_m = y_m;
  track.shape.semi_axis_first_m = 1.0;
  track.shape.semi_axis_second_m = 1.0;
  return track;
}

// A blackboard that the test writes by hand.
struct Bench {
  void start() {
    MissionStatus status;
    status.state = MissionState::kUnderWay;
    status.first_started = started;
    mission.publish(status, started);
  }
  void track(const Track& value) {
    Tracks all;
    all.captured = value.last_seen;
    all.count = 1;
    all.tracks[0] = value;
    tracks.publish(all, value.last_seen);
  }
  void place(double x_m, double y_m, Time at) {
    VehicleState state;
    state.x_m = x_m;
    state.y_m = y_m;
    state.surge_m_s = 0.7;
    states.publish(state, at);
  }

  std::unique_ptr<Blackboard> board = std::make_unique<Blackboard>();
  Time started{seconds{10}};
  Writer<MissionStatus> mission{board->mission_status, Role::kHigh, "mission_status"};
  Writer<VehicleState> states{board->vehicle_state, Role::kHigh, "vehicle_state"};
  Writer<Tracks> tracks{board->tracks, Role::kLow, "tracks"};
};

[[nodiscard]] WorldTruth newest(const EstimatedTruth& estimated) {
  Reader<WorldTruth> reader{estimated.board().world_truth};
  const auto* truth = reader.latest();
  REQUIRE(truth != nullptr);
  return truth->value;
}

}  // namespace

TEST_CASE("estimated truth: the boat is where it takes itself to be, at the mission's time",
          "[run]") {
  Bench bench;
  EstimatedTruth estimated{*bench.board, 0.5, {}};
  bench.place(1.0, 2.0, bench.started - seconds{1});
  estimated.update();
  CHECK(newest(estimated).scenario_time_s == Approx(0.0));
  bench.start();
  bench.place(3.0, 4.0, bench.started + milliseconds{2500});
  estimated.update();
  const WorldTruth truth = newest(estimated);
  CHECK(truth.scenario_time_s == Approx(2.5));
  CHECK(truth.x_m == Approx(3.0));
  CHECK(truth.y_m == Approx(4.0));
  CHECK(truth.surge_m_s == Approx(0.7));
  CHECK(std::isinf(truth.inoffensive_distance_m));
  CHECK(std::isinf(truth.hull_clearance_m));
}

TEST_CASE(
    "estimated truth: what is tracked is kept clear of, and the least since the start is kept",
    "[run]") {
  Bench bench;
  EstimatedTruth estimated{*bench.board, 0.5, {}};
  bench.track(round_stone(7, 0.0, 10.0, bench.started));
  bench.place(0.0, 8.6, bench.started - seconds{1});  // nearer, but before the mission
  bench.start();
  bench.place(0.0, 6.0, bench.started + seconds{1});
  bench.place(0.0, 7.0, bench.started + seconds{2});
  bench.place(0.0, 2.0, bench.started + seconds{3});
  estimated.update();
  const WorldTruth truth = newest(estimated);
  CHECK(truth.inoffensive_distance_m == Approx(6.5));
  CHECK(truth.least_inoffensive_distance_m == Approx(1.5));
  CHECK(truth.least_inoffensive_distance_at_s == Approx(2.0));
}

TEST_CASE("estimated truth: obstacles that are known stand in the place of tracks", "[run]") {
  Bench bench;
  MovingObstacle known;
  known.at_start = round_stone(1, 0.0, 20.0, {}).shape;
  known.velocity_y_m_s = -1.0;
  EstimatedTruth estimated{*bench.board, 0.5, {known}};
  bench.track(round_stone(7, 0.0, 1.0, bench.started));
  bench.start();
  bench.place(0.0, 0.0, bench.started + seconds{5});
  estimated.update();
  CHECK(newest(estimated).inoffensive_distance_m == Approx(13.5));
}

TEST_CASE(
    "estimated truth: each track is an obstacle from when it was seen, by what was last known",
    "[run]") {
  Bench bench;
  EstimatedTruth estimated{*bench.board, 0.5, {}};
  bench.start();
  bench.track(round_stone(7, 5.0, 10.0, bench.started + seconds{4}));
  Track mover = round_stone(8, 0.0, 30.0, bench.started + seconds{10});
  mover.velocity_y_m_s = -0.5;
  mover.velocity_yy_m2_s2 = 0.001;
  bench.track(mover);
  bench.track(round_stone(7, 5.2, 10.0, bench.started + seconds{12}));
  estimated.update();
  const std::vector<MovingObstacle> seen = estimated.seen();
  REQUIRE(seen.size() == 2);
  CHECK(seen[0].at(20.0).centre_x_m == Approx(5.2));
  CHECK_FALSE(seen[0].exists(3.9));
  CHECK(seen[0].exists(4.0));
  CHECK(seen[1].at(10.0).centre_y_m == Approx(30.0));
  CHECK(seen[1].at(20.0).centre_y_m == Approx(25.0));
}
