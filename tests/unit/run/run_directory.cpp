// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/run/run_directory.h"

#include <fstream>
#include <set>
#include <thread>
#include <vector>

#include "mid_level/base/startup_error.h"
#include "tests/support/catch.h"
#include "tests/unit/report/temporary_directory.h"

using namespace lodesman;
namespace fs = std::filesystem;

namespace {

void touch(const fs::path& file) {
  fs::create_directories(file.parent_path());
  std::ofstream{file} << "x";
}

}  // namespace

TEST_CASE("run directory: a name that is taken gets a number", "[run]") {
  const testing::TemporaryDirectory place;
  const fs::path name = place.path() / "runs" / "a";
  CHECK(cli::make_new_directory(name) == name);
  CHECK(cli::make_new_directory(name) == place.path() / "runs" / "a-2");
  CHECK(cli::make_new_directory(name) == place.path() / "runs" / "a-3");
}

TEST_CASE("run directory: all who want one at once get one of their own", "[run]") {
  const testing::TemporaryDirectory place;
  std::vector<fs::path> made(8);
  std::vector<std::thread> threads;
  for (fs::path& directory : made) {
    threads.emplace_back([&] { directory = cli::make_new_directory(place.path() / "a"); });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
  CHECK(std::set<fs::path>{made.begin(), made.end()}.size() == 8);
}

TEST_CASE("run directory: one that holds a run is refused, an empty or other one is not", "[run]") {
  const testing::TemporaryDirectory place;
  const fs::path out = place.path() / "deep" / "out";
  CHECK(cli::make_named_directory(out, false) == out);
  touch(out / "notes.txt");
  CHECK(cli::make_named_directory(out, false) == out);
  CHECK(cli::make_named_directory(out / "", false) == out);
  for (const char* name : {"result.json", "result.json.part", "trajectory.csv", "sonar/000000.jpg",
                           "config.toml", "thrust.png"}) {
    INFO(name);
    touch(out / name);
    CHECK_THROWS_WITH(cli::make_named_directory(out, false),
                      "--out: " + out.string() + ": holds a run already; --force writes over it");
    CHECK(cli::make_named_directory(out, true) == out);
    CHECK_FALSE(cli::holds_a_run(out));
  }
  CHECK(fs::exists(out / "notes.txt"));
}

TEST_CASE("run directory: force removes what runs write and nothing else", "[run]") {
  const testing::TemporaryDirectory place;
  const fs::path out = place.path() / "out";
  for (const char* name : {"result.json", "sonar/000000.jpg", "sonar/000001.jpg.part",
                           "sonar/mine.jpg", "sonar/000002.txt", "mine.png"}) {
    touch(out / name);
  }
  CHECK(cli::make_named_directory(out, true) == out);
  CHECK_FALSE(fs::exists(out / "result.json"));
  CHECK_FALSE(fs::exists(out / "sonar/000000.jpg"));
  CHECK_FALSE(fs::exists(out / "sonar/000001.jpg.part"));
  CHECK(fs::exists(out / "sonar/mine.jpg"));
  CHECK(fs::exists(out / "sonar/000002.txt"));
  CHECK(fs::exists(out / "mine.png"));
}

TEST_CASE("run directory: what is no directory is refused", "[run]") {
  const testing::TemporaryDirectory place;
  touch(place.path() / "file");
  CHECK_THROWS_AS(cli::make_named_directory(place.path() / "file", true), StartupError);
  CHECK_THROWS_AS(cli::make_named_directory(place.path() / "file" / "under", true), StartupError);
}

TEST_CASE("run directory: a run is named by its time, one without a clock says so", "[run]") {
  constexpr std::int64_t kNow_ns = 1'795'804'200'000'000'000;
  CHECK(cli::run_name(kNow_ns, "a") == "20261127T183000Z-a");
  CHECK(cli::run_name(0, "a") == "no-clock-a");
  CHECK(cli::run_name(1'735'689'599'999'999'999, "a") == "no-clock-a");
  CHECK(cli::has_no_clock("runs/no-clock-a-2"));
  CHECK_FALSE(cli::has_no_clock("runs/20261127T183000Z-no-clock"));
}

TEST_CASE("run directory: one without a clock takes the time that was learnt, and no other's name",
          "[run]") {
  constexpr std::int64_t kThen_ns = 1'795'804'200'000'000'000;
  const testing::TemporaryDirectory place;
  const fs::path other = place.path() / "20261127T183000Z-a";
  touch(other / "result.json");
  const fs::path made = cli::make_new_directory(place.path() / cli::run_name(0, "a"));
  touch(made / "trajectory.csv");
  CHECK(cli::rename_by_clock(made, 0, "a") == made);
  const fs::path known = cli::rename_by_clock(made, kThen_ns, "a");
  CHECK(known == place.path() / "20261127T183000Z-a-2");
  CHECK(fs::exists(known / "trajectory.csv"));
  CHECK(fs::exists(other / "result.json"));
  CHECK_FALSE(fs::exists(made));
  // What is no more cannot be renamed: nothing is left behind.
  CHECK(cli::rename_by_clock(made, kThen_ns, "a") == made);
  CHECK_FALSE(fs::exists(place.path() / "20261127T183000Z-a-3"));
}
