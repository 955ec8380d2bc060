// SPDX-License-Identifier: Apache-2.0
// A run's files made from its recording: the same as were written when it was sailed, and those of
// a boat that nobody tells the truth.
#include <fstream>
#include <nlohmann/json.hpp>

#include "mid_level/recording/recording.h"
#include "tests/support/catch.h"
#include "tests/support/rewritten_recording.h"
#include "tests/support/text_of.h"
#include "tests/system/program.h"

using namespace lodesman;
using namespace lodesman::testing;
using nlohmann::json;

namespace {

[[nodiscard]] json result_of(const fs::path& run) {
  return json::parse(std::ifstream{run / "result.json"});
}

// A recorded run of a shipped scenario, in lock-step.
[[nodiscard]] fs::path sailed(const Scratch& scratch, const std::string& scenario) {
  const fs::path out = scratch.file("run");
  Program run{
      program("lodesman"),
      {"sim", scenario, "--lockstep", "--record", "--quiet", "--no-images", "--out", out.string()}};
  CHECK(run.status() == 0);
  return out;
}

[[nodiscard]] int plot(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"plot", "--quiet", "--no-images"});
  Program program{program_directory() / "lodesman", arguments};
  return program.status();
}

// The recording as a boat on the water would have made it: no truth, and no scenario.
void write_without_world(const fs::path& from, const fs::path& to) {
  rewrite_recording(
      from, to, [](RewrittenMessage& message) { return message.topic != "raw/world_truth"; },
      "scenario.toml");
}

}  // namespace

TEST_CASE("plot: of a recorded run come the files that it wrote when it was sailed", "[system]") {
  const Scratch scratch{"plot"};
  const fs::path run = sailed(scratch, "paper-static");
  const fs::path again = scratch.file("again");
  REQUIRE(plot({(run / "mission.mcap").string(), "--out", again.string()}) == 0);
  CHECK(text_of(again / "trajectory.csv") == text_of(run / "trajectory.csv"));
  CHECK(text_of(again / "plans.jsonl") == text_of(run / "plans.jsonl"));
  json result = result_of(again);
  json sailed_result = result_of(run);
  for (json* each : {&result, &sailed_result}) {
    each->erase("real_time_factor");
    each->erase("recording_hash");
  }
  CHECK(result == sailed_result);
  // Where it is not told, beside the recording.
  REQUIRE(plot({(run / "mission.mcap").string()}) == 0);
  CHECK(fs::exists(run / "mission" / "result.json"));
}

TEST_CASE("plot: without truth a run is counted by the boat's own estimate, and says so",
          "[system]") {
  const Scratch scratch{"plot"};
  const fs::path run = sailed(scratch, "paper-static");
  const fs::path on_water = scratch.file("water.mcap");
  write_without_world(run / "mission.mcap", on_water);
  const fs::path out = scratch.file("water");
  REQUIRE(plot({on_water.string(), "--out", out.string()}) == 0);
  const json counted = result_of(out);
  const json sailed_result = result_of(run);
  CHECK(counted["counted_from"] == "estimate");
  CHECK(sailed_result["counted_from"] == "truth");
  CHECK(counted["outcome"] == "goal");
  CHECK(counted["min_hull_clearance_m"].is_null());
  for (const char* key : {"time_s", "path_length_m", "min_inoffensive_distance_m"}) {
    INFO(key);
    CHECK(counted[key].get<double>() == Approx(sailed_result[key].get<double>()).margin(0.3));
  }
}

TEST_CASE("plot: what is no recording, has no mission or has no such one is refused", "[system]") {
  const Scratch scratch{"plot"};
  std::ofstream{scratch.file("no.mcap")} << "not at all";
  CHECK(plot({scratch.file("no.mcap").string()}) == 2);
  CHECK(plot({scratch.file("missing.mcap").string()}) == 2);
  const fs::path run = sailed(scratch, "paper-static");
  CHECK(plot({(run / "mission.mcap").string(), "--mission", "2"}) == 2);
  CHECK_FALSE(fs::exists(run / "mission"));
  // What --force would write over is the recording too.
  CHECK(plot({(run / "mission.mcap").string(), "--out", run.string(), "--force"}) == 2);
  CHECK(fs::exists(run / "mission.mcap"));
}
