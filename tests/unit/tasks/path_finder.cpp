// SPDX-License-Identifier: Apache-2.0
#include "low_level/tasks/path_finder.h"

#include "tests/support/catch.h"
#include "tests/unit/tasks/support.h"

namespace lodesman::testing {
namespace {

struct Finder {
  void ask(std::uint64_t id, std::uint64_t frame) {
    auto request = std::make_unique<PathRequest>();
    request->id = id;
    request->frame = frame;
    request->goal_y_m = 10.0;
    requests.publish(*request, kStart);
  }
  void see(std::uint64_t frame) {
    auto seen = std::make_unique<SonarObstacles>();
    seen->frame = frame;
    seen->captured = kStart;
    seen->range_m = 30.0;
    obstacles.publish(*seen, kStart);
  }

  std::unique_ptr<Blackboard> board = std::make_unique<Blackboard>();
  Writer<PathRequest> requests{board->path_request, Role::kHigh, "path_request"};
  Writer<SonarObstacles> obstacles{board->sonar_obstacles, Role::kLow, "sonar_obstacles"};
  Reader<SonarPath> paths{board->sonar_path};
};

TEST_CASE("path_finder task: each request is answered once in the frame that it names",
          "[low_level][tasks]") {
  Finder finder;
  PathFinderTask task{*finder.board, Role::kLow};
  task.step(kStart);
  CHECK(finder.paths.next() == nullptr);  // nothing was asked
  for (const std::uint64_t frame : {1U, 2U, 3U}) {
    finder.see(frame);
  }
  finder.ask(7, 2);
  task.step(kStart);
  const auto* path = finder.paths.next();
  REQUIRE(path != nullptr);
  CHECK(path->value.request == 7);
  CHECK(path->value.frame == 2);
  CHECK(path->value.reason == PathReason::kFound);
  task.step(kStart + milliseconds{20});
  CHECK(finder.paths.next() == nullptr);
}

TEST_CASE("path_finder task: a frame that is not there is said to be none", "[low_level][tasks]") {
  Finder finder;
  PathFinderTask task{*finder.board, Role::kLow};
  for (const std::uint64_t frame : {4U, 6U}) {  // none seen yet, then one missing between two
    finder.ask(frame, 5);
    task.step(kStart);
    const auto* path = finder.paths.next();
    REQUIRE(path != nullptr);
    CHECK(path->value.reason == PathReason::kNoFrame);
    CHECK(path->value.pixel_count == 0);
    finder.see(4);
    finder.see(6);
  }
}

TEST_CASE("path_finder task: what was asked before it was made is not answered",
          "[low_level][tasks]") {
  Finder finder;
  finder.see(1);
  finder.ask(1, 1);
  PathFinderTask task{*finder.board, Role::kLow};
  task.step(kStart);
  CHECK(finder.paths.next() == nullptr);
  finder.ask(2, 1);
  task.step(kStart);
  CHECK(finder.paths.next() != nullptr);
}

TEST_CASE("path_finder task: a goal that is no number is answered without a path",
          "[low_level][tasks]") {
  Finder finder;
  PathFinderTask task{*finder.board, Role::kLow};
  finder.see(1);
  auto request = std::make_unique<PathRequest>();
  request->id = 1;
  request->frame = 1;
  request->goal_x_m = kNaN;
  finder.requests.publish(*request, kStart);
  task.step(kStart);
  const auto* path = finder.paths.next();
  CHECK((path == nullptr || path->value.reason != PathReason::kFound));
}

}  // namespace
}  // namespace lodesman::testing
