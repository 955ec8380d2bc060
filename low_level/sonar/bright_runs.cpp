// SPDX-License-Identifier: Apache-2.0
#include "low_level/sonar/bright_runs.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>

namespace lodesman {
namespace {

// Every second cell at most begins a run.
constexpr std::size_t kMaxRuns = EchoPlane::kMaxAcross * EchoPlane::kMaxAlong / 2;

// Plain, and of three that are told apart, so that it is done many at once.
void mark_brighter(std::uint8_t* __restrict mask, const std::int16_t* __restrict cells,
                   const std::int16_t* __restrict levels, std::uint32_t count) noexcept {
  for (std::uint32_t i = 0; i < count; ++i) {
    mask[i] = cells[i] > levels[i] ? 1 : 0;
  }
}

// The first cell from `from` on that is as wanted, at most `end`; eight are looked at together.
std::uint32_t skip(const std::uint8_t* mask, std::uint32_t from, std::uint32_t end,
                   std::uint8_t unwanted) noexcept {
  std::uint64_t eight_unwanted = 0;
  std::memset(&eight_unwanted, unwanted, sizeof eight_unwanted);
  while (from + sizeof eight_unwanted <= end) {
    std::uint64_t eight = 0;
    std::memcpy(&eight, mask + from, sizeof eight);
    if (eight != eight_unwanted) {
      break;
    }
    from += sizeof eight;
  }
  while (from < end && mask[from] == unwanted) {
    ++from;
  }
  return from;
}

}  // namespace

BrightRuns::BrightRuns() {
  runs_.reserve(kMaxRuns);
  sorted_.reserve(kMaxRuns);
  echoes_.reserve(kMaxRuns);
  parent_.resize(kMaxRuns);
  first_of_beam_.resize(EchoPlane::kMaxAcross + 1);
}

void BrightRuns::find(const EchoPlane& plane, const RangeLevels& levels,
                      std::uint32_t nearest) noexcept {
  runs_.clear();
  echoes_.clear();
  beams_ = plane.layout().beams;
  for (std::uint32_t beam = 0; beam < beams_; ++beam) {
    first_of_beam_[beam] = static_cast<std::uint32_t>(runs_.size());
    find_in_beam(plane.smooth(beam), levels, beam, nearest);
  }
  first_of_beam_[beams_] = static_cast<std::uint32_t>(runs_.size());
}

void BrightRuns::find_in_beam(std::span<const std::int16_t> cells, const RangeLevels& levels,
                              std::uint32_t beam, std::uint32_t nearest) noexcept {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): written before it is read
  std::array<std::uint8_t, EchoPlane::kMaxAlong> bright;
  const auto end = static_cast<std::uint32_t>(cells.size());
  mark_brighter(bright.data(), cells.data(), levels.weak.data(), end);
  std::uint32_t begin = skip(bright.data(), std::min(nearest, end), end, 0);
  while (begin < end) {
    const std::uint32_t dark = skip(bright.data(), begin, end, 1);
    runs_.push_back({beam, begin, dark, 0});
    begin = skip(bright.data(), dark, end, 0);
  }
}

void BrightRuns::join(const EchoPlane& plane, const RangeLevels& levels,
                      const ContrastOptions& options, std::uint32_t most) noexcept {
  part_all();
  link(options.join_beams, options.join_bins, 0);
  sum_up(plane, levels);
  keep(options);
  if (echoes_.size() > most) {
    join_neighbours(options, most);
    sum_up(plane, levels);
  }
  sort_runs();
}

// Nearest ones first: with every round those that are half as far apart again, and no more of them
// than has to be.
void BrightRuns::join_neighbours(const ContrastOptions& options, std::uint32_t most) noexcept {
  part_all();
  link(options.join_beams, options.join_bins, 0);
  double reach = 1.0;
  while (parts_ > most) {
    reach *= 1.5;
    link(static_cast<std::uint32_t>(options.join_beams * reach),
         static_cast<std::uint32_t>(options.join_bins * reach), most);
  }
}

void BrightRuns::part_all() noexcept {
  parts_ = static_cast<std::uint32_t>(runs_.size());
  std::iota(parent_.begin(), parent_.begin() + parts_, 0U);
}

std::uint32_t BrightRuns::root_of(std::uint32_t run) noexcept {
  while (parent_[run] != run) {
    parent_[run] = parent_[parent_[run]];
    run = parent_[run];
  }
  return run;
}

void BrightRuns::unite(std::uint32_t a, std::uint32_t b) noexcept {
  a = root_of(a);
  b = root_of(b);
  parent_[std::max(a, b)] = std::min(a, b);
  parts_ -= a != b ? 1 : 0;
}

// Ends as soon as no more parts than that are left.
void BrightRuns::link(std::uint32_t beams, std::uint32_t bins, std::uint32_t enough) noexcept {
  for (std::uint32_t beam = 0; beam < beams_ && parts_ > enough; ++beam) {
    const std::uint32_t end = first_of_beam_[beam + 1];
    for (std::uint32_t run = first_of_beam_[beam] + 1; run < end && parts_ > enough; ++run) {
      if (runs_[run].begin - runs_[run - 1].end <= bins) {
        unite(run, run - 1);
      }
    }
    for (std::uint32_t before = beam - std::min(beam, beams); before < beam; ++before) {
      link_beams(before, beam, bins, enough);
    }
  }
}

// Runs of both come in the order of range, so that each is looked at once.
void BrightRuns::link_beams(std::uint32_t one, std::uint32_t other, std::uint32_t bins,
                            std::uint32_t enough) noexcept {
  std::uint32_t a = first_of_beam_[one];
  std::uint32_t b = first_of_beam_[other];
  while (a < first_of_beam_[one + 1] && b < first_of_beam_[other + 1] && parts_ > enough) {
    if (runs_[a].begin <= runs_[b].end + bins && runs_[b].begin <= runs_[a].end + bins) {
      unite(a, b);
    }
    (runs_[a].end < runs_[b].end ? a : b) += 1;
  }
}

void BrightRuns::sum_up(const EchoPlane& plane, const RangeLevels& levels) noexcept {
  echoes_.clear();
  for (std::uint32_t i = 0; i < runs_.size(); ++i) {
    const std::uint32_t root = root_of(i);
    if (root == i) {
      runs_[i].echo = static_cast<std::uint32_t>(echoes_.size());
      echoes_.emplace_back();
    } else {
      runs_[i].echo = runs_[root].echo;  // a root comes before all that it holds
    }
    EchoSum& echo = echoes_[runs_[i].echo];
    const std::span<const std::int16_t> cells = plane.smooth(runs_[i].beam);
    echo.run_count += 1;
    for (std::uint32_t bin = runs_[i].begin; bin < runs_[i].end; ++bin) {
      const double contrast =
          cells[bin] / std::max(1.0, static_cast<double>(levels.background[bin]));
      echo.has_seed = echo.has_seed || cells[bin] > levels.seed[bin];
      echo.energy += (contrast - 1.0) / levels.needed_excess;
    }
  }
}

// Leaves the runs of those that are kept alone, in their order.
void BrightRuns::keep(const ContrastOptions& options) noexcept {
  const auto is_kept = [&](const EchoSum& echo) {
    return echo.has_seed && echo.energy >= options.min_energy;
  };
  std::uint32_t kept = 0;
  std::uint32_t run = 0;
  for (std::uint32_t beam = 0; beam < beams_; ++beam) {
    const std::uint32_t end = first_of_beam_[beam + 1];
    first_of_beam_[beam] = kept;
    for (; run < end; ++run) {
      if (is_kept(echoes_[runs_[run].echo])) {
        runs_[kept++] = runs_[run];
      }
    }
  }
  first_of_beam_[beams_] = kept;
  runs_.resize(kept);
  std::uint32_t number = 0;
  for (EchoSum& echo : echoes_) {
    echo.first_run = is_kept(echo) ? number++ : 0;
  }
  for (BrightRun& kept_run : runs_) {
    kept_run.echo = echoes_[kept_run.echo].first_run;
  }
  std::erase_if(echoes_, [&](const EchoSum& echo) { return !is_kept(echo); });
}

void BrightRuns::sort_runs() noexcept {
  std::uint32_t first = 0;
  for (EchoSum& echo : echoes_) {
    echo.first_run = first;
    first += echo.run_count;
    echo.run_count = 0;
  }
  sorted_.resize(runs_.size());
  for (const BrightRun& run : runs_) {
    EchoSum& echo = echoes_[run.echo];
    sorted_[echo.first_run + echo.run_count++] = run;
  }
}

}  // namespace lodesman
