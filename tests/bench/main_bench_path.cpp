// SPDX-License-Identifier: Apache-2.0
// Measures the path finder beside others, in one run and on frames that were never seen before;
// docs/performance.md says how to read it. One thread.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "tests/bench/frames_file.h"
#include "tests/bench/measure.h"
#include "tests/bench/pictures.h"
#include "tests/bench/report.h"

namespace lodesman::bench {
namespace {

using testing::FrameKind;

struct Options {
  // A fresh one each run; it is said, and can be given.
  std::uint32_t seed = static_cast<std::uint32_t>(
      std::chrono::system_clock::now().time_since_epoch().count() / 1000);
  int frames = 25;
  int repetitions = 5;
  std::string json;
  std::string markdown;
  std::string file;
  std::string pictures;
  bool brief = false;
  double gate = 0.0;
};

FanShape fan_of(int factor) {
  return {kViewColumns * factor, kViewRows * factor, kApexColumn * factor, kViewRows * factor - 1,
          kFanRadiusPx * factor};
}

std::vector<Growth> grow_grid(const Options& options) {
  std::vector<Growth> growth;
  for (const int factor : {1, 2, 4}) {
    Workload workload;
    workload.seed = options.seed;
    workload.fan = fan_of(factor);
    workload.kinds = {FrameKind::kMulti, FrameKind::kClutter, FrameKind::kTrap};
    workload.frames = options.frames;
    workload.repetitions = options.repetitions;
    workload.with_others = false;
    growth.push_back({"grid x " + std::to_string(factor * factor),
                      static_cast<double>(factor * factor), measure(workload)});
  }
  return growth;
}

std::vector<Growth> grow_obstacles(const Options& options) {
  std::vector<Growth> growth;
  for (const int times : {1, 10, 100}) {
    Workload workload;
    workload.seed = options.seed;
    workload.times = times;
    workload.kinds = {FrameKind::kClutter};
    workload.frames = options.frames;
    workload.repetitions = options.repetitions;
    workload.with_others = false;
    growth.push_back({"about " + std::to_string(10 * times) + " obstacles",
                      static_cast<double>(times), measure(workload)});
  }
  return growth;
}

// Between this program's two marks in a Markdown file.
void replace_tables(const std::string& path, const std::string& tables) {
  const std::string begin = "<!-- " LODESMAN_PROGRAM " begins -->\n";
  const std::string end = "<!-- " LODESMAN_PROGRAM " ends -->";
  std::ifstream in{path};
  std::string text{std::istreambuf_iterator<char>{in}, {}};
  const std::size_t from = text.find(begin);
  const std::size_t to = text.find(end);
  if (from == std::string::npos || to == std::string::npos) {
    throw std::runtime_error(path + ": holds no marks for the tables");
  }
  text.replace(from + begin.size(), to - from - begin.size(), tables);
  std::ofstream{path} << text;
}

// The main table's frames: random ones, or those of a file.
std::vector<FrameTimes> measure_frames(const Options& options) {
  Workload workload;
  workload.seed = options.seed;
  workload.frames = options.frames;
  workload.repetitions = options.repetitions;
  return options.file.empty() ? measure(workload) : measure(workload, read_frames(options.file));
}

std::string heading_of(const Options& options, std::size_t frames) {
  const std::string from =
      options.file.empty() ? "Seed " + std::to_string(options.seed) : options.file;
  return from + ", " + std::to_string(frames) + " frames.\n\n";
}

// Whether the step is faster than the reference A* by the factor asked for. The table says why not.
bool passes(const Options& options) {
  const std::vector<FrameTimes> frames = measure_frames(options);
  const double factor = reference_per_step(frames, 0.5);
  std::printf("%s%s\n%.0f times as fast as the reference A* at the median; asked for: %.0f\n",
              heading_of(options, frames.size()).c_str(), table_of(frames).c_str(), factor,
              options.gate);
  return factor >= options.gate;
}

void run(const Options& options) {
  const std::vector<FrameTimes> frames = measure_frames(options);
  nlohmann::ordered_json json{{"seed", options.seed}, {"planners", to_json(frames)}};
  std::string tables = heading_of(options, frames.size());
  if (options.brief) {
    tables += summary_of(frames);
  } else {
    const std::vector<Growth> grid = grow_grid(options);
    const std::vector<Growth> obstacles = grow_obstacles(options);
    json["grid"] = to_json(grid);
    json["obstacles"] = to_json(obstacles);
    tables += table_of(frames) + "\n" + table_of(grid) + "\n" + table_of(obstacles);
  }
  std::fputs(tables.c_str(), stdout);
  if (!options.markdown.empty()) {
    replace_tables(options.markdown, tables);
  }
  if (!options.json.empty()) {
    std::ofstream{options.json} << json.dump(2) << '\n';
  }
}

}  // namespace
}  // namespace lodesman::bench

int main(int argc, char** argv) {
  lodesman::bench::Options options;
  CLI::App app{"Measures the path finder against others on random frames"};
  app.add_option("--seed", options.seed, "Of the frames [a fresh one each run]");
  app.add_option("--frames", options.frames, "Of each of the eight kinds")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  app.add_option("--repetitions", options.repetitions, "Of each planner on each frame")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  app.add_option("--json", options.json, "Write what was measured to this file");
  app.add_option("--markdown", options.markdown, "Replace this program's tables in this file");
  app.add_flag("--brief", options.brief, "Only the main table's lines over all frames");
  app.add_option("--file", options.file, "Frames for the main table instead of random ones");
  app.add_option("--pictures", options.pictures,
                 "Only draw what is looked at on one random frame, into this folder");
  app.add_option("--gate", options.gate,
                 "Only the main table; fails unless the step is so many times as fast as the "
                 "reference A* at the median");
  CLI11_PARSE(app, argc, argv);
  try {
    std::fprintf(stderr, LODESMAN_PROGRAM ": seed %u\n", options.seed);
    if (!options.pictures.empty()) {
      lodesman::testing::FrameMaker frames{options.seed};
      lodesman::bench::draw_pictures(frames.make(lodesman::testing::FrameKind::kMulti),
                                     options.pictures);
      return 0;
    }
    if (options.gate > 0.0) {
      return lodesman::bench::passes(options) ? 0 : 1;
    }
    lodesman::bench::run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, LODESMAN_PROGRAM ": %s\n", error.what());
    return 1;
  }
  return 0;
}
