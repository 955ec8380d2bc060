// SPDX-License-Identifier: Apache-2.0
// Decisions made again from recordings of programs with threads of their own.
#include <nlohmann/json.hpp>

#include "deploy/operator/replay/replay.h"
#include "tests/support/catch.h"
#include "tests/system/program.h"

using namespace lodesman;
using namespace lodesman::testing;

namespace {

// What is doubted because a busy machine kept a step or the recorder waiting: a task then has to
// agree for ten seconds before it is judged again.
std::uint64_t doubted_for_load(const cli::TaskVerdict& task) {
  std::uint64_t sum = 0;
  for (const cli::Doubt doubt : {cli::Doubt::kGap, cli::Doubt::kTorn, cli::Doubt::kLost}) {
    sum += task.not_judged[static_cast<std::size_t>(doubt)];
  }
  return sum;
}

void check_run(const std::string& word, const std::string& profile) {
  INFO(word << ", " << profile);
  const Scratch scratch{"replay"};
  const auto scenario = scratch.file("scenario.toml", scenario_text(80.0));
  const fs::path out = scratch.file("run");
  auto arguments = sim(scenario, out,
                       {"--record", "--quiet", "--profile", profile, "--time-limit", "15", "--set",
                        "recorder.free_floor_mib=0"});
  arguments.front() = word;
  Program run{program("lodesman"), arguments};
  CHECK(run.status() == 1);  // the time limit
  const cli::ReplayResult result =
      cli::replay({{out / "mission.mcap"}, {}, [] { return false; }, {}});
  const cli::Difference* first = result.first();
  INFO((first == nullptr
            ? std::string{"none differs"}
            : first->channel + " " + std::to_string(first->sequence) + " " + first->field.path +
                  ": " + first->field.recorded + ", " + first->field.replayed));
  CHECK(result.differing() == 0);
  for (const cli::TaskVerdict& task : result.tasks) {
    INFO(to_string(task.task));
    const std::uint64_t for_load = doubted_for_load(task);
    CHECK(task.judged + for_load > 5);
    // A word that ends a program is of no step.
    CHECK((task.not_judged_in_all() - for_load) * 20 <= task.judged + for_load);
  }
  CHECK(result.judged() > 100);
}

}  // namespace

TEST_CASE("replay: of runs in real time, in both profiles, no decision differs", "[system]") {
  for (const char* profile : {"default", "paper"}) {
    check_run("sim", profile);
  }
}

TEST_CASE("replay: of runs on emulated devices, in both profiles, no decision differs",
          "[system]") {
  for (const char* profile : {"default", "paper"}) {
    check_run("hil", profile);
  }
}

TEST_CASE("replay: the command says what differs, and by its exit status whether anything does",
          "[system]") {
  const Scratch scratch{"replay"};
  const fs::path out = scratch.file("run");
  Program run{program("lodesman"),
              {"sim", "paper-static", "--lockstep", "--record", "--quiet", "--no-images",
               "--time-limit", "20", "--out", out.string()}};
  CHECK(run.status() == 1);
  const std::string file = (out / "mission.mcap").string();
  const auto status = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"replay", "--quiet"});
    return Program{program("lodesman"), arguments}.status();
  };
  CHECK(status({file}) == 0);
  CHECK(status({file, "--json"}) == 0);
  CHECK(status({file, "--set", "control.heading_gain_per_deg=7.0"}) == 0);
  CHECK(status({file, "--set", "control.nothing=7.0"}) == 2);
  CHECK(status({scratch.file("missing.mcap").string()}) == 2);
}
