// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/run/progress.h"

#include <csignal>

#include "deploy/boat/configuration.h"
#include "deploy/boat/named_scenario.h"
#include "deploy/boat/voyage.h"
#include "deploy/operator/run/way_left.h"
#include "tests/support/full_pipe.h"

using namespace lodesman;
using cli::ProgressLine;
using cli::RunProgress;

namespace {

// Round a square of 10 m, twice, and back to where it began.
Scenario loop() {
  Scenario scenario;
  scenario.name = "loop";
  scenario.speed_m_s = 0.5;
  MissionDefinition& mission = scenario.mission.definition;
  for (int i = 0; i < 2; ++i) {
    for (const auto& [x, y] : {std::pair{0.0, 10.0}, {10.0, 10.0}, {10.0, 0.0}, {0.0, 0.0}}) {
      mission.goals[mission.goal_count++] = {x, y};
    }
  }
  mission.goals[mission.goal_count++] = {0.0, 0.0};
  return scenario;
}

RunProgress under_way(double to_go_m) {
  RunProgress progress;
  progress.state = MissionState::kUnderWay;
  progress.scenario_time_s = 10.0;
  progress.to_go_m = to_go_m;
  progress.truth.inoffensive_distance_m = 1e300;
  return progress;
}

std::size_t filled(const std::string& line) {
  return static_cast<std::size_t>(std::count(line.begin(), line.end(), '#'));
}

}  // namespace

TEST_CASE("progress: the way left leads through the waypoints that are left", "[run]") {
  const Scenario scenario = loop();
  CHECK(cli::way_left_m(scenario.mission, 0, {{0.0, 0.0}}) == Approx(80.0));
  CHECK(cli::way_left_m(scenario.mission, 4, {{0.0, 3.0}}) == Approx(37.0));
  CHECK(cli::way_left_m(scenario.mission, 8, {{0.0, 3.0}}) == Approx(3.0));
  CHECK(cli::way_left_m(scenario.mission, 99, {{3.0, 4.0}}) == Approx(5.0));
}

TEST_CASE("progress: a loop's bar fills along its waypoints", "[run]") {
  const testing::Pipe pipe;
  const ProgressLine line{loop(), false, pipe.writer()};
  CHECK(filled(line.line(under_way(80.0))) == 0);
  CHECK(filled(line.line(under_way(40.0))) == 12);
  CHECK(filled(line.line(under_way(0.0))) == 24);
  CHECK(line.line({}).find("waiting for the start") != std::string::npos);
}

TEST_CASE("progress: nobody who reads it is waited for", "[run]") {
  const testing::Pipe pipe;
  ProgressLine line{loop(), false, pipe.writer()};
  line.show(under_way(40.0));
  line.say("news");
  const std::string text = pipe.read_some();
  CHECK(text.find("loop  [############............]") == 0);
  CHECK(text.find("\nnews\n") != std::string::npos);
  pipe.fill();
  line.say("lost");
  CHECK_FALSE(line.failed());
}

TEST_CASE("progress: what cannot be written ends nothing and is told", "[run]") {
  std::signal(SIGPIPE, SIG_IGN);
  testing::Pipe pipe;
  ProgressLine line{loop(), false, pipe.writer()};
  CHECK_FALSE(line.failed());
  pipe.close_reader();
  line.say("lost");
  CHECK(line.failed());
  line.show(under_way(40.0));
  CHECK(line.failed());
}

TEST_CASE("progress: to those who want quiet only a warning is said", "[run]") {
  const testing::Pipe pipe;
  ProgressLine line{loop(), true, pipe.writer()};
  line.show(under_way(40.0));
  line.say("news");
  line.warn("a warning");
  CHECK(pipe.read_some() == "a warning\n");
}
