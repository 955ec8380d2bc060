// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/report/run_files.h"

#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "deploy/operator/report/numbers.h"
#include "mid_level/base/startup_error.h"
#include "tests/support/catch.h"
#include "tests/unit/report/sample_runs.h"
#include "tests/unit/report/temporary_directory.h"

using namespace lodesman;
using Json = nlohmann::ordered_json;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<std::string> lines_of(const std::filesystem::path& path) {
  std::ifstream file{path};
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) {
    lines.push_back(line);
  }
  return lines;
}

std::vector<std::string> keys_of(const Json& json) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : json.items()) {
    keys.push_back(key);
  }
  return keys;
}

std::vector<std::string> names_in(const std::filesystem::path& directory) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator{directory}) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

// For this process, as long as it stands.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;
  ~FileSizeLimit() { setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_{};
};

const std::vector<std::string> kResultKeys{"scenario",
                                           "profile",
                                           "mode",
                                           "seed",
                                           "outcome",
                                           "reached",
                                           "collided",
                                           "time_s",
                                           "final_m",
                                           "goal_error_m",
                                           "estimate_error_m",
                                           "path_length_m",
                                           "mean_speed_m_s",
                                           "min_inoffensive_distance_m",
                                           "time_of_min_inoffensive_distance_s",
                                           "min_hull_clearance_m",
                                           "plans",
                                           "plans_found",
                                           "plans_not_found",
                                           "plan_reasons",
                                           "rungs",
                                           "side_flips",
                                           "heading_travel_deg",
                                           "plan_time_us",
                                           "ping_to_command_us",
                                           "overruns",
                                           "stale_events",
                                           "notices",
                                           "guard_trips",
                                           "real_time_factor",
                                           "recording_hash",
                                           "origin_deg",
                                           "version",
                                           "counted_from"};

}  // namespace

TEST_CASE("numbers: fixed decimals without a negative zero or a special word", "[report]") {
  CHECK(cli::fixed(1.23456, 3) == "1.235");
  CHECK(cli::fixed(-0.0001, 3) == "0.000");
  CHECK(cli::fixed(-0.4, 0) == "0");
  CHECK(cli::fixed(-12.0, 1) == "-12.0");
  CHECK(cli::fixed(kInfinity, 3).empty());
  CHECK(cli::fixed(std::numeric_limits<double>::quiet_NaN(), 3).empty());
  CHECK(cli::fixed(std::numeric_limits<double>::max(), 6).size() == 316);
  CHECK(Json(cli::rounded(0.1 + 0.2, 6)).dump() == "0.3");
  CHECK(Json(cli::rounded(-1e-9, 6)).dump() == "0.0");
  CHECK(cli::rounded(1e300, 6) == Approx(1e300));
}

TEST_CASE("result.json: exactly the contract's keys in its order", "[report]") {
  const Json json = Json::parse(cli::result_json({}));
  CHECK(keys_of(json) == kResultKeys);
  const std::vector<std::string> percentiles{"p50", "p99", "max"};
  CHECK(keys_of(json["plan_time_us"]) == percentiles);
  CHECK(keys_of(json["ping_to_command_us"]) == percentiles);
  CHECK(json["plan_reasons"].is_object());
  CHECK(json["rungs"].is_object());
}

TEST_CASE("result.json: how well lines were kept to is told where one was", "[report]") {
  cli::CrossTrackMeter meter;
  MissionStatus status;
  status.goal_y_m = 40.0;
  WorldTruth truth;
  truth.x_m = 2.0;
  meter.add(status, truth);
  CHECK_FALSE(meter.seen());
  status.keeps_line = true;
  meter.add(status, truth);
  truth = {};
  truth.x_m = -0.5;
  truth.y_m = 20.0;
  meter.add(status, truth);
  cli::RunResult result;
  result.cross_track = meter.seen();
  const Json json = Json::parse(cli::result_json(result))["cross_track"];
  CHECK(json["worst_m"] == Approx(2.0));
  CHECK(json["rms_m"] == Approx(std::sqrt(4.25 / 2)).margin(1e-3));
  CHECK(json["settled_worst_m"] == Approx(0.5));
  CHECK(json["settled_rms_m"] == Approx(0.5));
}

TEST_CASE("result.json: a fault is told at the end, and only then", "[report]") {
  cli::RunResult result;
  result.outcome = "fault";
  result.fault = "ahrs: stalled";
  const Json json = Json::parse(cli::result_json(result));
  CHECK(keys_of(json).back() == "fault");
  CHECK(json["fault"] == "ahrs: stalled");
}

TEST_CASE("result.json: what there is not is null, and no number is infinite", "[report]") {
  cli::RunResult result;
  result.mean_speed_m_s = std::numeric_limits<double>::quiet_NaN();
  result.goal_error_m = kInfinity;
  const std::string text = cli::result_json(result);
  const Json json = Json::parse(text);
  for (const char* key :
       {"min_inoffensive_distance_m", "time_of_min_inoffensive_distance_s", "min_hull_clearance_m",
        "recording_hash", "mean_speed_m_s", "goal_error_m", "origin_deg"}) {
    INFO(key);
    CHECK(json[key].is_null());
  }
  CHECK(text.find("nan") == std::string::npos);
  CHECK(text.find("inf") == std::string::npos);
}

TEST_CASE("result.json: values arrive, and foreign bytes do not break the document", "[report]") {
  cli::RunResult result;
  result.scenario = "bad \xff byte";
  result.final_m = {-0.25, 19.68};
  result.min_inoffensive_distance_m = -0.1;
  result.plan_reasons = {{"no_path", 2}, {"found", 55}};
  result.rung_s = {{"aside", 2.5}, {"on_route", 30.0}};
  result.plan_time_us = {.p50 = 1.5, .p99 = 2.5, .max = 3.5};
  result.recording_hash = "0123456789abcdef";
  result.origin_deg = {48.123456789, -7.5};
  const Json json = Json::parse(cli::result_json(result));
  CHECK(json["final_m"] == Json::array({-0.25, 19.68}));
  CHECK(json["min_inoffensive_distance_m"] == -0.1);
  CHECK(json["plan_reasons"]["found"] == 55);
  CHECK(json["rungs"] == Json({{"aside", 2.5}, {"on_route", 30.0}}));
  CHECK(json["plan_time_us"]["p99"] == 2.5);
  CHECK(json["recording_hash"] == "0123456789abcdef");
  CHECK(json["origin_deg"] == Json::array({48.123456789, -7.5}));
}

TEST_CASE("trajectory.csv: the contract's header, fixed decimals, no infinity", "[report]") {
  const testing::TemporaryDirectory directory;
  cli::TrajectoryRow row;
  row.t_s = 0.1;
  row.y_m = 1.25;
  row.heading_deg = 359.9;
  row.estimate_x_m = -0.5;
  row.surge_m_s = 0.22;
  row.surge_ref = 16;
  row.head_ref = -3;
  row.plan_id = 7;
  cli::TrajectoryRow near = row;
  near.id_m = 2.44;
  near.path_found = true;
  {
    cli::RunFiles files{directory.path()};
    files.add(row);
    files.add(near);
  }
  const auto lines = lines_of(directory.path() / "trajectory.csv");
  REQUIRE(lines.size() == 3);
  CHECK(lines[0] ==
        "t_s,x_m,y_m,heading_deg,estimate_x_m,estimate_y_m,surge_m_s,surge_ref,head_ref,"
        "thrust_left,thrust_right,id_m,plan_id,path_found,waypoint_x_m,waypoint_y_m");
  CHECK(lines[1] ==
        "0.100,0.0000,1.2500,359.900,-0.5000,0.0000,0.2200,16,-3,128,128,,7,0,0.0000,0.0000");
  CHECK(lines[2] ==
        "0.100,0.0000,1.2500,359.900,-0.5000,0.0000,0.2200,16,-3,128,128,2.4400,7,1,0.0000,"
        "0.0000");
}

TEST_CASE("plans.jsonl: a line a plan, null cost where no path was found", "[report]") {
  const testing::TemporaryDirectory directory;
  const cli::RunRecord run = testing::static_run();
  {
    cli::RunFiles files{directory.path()};
    for (const cli::PlanRecord& plan : run.plans) {
      files.add(plan);
    }
  }
  const auto lines = lines_of(directory.path() / "plans.jsonl");
  REQUIRE(lines.size() == run.plans.size());
  bool has_found = false;
  bool has_none = false;
  for (const std::string& line : lines) {
    const Json json = Json::parse(line);
    const bool found = json["found"];
    (found ? has_found : has_none) = true;
    CHECK(json["cost_10_14"].is_null() == !found);
    CHECK(json["path_m"].empty() == !found);
    CHECK((json["reason"] == "found") == found);
  }
  CHECK(has_found);
  CHECK(has_none);
  CHECK(keys_of(Json::parse(lines.front())) == std::vector<std::string>{"id",
                                                                        "t_s",
                                                                        "captured_s",
                                                                        "start_m",
                                                                        "start_heading_deg",
                                                                        "goal_m",
                                                                        "found",
                                                                        "reason",
                                                                        "cost_10_14",
                                                                        "path_m",
                                                                        "waypoint_source",
                                                                        "rung",
                                                                        "changed",
                                                                        "speed_share",
                                                                        "course_deg",
                                                                        "obstacle",
                                                                        "clearance_m",
                                                                        "clearance_after_s",
                                                                        "seen_ahead_m",
                                                                        "plan_age_s",
                                                                        "waypoints_m",
                                                                        "expansions",
                                                                        "plan_time_us"});
}

TEST_CASE("run files: an empty run leaves three whole files", "[report]") {
  const testing::TemporaryDirectory directory;
  cli::RunFiles files{directory.path()};
  files.finish({});
  CHECK(files.fault().empty());
  CHECK(lines_of(directory.path() / "trajectory.csv").size() == 1);
  CHECK(lines_of(directory.path() / "plans.jsonl").empty());
  std::ifstream file{directory.path() / "result.json"};
  CHECK(Json::parse(file).is_object());
  CHECK(names_in(directory.path()) ==
        std::vector<std::string>{"plans.jsonl", "result.json", "trajectory.csv"});
}

TEST_CASE("run files: lines stand in their files while the run goes on", "[report]") {
  const testing::TemporaryDirectory directory;
  cli::RunFiles files{directory.path()};
  // More than is kept back.
  for (int i = 0; i < 2000; ++i) {
    files.add(cli::TrajectoryRow{});
    files.add(cli::PlanRecord{});
  }
  CHECK(lines_of(directory.path() / "trajectory.csv").size() > 500);
  CHECK(lines_of(directory.path() / "plans.jsonl").size() > 1500);
  CHECK_FALSE(std::filesystem::exists(directory.path() / "result.json"));
}

TEST_CASE("run files: a file that cannot be made is named in one line", "[report]") {
  const testing::TemporaryDirectory directory;
  const auto missing = directory.path() / "missing";
  CHECK_THROWS_WITH(cli::RunFiles{missing}, (missing / "trajectory.csv").string() +
                                                ": cannot be written: No such file or directory");
}

TEST_CASE("run files: on a full device the result still stands and the first loss is named",
          "[report]") {
  const testing::TemporaryDirectory directory;
  std::filesystem::create_symlink("/dev/full", directory.path() / "trajectory.csv");
  cli::RunFiles files{directory.path()};
  files.add(cli::PlanRecord{});
  files.finish({});
  CHECK(files.fault() == (directory.path() / "trajectory.csv").string() +
                             ": cannot be written: No space left on device");
  CHECK(lines_of(directory.path() / "plans.jsonl").size() == 1);
  std::ifstream file{directory.path() / "result.json"};
  CHECK(Json::parse(file).is_object());
}

TEST_CASE("whole file: what cannot be written leaves what was there", "[report]") {
  const testing::TemporaryDirectory directory;
  const auto path = directory.path() / "a";
  cli::write_whole_file(path, "old");
  {
    const FileSizeLimit limit{4};
    CHECK_THROWS_WITH(cli::write_whole_file(path, "newer than that"),
                      path.string() + ": cannot be written: File too large");
  }
  CHECK(lines_of(path) == std::vector<std::string>{"old"});
  cli::write_whole_file(path, "new");
  CHECK(lines_of(path) == std::vector<std::string>{"new"});
  CHECK(names_in(directory.path()) == std::vector<std::string>{"a"});
}

TEST_CASE("reserved file: its room is there when all other room is gone", "[report]") {
  const testing::TemporaryDirectory directory;
  const auto path = directory.path() / "a";
  cli::ReservedFile reserved{path, 4096};
  CHECK(std::filesystem::file_size(cli::unfinished(path)) == 4096);
  CHECK_FALSE(std::filesystem::exists(path));
  reserved.write("text\n");
  CHECK(lines_of(path) == std::vector<std::string>{"text"});
  CHECK(std::filesystem::file_size(path) == 5);
}

TEST_CASE("line file: it ends after a whole line where the disk is full", "[report]") {
  const testing::TemporaryDirectory directory;
  const auto path = directory.path() / "a";
  const FileSizeLimit limit{50};
  cli::LineFile file{path};
  for (int i = 0; i < 10; ++i) {
    file.add("twelve signs\n");
  }
  file.flush();
  CHECK(file.fault() == path.string() + ": cannot be written: File too large");
  CHECK(std::filesystem::file_size(path) == 39);
  file.add("no more of it\n");
  file.flush();
  CHECK(std::filesystem::file_size(path) == 39);
}
