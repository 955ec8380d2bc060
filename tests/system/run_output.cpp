// SPDX-License-Identifier: Apache-2.0
// What a run keeps where its disk is full, its terminal is gone or nobody reads what it says, and
// what is never called a success.
#include <sys/mount.h>
#include <sys/resource.h>

#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/support/full_pipe.h"
#include "tests/support/text_of.h"
#include "tests/system/program.h"

using namespace lodesman;
using namespace lodesman::testing;

namespace {

nlohmann::json result_of(const fs::path& run) {
  return nlohmann::json::parse(std::ifstream{run / "result.json"}, nullptr, false);
}

std::size_t lines_in(const fs::path& file) {
  const std::string text = text_of(file);
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

std::vector<std::string> lockstep(const fs::path& scenario, const fs::path& out,
                                  std::vector<std::string> more = {}) {
  more.emplace_back("--lockstep");
  return sim(scenario, out, more);
}

// A disk of a test's own, which only root can make.
class SmallDisk {
 public:
  SmallDisk(fs::path place, const char* options) : place_{std::move(place)} {
    fs::create_directories(place_);
    is_there_ = mount("tmpfs", place_.c_str(), "tmpfs", 0, options) == 0;
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  ~SmallDisk() {
    if (is_there_) {
      umount2(place_.c_str(), MNT_DETACH);
    }
  }
  [[nodiscard]] bool is_there() const { return is_there_; }
  [[nodiscard]] const fs::path& place() const { return place_; }

 private:
  fs::path place_;
  bool is_there_ = false;
};

}  // namespace

TEST_CASE("run output: a run whose disk fills goes on, says so and keeps its result", "[system]") {
  const Scratch scratch{"small-disk"};
  const SmallDisk disk{scratch.file("disk"), "size=128k"};
  if (!disk.is_there()) {
    std::cout << "skipped: a small disk needs root\n";
    return;
  }
  const auto said = scratch.file("said");
  const auto scenario = scratch.file("short.toml", scenario_text(15.0));
  std::vector<std::string> arguments = lockstep(scenario, disk.place() / "run", {"--quiet"});
  arguments.erase(std::find(arguments.begin(), arguments.end(), "--no-images"));
  Program launcher{program("lodesman"), arguments, [file = said.string()] {
                     redirect(STDERR_FILENO, file.c_str(), O_WRONLY | O_CREAT);
                   }};
  CHECK(launcher.status() == 4);
  CHECK(result_of(disk.place() / "run")["outcome"] == "goal");
  const std::string text = text_of(said);
  CHECK(text.find("cannot be written: No space left on device") != std::string::npos);
  CHECK(std::count(text.begin(), text.end(), '\n') == 1);
  // What there is is whole.
  const std::string plans = text_of(disk.place() / "run" / "plans.jsonl");
  CHECK((plans.empty() || plans.back() == '\n'));
  for (const auto& entry : fs::recursive_directory_iterator{disk.place()}) {
    CHECK(entry.path().extension() != ".part");
  }
}

TEST_CASE("run output: where no file may grow the result is still kept", "[system]") {
  const Scratch scratch{"quota"};
  const auto scenario = scratch.file("short.toml", scenario_text(15.0));
  const auto out = scratch.file("run");
  Program launcher{program("lodesman"), lockstep(scenario, out, {"--quiet"}), [] {
                     const rlimit limit{16384, 16384};
                     setrlimit(RLIMIT_FSIZE, &limit);
                   }};
  CHECK(launcher.status() == 4);
  CHECK(result_of(out)["outcome"] == "goal");
  CHECK(fs::file_size(out / "plans.jsonl") <= 16384);
  CHECK(fs::file_size(out / "plans.jsonl") > 8192);
  CHECK(text_of(out / "plans.jsonl").back() == '\n');
}

TEST_CASE("run output: standard error that is full, closed or broken ends no run", "[system]") {
  const Scratch scratch{"no-error-stream"};
  const auto scenario = scratch.file("short.toml", scenario_text(4.0));
  Pipe broken;
  broken.close_reader();
  const std::vector<std::pair<const char*, std::function<void()>>> rows{
      {"full", [] { redirect(STDERR_FILENO, "/dev/full", O_WRONLY); }},
      {"closed", [] { close(STDERR_FILENO); }},
      {"broken", [&] { dup2(broken.writer(), STDERR_FILENO); }}};
  for (const auto& [name, surroundings] : rows) {
    for (const bool real_time : {false, true}) {
      INFO(name << (real_time ? " in real time" : " in lock-step"));
      const auto out = scratch.file(std::string{name} + (real_time ? "-real" : "-lockstep"));
      Program launcher{program("lodesman"),
                       real_time ? sim(scenario, out) : lockstep(scenario, out), surroundings};
      CHECK(launcher.status() == 4);
      CHECK(result_of(out)["outcome"] == "goal");
      CHECK(lines_in(out / "trajectory.csv") > 40);
    }
  }
}

TEST_CASE("run output: a pipe that nobody reads holds up neither time limit nor stop", "[system]") {
  const Scratch scratch{"stuck-pipe"};
  const auto scenario = scratch.file("far.toml", scenario_text(25.0));
  for (const int signal : {0, SIGTERM, SIGINT}) {
    INFO("signal " << signal);
    const Pipe stuck;
    stuck.fill();
    const auto out = scratch.file("run-" + std::to_string(signal));
    Program launcher{program("lodesman"), sim(scenario, out, {"--time-limit", "4"}),
                     [&] { dup2(stuck.writer(), STDERR_FILENO); }};
    const auto board = under_way(launcher);
    if (signal != 0) {
      REQUIRE(kill(launcher.pid(), signal) == 0);
    }
    CHECK(launcher.status() == 1);
    CHECK(result_of(out)["outcome"] == (signal == 0 ? "time_limit" : "aborted"));
    CHECK_FALSE(board.alive(Role::kLow));
  }
}

TEST_CASE("run output: lines stand in their files before the run has ended", "[system]") {
  const Scratch scratch{"as-it-goes"};
  const auto scenario = scratch.file("far.toml", scenario_text(25.0));
  const auto out = scratch.file("run");
  Program launcher{program("lodesman"), sim(scenario, out, {"--quiet"})};
  REQUIRE(eventually([&] { return lines_in(out / "trajectory.csv") > 20; }));
  REQUIRE(eventually([&] { return lines_in(out / "plans.jsonl") > 20; }));
  CHECK_FALSE(fs::exists(out / "result.json"));
  REQUIRE(kill(launcher.pid(), SIGKILL) == 0);
  CHECK(launcher.status() == 128 + SIGKILL);
  std::ifstream plans{out / "plans.jsonl"};
  std::string line;
  for (std::string next; std::getline(plans, next) && !plans.eof(); line = next) {
    CHECK(nlohmann::json::accept(next));
  }
  CHECK_FALSE(line.empty());
}

TEST_CASE("run output: lock-step is interrupted with its results", "[system]") {
  const Scratch scratch{"lockstep-stop"};
  for (const int signal : {SIGHUP, SIGTERM, SIGINT}) {
    INFO("signal " << signal);
    const auto out = scratch.file("run-" + std::to_string(signal));
    // So long that it lasts until the signal.
    const auto scenario = scratch.file(
        "long.toml", std::string{"name = \"long\"\nseed = 1\ntime_limit_s = 99999.0\n[mission]\n"
                                 "start_m = [0.0, 0.0]\nstart_heading_deg = 0.0\n"
                                 "goal_m = [0.0, 1900.0]\ngoal_radius_m = 0.5\n[vehicle]\n"
                                 "speed_m_s = 0.11\nradius_m = 0.5\n"});
    Program launcher{program("lodesman"), lockstep(scenario, out, {"--quiet"})};
    REQUIRE(eventually([&] { return lines_in(out / "trajectory.csv") > 1; }));
    REQUIRE(kill(launcher.pid(), signal) == 0);
    CHECK(launcher.status() == 1);
    CHECK(result_of(out)["outcome"] == "aborted");
  }
}

TEST_CASE("run output: runs that begin in one second have directories of their own", "[system]") {
  const Scratch scratch{"same-second"};
  const auto scenario = scratch.file("short.toml", scenario_text(2.0));
  const auto place = scratch.file("place");
  fs::create_directories(place);
  std::vector<std::unique_ptr<Program>> runs;
  for (int seed = 1; seed <= 8; ++seed) {
    runs.push_back(std::make_unique<Program>(
        program("lodesman"),
        std::vector<std::string>{"sim", scenario.string(), "--lockstep", "--no-images", "--quiet",
                                 "--seed", std::to_string(seed)},
        [&] { static_cast<void>(chdir(place.c_str()) == 0); }));
  }
  for (const auto& run : runs) {
    CHECK(run->status() == 0);
  }
  std::set<int> seeds;
  for (const auto& entry : fs::directory_iterator{place / "runs"}) {
    seeds.insert(result_of(entry.path())["seed"].get<int>());
  }
  CHECK(seeds.size() == 8);
}

TEST_CASE("run output: a directory that holds a run is refused, unless it is forced", "[system]") {
  const Scratch scratch{"reused"};
  const auto scenario = scratch.file("short.toml", scenario_text(2.0));
  const auto out = scratch.file("run");
  const auto status = [&](const std::vector<std::string>& more) {
    return Program{program("lodesman"), lockstep(scenario, out, more)}.status();
  };
  REQUIRE(status({"--quiet", "--seed", "1"}) == 0);
  std::ofstream{out / "mine.txt"} << "notes";
  fs::create_directories(out / "sonar");
  std::ofstream{out / "sonar" / "000123.jpg"} << "of the run before";
  CHECK(status({"--quiet", "--seed", "2"}) == 2);
  CHECK(result_of(out)["seed"] == 1);
  CHECK(status({"--quiet", "--seed", "3", "--force"}) == 0);
  CHECK(result_of(out)["seed"] == 3);
  CHECK_FALSE(fs::exists(out / "sonar" / "000123.jpg"));
  CHECK(text_of(out / "mine.txt") == "notes");
}

TEST_CASE("run output: what could not be written on standard output is no success", "[system]") {
  const Scratch scratch{"no-output"};
  const auto scenario = scratch.file("short.toml", scenario_text(2.0));
  {
    std::ofstream image{scratch.file("a.pgm"), std::ios::binary};
    image << "P5\n120 500\n255\n" << std::string(60000, '\0');
  }
  const std::string frames =
      R"({"id": 1, "start_px": [433, 499], "goal_px": [433, 100], "obstacles": []})";
  Pipe broken;
  broken.close_reader();
  const std::vector<std::function<void()>> ends{
      [] { redirect(STDOUT_FILENO, "/dev/full", O_WRONLY); }, [] { close(STDOUT_FILENO); },
      [&] { dup2(broken.writer(), STDOUT_FILENO); }};
  int run = 0;
  for (const auto& surroundings : ends) {
    const std::vector<std::vector<std::string>> commands{
        {"--version"},
        {"--help"},
        {"sim", "--help"},
        {"check", scenario.string()},
        {"check", "--json", scenario.string()},
        {"doctor", "--json"},
        {"segment", scratch.file("a.pgm").string(), "--range-m", "30", "--sector-deg", "120",
         "--json"},
        {"plan", "--frames", scratch.file("frames.jsonl", frames + "\n").string()},
        lockstep(scenario, scratch.file("run-" + std::to_string(++run)), {"--json", "--quiet"})};
    for (const auto& command : commands) {
      INFO(command.front() << " " << (command.size() > 1 ? command[1] : ""));
      Program told{program("lodesman"), command};
      const int well = told.status();
      if (command.back() == "--lockstep") {
        fs::remove_all(scratch.file("run-" + std::to_string(run)));
      }
      CHECK(well == 0);
      CHECK(Program{program("lodesman"), command, surroundings}.status() == 4);
    }
  }
}
