// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/cli/replay_command.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "deploy/boat/exit_status.h"
#include "deploy/boat/stop_signals.h"
#include "deploy/boat/version.h"
#include "deploy/operator/cli/common_options.h"
#include "deploy/operator/cli/number_options.h"
#include "deploy/operator/replay/replay.h"
#include "mid_level/base/startup_error.h"

namespace lodesman::cli {
namespace {
namespace fs = std::filesystem;
using nlohmann::ordered_json;

struct ReplayCommandOptions {
  std::vector<fs::path> files;
  std::vector<std::string> sets;
  std::size_t told = 10;  // differences a task
  bool json = false;
  bool quiet = false;
};

[[nodiscard]] const char* name_of(DifferenceKind kind) noexcept {
  switch (kind) {
    case DifferenceKind::kField: return "field";
    case DifferenceKind::kNotPublished: return "not_published";
    case DifferenceKind::kPublished: return "published";
  }
  return "";
}

[[nodiscard]] double seconds_of(Time time) noexcept { return to_seconds(time.time_since_epoch()); }

[[nodiscard]] std::string words_for(const Difference& difference) {
  std::string where = fmt::format("{:.6f} s: {}: {}", seconds_of(difference.stamp),
                                  to_string(difference.task), difference.channel);
  switch (difference.kind) {
    case DifferenceKind::kField:
      return fmt::format("{} {}: {}: recorded {}, replayed {}", where, difference.sequence,
                         difference.field.path, difference.field.recorded,
                         difference.field.replayed);
    case DifferenceKind::kNotPublished:
      return fmt::format("{} {}: recorded, and not published again", where, difference.sequence);
    case DifferenceKind::kPublished: return where + ": published, and not recorded";
  }
  return where;
}

[[nodiscard]] ordered_json json_of(const Difference& difference) {
  ordered_json json{{"time_s", seconds_of(difference.stamp)},
                    {"task", to_string(difference.task)},
                    {"channel", difference.channel},
                    {"sequence", difference.sequence},
                    {"kind", name_of(difference.kind)}};
  if (difference.kind == DifferenceKind::kField) {
    json["field"] = difference.field.path;
    json["recorded"] = difference.field.recorded;
    json["replayed"] = difference.field.replayed;
  }
  return json;
}

[[nodiscard]] ordered_json json_of(const TaskVerdict& task, std::size_t told) {
  ordered_json json{{"task", to_string(task.task)},
                    {"steps", task.steps},
                    {"judged", task.judged},
                    {"differing", task.differing}};
  json["judged_from_s"] =
      task.judged_from ? ordered_json(seconds_of(*task.judged_from)) : ordered_json(nullptr);
  json["not_judged"] = ordered_json::object();
  for (std::size_t i = 0; i < kDoubtCount; ++i) {
    if (task.not_judged[i] > 0) {
      json["not_judged"][to_string(static_cast<Doubt>(i))] = task.not_judged[i];
    }
  }
  json["differences"] = ordered_json::array();
  for (std::size_t i = 0; i < std::min(told, task.differences.size()); ++i) {
    json["differences"].push_back(json_of(task.differences[i]));
  }
  return json;
}

[[nodiscard]] std::string recorded_version(const ReplayResult& result) {
  const auto version = result.about.find("version");
  return version == result.about.end() ? "" : version->second;
}

void print_json(const ReplayResult& result, std::size_t told) {
  ordered_json json{{"version", kVersion},
                    {"recorded_by", recorded_version(result)},
                    {"judged", result.judged()},
                    {"differing", result.differing()},
                    {"not_judged", result.not_judged()}};
  json["first"] = result.first() != nullptr ? json_of(*result.first()) : ordered_json(nullptr);
  json["span_s"] = to_seconds(result.span);
  json["times_real_time"] = result.took_s > 0.0 ? to_seconds(result.span) / result.took_s : 0.0;
  json["lacks"] = result.lacks;
  json["tasks"] = ordered_json::array();
  for (const TaskVerdict& task : result.tasks) {
    json["tasks"].push_back(json_of(task, told));
  }
  fmt::print("{}\n", json.dump(2, ' ', false, ordered_json::error_handler_t::replace));
}

void print_task(const TaskVerdict& task, std::size_t told) {
  for (std::size_t i = 0; i < std::min(told, task.differences.size()); ++i) {
    fmt::print("{}\n", words_for(task.differences[i]));
  }
  if (task.differing > told) {
    fmt::print("... and {} more of {}\n", task.differing - told, to_string(task.task));
  }
}

void print_summary(const ReplayResult& result, std::size_t told) {
  for (const TaskVerdict& task : result.tasks) {
    print_task(task, told);
  }
  fmt::print("{:<12} {:>9} {:>9} {:>9} {:>11}\n", "task", "steps", "judged", "differing",
             "not judged");
  for (const TaskVerdict& task : result.tasks) {
    fmt::print("{:<12} {:>9} {:>9} {:>9} {:>11}\n", to_string(task.task), task.steps, task.judged,
               task.differing, task.not_judged_in_all());
  }
  if (const Difference* first = result.first(); first != nullptr) {
    fmt::print("first: {}\n", words_for(*first));
  }
  fmt::print("{} of {} decisions differ; {:.1f} s in {:.1f} s: {:.0f} times real time\n",
             result.differing(), result.judged(), to_seconds(result.span), result.took_s,
             result.took_s > 0.0 ? to_seconds(result.span) / result.took_s : 0.0);
}

// What is not judged is said whatever is asked for: silence would look like agreement.
void tell_what_is_not_judged(const ReplayResult& result) {
  for (const std::string& lack : result.lacks) {
    fmt::print(stderr, "not whole: {}\n", lack);
  }
  for (const TaskVerdict& task : result.tasks) {
    for (std::size_t i = 0; i < kDoubtCount; ++i) {
      if (task.not_judged[i] > 0) {
        fmt::print(stderr, "not judged: {} of {}: {}\n", task.not_judged[i], to_string(task.task),
                   to_string(static_cast<Doubt>(i)));
      }
    }
    if (task.judged > 0 && task.judged_from && task.not_judged_in_all() > task.judged) {
      fmt::print(stderr, "{} counts from {:.3f} s\n", to_string(task.task),
                 seconds_of(*task.judged_from));
    }
  }
  if (const std::string version = recorded_version(result); version != kVersion) {
    fmt::print(stderr, "recorded by version {}, replayed by {}\n", version, kVersion);
  }
}

// Decisions that differ are what a changed parameter is asked for.
[[nodiscard]] int exit_status_of(const ReplayResult& result, bool asks_what_if) noexcept {
  if (stop_caught()) {
    return kExitFault;
  }
  return result.differing() > 0 && !asks_what_if ? kExitNoGoal : kExitDone;
}

[[nodiscard]] int run_replay(const ReplayCommandOptions& options) {
  catch_stop_signals();
  const bool shows = !options.quiet && !options.json && isatty(STDERR_FILENO) != 0;
  const ReplayResult result =
      replay({options.files, options.sets, stop_caught, [shows](Duration done) {
                if (shows) {
                  fmt::print(stderr, "\r{:.0f} s of the boat's time", to_seconds(done));
                }
              }});
  if (shows) {
    fmt::print(stderr, "\n");
  }
  tell_what_is_not_judged(result);
  if (result.judged() == 0 && !stop_caught()) {
    throw StartupError(options.files.front().string() +
                       ": there is no decision in it that can be judged");
  }
  if (options.json) {
    print_json(result, options.told);
  } else if (!options.quiet) {
    print_summary(result, options.told);
  }
  return exit_status_of(result, !options.sets.empty());
}

}  // namespace

void add_replay_command(CLI::App& root, int& exit_status) {
  const auto options = std::make_shared<ReplayCommandOptions>();
  CLI::App* command = root.add_subcommand("replay", kReplayDescription);
  command->add_option("LOG", options->files, "The recording; several files: its parts, in order")
      ->required();
  command
      ->add_option("--set", options->sets,
                   "What if: a value in the place of the recorded one (repeatable)")
      ->type_name("SECTION.KEY=VALUE")
      ->allow_extra_args(false);
  command->add_option("--show", options->told, "So many differences of each task [10]")
      ->type_name("N")
      ->check(number_from(0.0, static_cast<double>(TaskVerdict::kMostTold)));
  command->add_flag("--json", options->json, "Print one JSON document on standard output");
  command->add_flag("--quiet", options->quiet, "No progress and no summary");
  command->footer(
      "Perception, estimation, planning, guidance and control are stepped again as they were, each "
      "by the inputs that it had. 1: decisions differ, without --set.\n"
      "Example: lodesman replay recordings/20260801T120000Z-boat.mcap");
  command->callback([options, &exit_status] { exit_status = run_replay(*options); });
}

}  // namespace lodesman::cli
