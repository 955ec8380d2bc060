// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/cli/plan_command.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <memory>
#include <vector>

#include "deploy/operator/bench/any_angle.h"
#include "deploy/operator/bench/file_check.h"
#include "deploy/operator/bench/plan_answers.h"
#include "deploy/operator/cli/common_options.h"
#include "deploy/operator/cli/number_options.h"
#include "mid_level/base/clock.h"
#include "mid_level/base/startup_error.h"

namespace lodesman::cli {
namespace {

struct PlanOptions {
  CommonOptions common;
  std::string frames;
  std::string map;
  std::string scen;
  std::string costs = "paper";
  int geometry = 4;
  int repeat = 1;
  bool any_angle = false;
};

// How many answers are worth a line each to a person.
constexpr std::size_t kTableRows = 20;

// "plan: 120/400" on standard error, once it has become worth waiting for.
class PlanProgress {
 public:
  PlanProgress(std::size_t all, bool quiet) : all_{all}, quiet_{quiet} {}
  ~PlanProgress() {
    if (line_open_) {
      std::fputc('\n', stderr);
    }
  }
  PlanProgress(const PlanProgress&) = delete;
  PlanProgress& operator=(const PlanProgress&) = delete;

  void show(std::size_t done) {
    const Time now = clock_.now();
    const Duration period = terminal_ ? std::chrono::milliseconds{100} : std::chrono::seconds{10};
    if (quiet_ || now - started_ < std::chrono::seconds{1} || now - last_ < period) {
      return;
    }
    last_ = now;
    const double left_s =
        to_seconds(now - started_) / static_cast<double>(done) * static_cast<double>(all_ - done);
    fmt::print(stderr, "{}plan: {}/{}  ~{:.0f} s left{}", terminal_ ? "\r" : "", done, all_, left_s,
               terminal_ ? "\x1b[K" : "\n");
    std::fflush(stderr);
    line_open_ = terminal_;
  }

 private:
  std::size_t all_;
  bool quiet_;
  bool terminal_ = isatty(STDERR_FILENO) == 1;
  bool line_open_ = false;
  SteadyClock clock_;
  Time started_ = clock_.now();
  Time last_ = started_;
};

// Answers every query, printing JSON lines as they come, or a table and a summary at the end.
template <class Query, class Answer>
void answer_all(const PlanOptions& options, const std::vector<Query>& queries, Answer answer) {
  std::vector<PlanAnswer> answers;
  {
    PlanProgress progress{queries.size(), options.common.quiet};
    for (std::size_t i = 0; i < queries.size(); ++i) {
      PlanAnswer one = answer(queries[i], i);
      if (options.common.json) {
        fmt::print("{}\n", one.to_json().dump(-1, ' ', false,
                                              nlohmann::ordered_json::error_handler_t::replace));
      }
      if (queries.size() > kTableRows) {
        one.path.clear();  // nothing below needs it, and there may be thousands
      }
      answers.push_back(std::move(one));
      progress.show(i + 1);
    }
  }
  if (options.common.quiet) {
    return;
  }
  if (!options.common.json && answers.size() <= kTableRows) {
    fmt::print("{}", table_of(answers));
  }
  fmt::print(options.common.json ? stderr : stdout, "{}", summary_of(answers));
}

[[nodiscard]] int plan(const PlanOptions& options) {
  if (options.geometry == 8 && (options.frames.empty() || options.costs != "paper")) {
    throw StartupError("--geometry: 8 goes with --frames, and has costs of its own");
  }
  if (options.frames.empty() == options.map.empty()) {
    throw StartupError("plan: give either --frames, or --map and --scen");
  }
  refuse_bad_configuration(options.common);
  const MapCosts costs = options.costs == "paper" ? MapCosts::kPaper : MapCosts::kSqrt2;
  if (!options.frames.empty()) {
    const std::vector<FrameQuery> frames = read_frames(options.frames);
    FramePlanner planner{costs, options.geometry == 8 ? Geometry::k8 : Geometry::k4};
    AnyAnglePlanner any_angle;
    answer_all(options, frames, [&](const FrameQuery& frame, std::size_t /*number*/) {
      PlanAnswer answer = planner.answer(frame, options.repeat);
      if (options.any_angle) {
        answer.any_angle = any_angle.answer(frame, options.repeat).to_json();
      }
      return answer;
    });
    return kExitDone;
  }
  const MovingAiMap map = read_map(options.map);
  const std::vector<MovingAiQuery> queries = read_scen(options.scen, map);
  MapPlanner planner{map, costs};
  answer_all(options, queries, [&](const MovingAiQuery& query, std::size_t number) {
    return planner.answer(query, number, options.repeat);
  });
  return kExitDone;
}

void add_options(CLI::App& command, PlanOptions& options) {
  CLI::Option* frames =
      command
          .add_option("--frames", options.frames,
                      "Queries in the sonar view: a JSON object a line, obstacles as ellipses in "
                      "pixels")
          ->type_name("F.jsonl");
  CLI::Option* map = command.add_option("--map", options.map, "A MovingAI map")->type_name("F.map");
  CLI::Option* scen =
      command.add_option("--scen", options.scen, "The queries on it")->type_name("F.scen");
  map->needs(scen)->excludes(frames);
  scen->needs(map)->excludes(frames);
  command
      .add_option("--geometry", options.geometry,
                  "4: 8 neighbours at 45 degrees, the paper's; 8: also knight's steps of 2.2, "
                  "16 directions")
      ->check(CLI::IsMember({4, 8}))
      ->capture_default_str();
  command
      .add_option("--costs", options.costs,
                  "Of a straight and a diagonal step; paper: 1 and 1.4; sqrt2: 1 and 1.414... "
                  "cost_10_14 is that of the path found, whichever was asked for")
      ->check(CLI::IsMember({"paper", "sqrt2"}))
      ->capture_default_str();
  command
      .add_option("--repeat", options.repeat, "Answer each query so often and give median times")
      ->check(number_from(1, 10000))
      ->type_name("N")
      ->capture_default_str();
  command
      .add_flag("--any-angle", options.any_angle,
                "Also the shortest path of any direction, from the shapes; in the JSON lines")
      ->needs(frames);
  add_common_options(command, options.common);
}

}  // namespace

void add_plan_command(CLI::App& root, int& exit_status) {
  const auto options = std::make_shared<PlanOptions>();
  CLI::App* command =
      root.add_subcommand("plan", "Find paths on obstacle lists or maps, without a boat");
  add_options(*command, *options);
  command->footer(
      "Example:\n  lodesman plan --frames frames.jsonl --json\n"
      "  lodesman plan --map arena.map --scen arena.map.scen --costs sqrt2\n");
  command->callback([options, &exit_status] { exit_status = plan(*options); });
}

}  // namespace lodesman::cli
