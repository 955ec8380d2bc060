// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/measure.h"

#include <time.h>

#include <algorithm>
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

// Short work is done so often for each time that long work is, and timed as a whole: reading the
// clock takes as long as a tenth of it.
constexpr int kShortTurns = 9;

// Processor time of this thread: what else the machine does would otherwise count against long work
// more than against short.
double thread_us() noexcept {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e6 + static_cast<double>(now.tv_nsec) / 1e3;
}

class Bench {
 public:
  explicit Bench(const FanShape& fan)
      : grid_{fan},
        search_{Geometry::k4, {}, fan},
        reference_{fan},
        boost_{fan},
        ompl_{OmplRrtConnect::make(grid_)} {}

  [[nodiscard]] FrameTimes time(const RandomFrame& frame, const Workload& workload) {
    for (std::vector<double>& times : us_) {
      times.clear();
    }
    for (int i = 0; i < workload.repetitions; ++i) {
      take_turns(frame, workload.with_others);
    }
    FrameTimes result{frame.kind, {}};
    for (std::size_t i = 0; i < kColumns; ++i) {
      std::sort(us_[i].begin(), us_[i].end());
      result.us[i] = us_[i].empty() ? 0.0 : us_[i][us_[i].size() / 2];
    }
    return result;
  }

 private:
  template <class Work>
  void time(Column column, int turns, Work work) {
    work();  // untimed: whoever had the turn before has left the caches full of its own
    const double began = thread_us();
    for (int i = 0; i < turns; ++i) {
      work();
    }
    us_[static_cast<std::size_t>(column)].push_back((thread_us() - began) / turns);
  }

  void take_turns(const RandomFrame& frame, bool with_others) {
    SearchResult ours;
    time(Column::kStep, kShortTurns, [&] {
      frame.draw(grid_);
      ours = search_.search(grid_, frame.start, frame.goal);
    });
    time(Column::kSearch, kShortTurns,
         [&] { ours = search_.search(grid_, frame.start, frame.goal); });
    time(Column::kCopy, kShortTurns, [&] { copy_bitmap(); });
    if (with_others) {
      SearchResult theirs;
      time(Column::kReference, 1,
           [&] { theirs = reference_.search(grid_, frame.start, frame.goal); });
      require_same(ours, theirs, "reference A*");
      time(Column::kBoost, 1, [&] { theirs = boost_.search(grid_, frame.start, frame.goal); });
      require_same(ours, theirs, "Boost A*");
      if (ompl_ != nullptr) {
        bool found = false;
        time(Column::kOmpl, 1, [&] { found = ompl_->search(frame.start, frame.goal); });
        if (found && ours.reason != PathReason::kFound) {
          throw std::runtime_error("OMPL finds a path where there is none");
        }
      }
    }
  }

  void copy_bitmap() {
    const BitLines& rows = grid_.rows();
    const auto stride = static_cast<std::size_t>(rows.words(1) - rows.words(0));
    copy_.resize(stride * static_cast<std::size_t>(rows.lines()));
    std::copy_n(rows.words(0), copy_.size(), copy_.data());
    sink_ = copy_[copy_.size() / 2];
  }

  static void require_same(const SearchResult& ours, const SearchResult& theirs,
                           const std::string& name) {
    if (ours.reason != theirs.reason || ours.cost_10_14 != theirs.cost_10_14) {
      throw std::runtime_error(name + " disagrees: " + std::to_string(theirs.cost_10_14) +
                               " instead of " + std::to_string(ours.cost_10_14));
    }
  }

  PassableGrid grid_;
  PathSearch search_;
  ReferenceAStar reference_;
  BoostAStar boost_;
  std::unique_ptr<OmplRrtConnect> ompl_;
  std::vector<std::uint64_t> copy_;
  volatile std::uint64_t sink_ = 0;
  std::array<std::vector<double>, kColumns> us_;
};

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
  Bench bench{workload.fan};
  std::vector<FrameTimes> all;
  all.reserve(frames.size());
  for (const RandomFrame& frame : frames) {
    all.push_back(bench.time(frame, workload));
  }
  return all;
}

}  // namespace lodesman::bench
