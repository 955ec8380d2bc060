// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/measure.h"

#include <benchmark/benchmark.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>

#include "low_level/path/path_search.h"
#include "tests/bench/boost_a_star.h"
#include "tests/bench/ompl_rrt_connect.h"
#include "tests/bench/reference_a_star.h"

namespace lodesman::bench {
namespace {

using testing::FrameKind;
using testing::FrameMaker;
using testing::RandomFrame;

constexpr bool is_other(Column column) noexcept {
  return column == Column::kReference || column == Column::kBoost || column == Column::kOmpl;
}

// Short work is done so often for each time that long work is, and timed as a whole: reading the
// clock takes as long as a tenth of it.
constexpr int turns_of(Column column) noexcept { return is_other(column) ? 1 : 9; }

class Planners {
 public:
  explicit Planners(const FanShape& fan)
      : grid_{fan},
        search_{Geometry::k4, {}, fan},
        reference_{fan},
        boost_{fan},
        ompl_{OmplRrtConnect::make(grid_)},
        bitmap_(static_cast<std::size_t>(grid_.rows().lines() * grid_.rows().words_per_line())),
        copy_(bitmap_.size()) {}

  [[nodiscard]] bool have(Column column) const noexcept {
    return column != Column::kOmpl || ompl_ != nullptr;
  }

  void draw(const RandomFrame& frame) noexcept { frame.draw(grid_); }

  // Of a frame that is drawn.
  SearchResult answer(Column column, const RandomFrame& frame) {
    switch (column) {
      case Column::kStep: draw(frame); return search_.search(grid_, frame.start, frame.goal);
      case Column::kSearch: return search_.search(grid_, frame.start, frame.goal);
      case Column::kReference: return reference_.search(grid_, frame.start, frame.goal);
      case Column::kBoost: return boost_.search(grid_, frame.start, frame.goal);
      case Column::kOmpl: {
        const bool found = ompl_->search(frame.start, frame.goal);
        return {found ? PathReason::kFound : PathReason::kNoPath, 0, 0, {}};
      }
      case Column::kCopy:
        std::copy(bitmap_.begin(), bitmap_.end(), copy_.begin());
        benchmark::ClobberMemory();
    }
    return {};
  }

 private:
  PassableGrid grid_;
  PathSearch search_;
  ReferenceAStar reference_;
  BoostAStar boost_;
  std::unique_ptr<OmplRrtConnect> ompl_;
  std::vector<std::uint64_t> bitmap_;
  std::vector<std::uint64_t> copy_;
};

// OMPL's path need not be cheapest, and may not be found in time.
void require_same(Column column, const SearchResult& theirs, const SearchResult& ours) {
  if (column == Column::kOmpl) {
    if (theirs.reason == PathReason::kFound && ours.reason != PathReason::kFound) {
      throw std::runtime_error("OMPL finds a path where there is none");
    }
  } else if (column != Column::kCopy &&
             (theirs.reason != ours.reason || theirs.cost_10_14 != ours.cost_10_14)) {
    throw std::runtime_error(std::string{kColumnNames[static_cast<std::size_t>(column)]} +
                             " disagrees: " + std::to_string(theirs.cost_10_14) + " instead of " +
                             std::to_string(ours.cost_10_14));
  }
}

// Says on a terminal how much of a run is done.
class Progress {
 public:
  void expect(int repetitions) noexcept { expected_ += repetitions; }
  void one_more() noexcept {
    ++done_;
    if (terminal_ && done_ == expected_) {
      std::fputs("\r\x1b[K", stderr);
    } else if (terminal_ && done_ % 100 == 0) {
      std::fprintf(stderr, "\r%d of %d times", done_, expected_);
    }
  }

 private:
  bool terminal_ = isatty(STDERR_FILENO) == 1;
  int expected_ = 0;
  int done_ = 0;
};

// Takes Google Benchmark's medians over the repetitions to where they belong, for benchmarks in the
// order in which they are registered.
class Medians final : public benchmark::BenchmarkReporter {
 public:
  void put_next_into(double& us) { places_.push_back(&us); }

  bool ReportContext(const Context& /*context*/) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.aggregate_name == "median" || run.repetitions == 1) {
        *places_.at(static_cast<std::size_t>(run.family_index)) = run.GetAdjustedCPUTime();
      }
    }
  }

 private:
  std::vector<double*> places_;
};

// All repetitions of all benchmarks in an order drawn at random. The library takes this wish from a
// command line only, and keeps pointers into it.
void interleave_at_random() {
  static std::string program = "bench_path";
  static std::string wish = "--benchmark_enable_random_interleaving=true";
  std::array arguments{program.data(), wish.data()};
  int count = arguments.size();
  benchmark::Initialize(&count, arguments.data());
}

}  // namespace

std::vector<FrameTimes> measure(const Workload& workload) {
  std::vector<FrameKind> kinds = workload.kinds;
  for (std::size_t i = 0; workload.kinds.empty() && i < testing::kFrameKindNames.size(); ++i) {
    kinds.push_back(static_cast<FrameKind>(i));
  }
  FrameMaker maker{workload.seed, workload.fan, workload.times};
  std::vector<RandomFrame> frames;
  for (int i = 0; i < workload.frames; ++i) {
    for (const FrameKind kind : kinds) {
      frames.push_back(maker.make(kind));
    }
  }
  return measure(workload, frames);
}

std::vector<FrameTimes> measure(const Workload& workload, const std::vector<RandomFrame>& frames) {
  Planners planners{workload.fan};
  Progress progress;
  Medians medians;
  std::vector<FrameTimes> all(frames.size());
  benchmark::ClearRegisteredBenchmarks();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    all[i].kind = frames[i].kind;
    const SearchResult ours = planners.answer(Column::kStep, frames[i]);
    for (std::size_t j = 0; j < kColumns; ++j) {
      const auto column = static_cast<Column>(j);
      if (!planners.have(column) || (is_other(column) && !workload.with_others)) {
        continue;
      }
      // What was timed before left another frame in the grid, and its own data in the caches: so
      // the frame is drawn and answered once untimed.
      const auto repetition = [&, column, ours, &frame = frames[i]](benchmark::State& state) {
        planners.draw(frame);
        require_same(column, planners.answer(column, frame), ours);
        for ([[maybe_unused]] const auto turn : state) {
          SearchResult answer = planners.answer(column, frame);
          benchmark::DoNotOptimize(answer);
        }
        progress.one_more();
      };
      const std::string name = std::string{kColumnNames[j]} + " " + std::to_string(i);
      benchmark::RegisterBenchmark(name.c_str(), repetition)
          ->Iterations(turns_of(column))
          ->Repetitions(workload.repetitions)
          ->Unit(benchmark::kMicrosecond);
      medians.put_next_into(all[i].us[j]);
      progress.expect(workload.repetitions);
    }
  }
  interleave_at_random();
  benchmark::RunSpecifiedBenchmarks(&medians, "all");
  return all;
}

}  // namespace lodesman::bench
