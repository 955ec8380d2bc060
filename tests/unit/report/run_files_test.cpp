// SPDX-License-Identifier: Apache-2.0
#include "deploy/cli/report/run_files.h"

#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "deploy/cli/report/numbers.h"
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
                                           "side_flips",
                                           "heading_travel_deg",
                                           "plan_time_us",
                                           "ping_to_command_us",
                                           "overruns",
                                           "stale_events",
                                           "real_time_factor",
                                           "recording_hash",
                                           "version"};

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
        "recording_hash", "mean_speed_m_s", "goal_error_m"}) {
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
  result.plan_time_us = {.p50 = 1.5, .p99 = 2.5, .max = 3.5};
  result.recording_hash = "0123456789abcdef";
  const Json json = Json::parse(cli::result_json(result));
  CHECK(json["final_m"] == Json::array({-0.25, 19.68}));
  CHECK(json["min_inoffensive_distance_m"] == -0.1);
  CHECK(json["plan_reasons"]["found"] == 55);
  CHECK(json["plan_time_us"]["p99"] == 2.5);
  CHECK(json["recording_hash"] == "0123456789abcdef");
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
  cli::write_trajectory(directory.path(), {row, near});
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
  cli::write_plans(directory.path(), run.plans);
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
                                                                        "plan_age_s",
                                                                        "waypoints_m",
                                                                        "expansions",
                                                                        "plan_time_us"});
}

TEST_CASE("run files: an empty run leaves three whole files", "[report]") {
  const testing::TemporaryDirectory directory;
  cli::write_run_files(directory.path(), {});
  CHECK(lines_of(directory.path() / "trajectory.csv").size() == 1);
  CHECK(lines_of(directory.path() / "plans.jsonl").empty());
  std::ifstream file{directory.path() / "result.json"};
  CHECK(Json::parse(file).is_object());
}

TEST_CASE("run files: a file that cannot be written is named in one line", "[report]") {
  const testing::TemporaryDirectory directory;
  const auto missing = directory.path() / "missing";
  const auto message_of = [](const auto& write) -> std::string {
    try {
      write();
    } catch (const StartupError& error) {
      return error.what();
    }
    return {};
  };
  CHECK(message_of([&] { cli::write_result(missing, {}); }) ==
        (missing / "result.json").string() + ": cannot be written: No such file or directory");

  // A device that is always full.
  std::filesystem::create_symlink("/dev/full", directory.path() / "trajectory.csv");
  std::filesystem::create_symlink("/dev/full", directory.path() / "plans.jsonl");
  const std::vector<cli::TrajectoryRow> many(2000);
  for (const auto& rows : {many, std::vector<cli::TrajectoryRow>{}}) {
    CHECK(message_of([&] { cli::write_trajectory(directory.path(), rows); }) ==
          (directory.path() / "trajectory.csv").string() +
              ": cannot be written: No space left on device");
  }
  CHECK(message_of([&] { cli::write_plans(directory.path(), {cli::PlanRecord{}}); }) ==
        (directory.path() / "plans.jsonl").string() +
            ": cannot be written: No space left on device");
}
