// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

#include "deploy/operator/report/gnuplot.h"
#include "deploy/operator/report/plot_script.h"
#include "deploy/operator/report/plots.h"
#include "deploy/operator/report/program_call.h"
#include "deploy/operator/report/run_files.h"
#include "deploy/operator/report/world_story.h"
#include "mid_level/base/startup_error.h"
#include "tests/support/catch.h"
#include "tests/unit/report/sample_runs.h"
#include "tests/unit/report/temporary_directory.h"

using namespace lodesman;

namespace {

constexpr const char* kNames[] = {"world.png", "inoffensive_distance.png", "heading.png",
                                  "thrust.png"};

bool is_png(const std::filesystem::path& path) {
  std::ifstream file{path, std::ios::binary};
  const std::string bytes{std::istreambuf_iterator<char>{file}, {}};
  return bytes.size() > 1000 && bytes.starts_with("\x89PNG\r\n\x1a\n");
}

const std::filesystem::path kScripts{LODESMAN_SOURCE_DIR "/deploy/pictures"};

// As a run leaves its directory.
void write_and_draw(const std::filesystem::path& directory, const cli::RunRecord& run) {
  cli::RunFiles files{directory};
  for (const cli::TrajectoryRow& row : run.trajectory) {
    files.add(row);
  }
  files.finish(run.result);
  REQUIRE(files.fault().empty());
  cli::draw_pictures(directory, run, kScripts);
}

void check_pictures(const cli::RunRecord& run) {
  const testing::TemporaryDirectory directory;
  write_and_draw(directory.path(), run);
  for (const char* name : kNames) {
    INFO(name);
    CHECK(is_png(directory.path() / name));
  }
  const auto files = std::distance(std::filesystem::directory_iterator{directory.path()},
                                   std::filesystem::directory_iterator{});
  CHECK(files == 7);  // and three of text
}

std::string refusal(const std::filesystem::path& png, const std::string& script) {
  try {
    cli::draw_picture(png, {}, script);
  } catch (const StartupError& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("pictures: runs of every kind are drawn", "[report]") {
  SECTION("static") { check_pictures(testing::static_run()); }
  SECTION("moving") { check_pictures(testing::moving_run()); }
  SECTION("ellipses") { check_pictures(testing::trap_run()); }
  SECTION("walls") { check_pictures(testing::wall_run()); }
}

TEST_CASE("pictures: runs with next to nothing in them are drawn", "[report]") {
  cli::RunRecord run = testing::static_run();
  SECTION("nothing at all") { run = {}; }
  SECTION("no obstacles") {
    run.obstacles.clear();
    run.result.min_inoffensive_distance_m.reset();
    run.result.time_of_min_inoffensive_distance_s.reset();
    for (auto& row : run.trajectory) {
      row.id_m = std::numeric_limits<double>::infinity();
    }
  }
  SECTION("no plans") { run.plans.clear(); }
  SECTION("no plan found") {
    for (auto& plan : run.plans) {
      plan.reason = PathReason::kGoalOutOfView;
      plan.path_m.clear();
      plan.waypoints_m.clear();
      plan.waypoint_source = "none";
    }
  }
  SECTION("one row") { run.trajectory.resize(1); }
  SECTION("a vehicle that stays where it is") {
    for (auto& row : run.trajectory) {
      row.x_m = row.y_m = 0.0;
    }
    run.goal_m = run.start_m;
  }
  SECTION("a name with quotes and line ends") {
    run.result.scenario = "it's \"a\" `date` $x \n_{name}^2 \\";
  }
  SECTION("numbers that are none") {
    run.trajectory[5].x_m = std::numeric_limits<double>::quiet_NaN();
    run.trajectory[6].heading_deg = std::numeric_limits<double>::infinity();
  }
  check_pictures(run);
}

TEST_CASE("pictures: a directory's name may hold anything", "[report]") {
  const testing::TemporaryDirectory directory;
  const auto odd = directory.path() / "it's `a` \"run\" $HOME \\";
  std::filesystem::create_directory(odd);
  write_and_draw(odd, testing::static_run());
  CHECK(is_png(odd / "world.png"));
  CHECK(is_png(odd / "thrust.png"));
}

TEST_CASE("pictures: a missing gnuplot is named with its package", "[report]") {
  const testing::TemporaryDirectory directory;
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", directory.path().c_str(), 1);
  const std::string message = refusal(directory.path() / "a.png", "plot sin(x)");
  ::setenv("PATH", path.c_str(), 1);
  CHECK(message == (directory.path() / "a.png").string() +
                       ": gnuplot is missing: apt-get install gnuplot-nox");
}

TEST_CASE("pictures: a file that cannot be written or drawn is named, none is left", "[report]") {
  const testing::TemporaryDirectory directory;
  const auto missing = directory.path() / "missing" / "a.png";
  CHECK(refusal(missing, "plot sin(x)") ==
        missing.string() + ": cannot be written: No such file or directory");
  const auto broken = directory.path() / "b.png";
  // Longer than a pipe holds: the rest must not kill this process either.
  CHECK(refusal(broken, "exit\n" + std::string(1'000'000, '#')) ==
        broken.string() + ": gnuplot could not draw it");
  CHECK_FALSE(std::filesystem::exists(broken));
}

TEST_CASE("pictures: what gnuplot says of a script is passed on, and its exit status decides",
          "[report]") {
  const testing::TemporaryDirectory directory;
  const auto png = directory.path() / "a.png";
  const std::string complaint = png.string() + ": gnuplot could not draw it: ";
  CHECK(refusal(png, "plot x\nplot nonsense").starts_with(complaint));
  CHECK(refusal(png, "plot x\nplot nonsense").ends_with("undefined variable: nonsense"));
  CHECK(refusal(png, "plot x\nunset output\nexit status 3") == complaint + "exit status 3");
  CHECK_FALSE(std::filesystem::exists(png));
}

TEST_CASE("pictures: a script that is gone or a trajectory that is lost is a picture not drawn",
          "[report]") {
  const testing::TemporaryDirectory directory;
  const cli::RunRecord run = testing::static_run();
  CHECK_THROWS_AS(cli::draw_pictures(directory.path(), run, kScripts), StartupError);
  CHECK_FALSE(std::filesystem::exists(directory.path() / "heading.png"));
  CHECK_THROWS_AS(cli::draw_by_file(directory.path() / "a.png", kScripts / "none.gp", ""),
                  StartupError);
}

// The shipped scripts alone, as README.md has a user run them.
TEST_CASE("pictures: a script draws a run by itself", "[report]") {
  const testing::TemporaryDirectory directory;
  write_and_draw(directory.path(), testing::static_run());
  for (const std::string name : {"inoffensive_distance", "heading", "thrust"}) {
    const auto png = directory.path() / (name + ".png");
    std::filesystem::remove(png);
    const cli::ProgramResult result = cli::run_program(
        {{"gnuplot", "-c", (kScripts / (name + ".gp")).string(), directory.path().string()},
         "/",
         "",
         STDERR_FILENO});
    INFO(name << ": " << result.reason);
    CHECK(result.end == cli::ProgramEnd::kSuccess);
    CHECK(is_png(png));
  }
}

TEST_CASE("pictures: any name of a file is that file's", "[report]") {
  const testing::TemporaryDirectory directory;
  const auto png = directory.path() / "a\nset output; 'b\" `c`\\.png";
  cli::draw_picture(png, {}, "plot x");
  CHECK(is_png(png));
  CHECK(std::distance(std::filesystem::directory_iterator{directory.path()},
                      std::filesystem::directory_iterator{}) == 1);
}

TEST_CASE("story: four moments tell of first plan, new side, no path and end", "[report]") {
  const cli::RunRecord run = testing::static_run();
  const auto moments = cli::story(run);
  REQUIRE(moments.size() == 4);
  CHECK(moments[0].caption == "first plan");
  CHECK(moments[1].caption == "path changes side");
  CHECK(moments[2].caption == "no path: start blocked");
  CHECK(moments[3].caption == "goal reached");
  REQUIRE(moments[1].replaced != nullptr);
  CHECK(moments[1].replaced->t_s < moments[1].plan->t_s);
  CHECK(moments[2].plan->waypoint_source == "previous");
  CHECK(moments[2].last_found->t_s < moments[2].plan->t_s);
  CHECK(moments[3].is_end);
}

TEST_CASE("story: a run of nothing has its end", "[report]") {
  const auto moments = cli::story({});
  REQUIRE(moments.size() == 1);
  CHECK(moments[0].is_end);
  CHECK(moments[0].plan == nullptr);
}

TEST_CASE("view box: far ends of a wall do not shrink the run", "[report]") {
  const cli::RunRecord run = testing::wall_run();
  const auto box = cli::view_box(run, cli::story(run));
  CHECK(box.high[0] < 10.0);
  CHECK(box.low[0] < -14.0);
  CHECK(box.high[1] > 16.0);
}

// Draws every sample run below the working directory, to be looked at.
TEST_CASE("pictures: samples to look at", "[.samples]") {
  const std::pair<const char*, cli::RunRecord> runs[] = {{"static", testing::static_run()},
                                                         {"moving", testing::moving_run()},
                                                         {"trap", testing::trap_run()},
                                                         {"wall", testing::wall_run()},
                                                         {"nothing", {}}};
  for (const auto& [name, run] : runs) {
    const auto directory = std::filesystem::path{"report_samples"} / name;
    std::filesystem::create_directories(directory);
    CHECK_NOTHROW(write_and_draw(directory, run));
  }
}
