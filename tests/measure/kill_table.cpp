// SPDX-License-Identifier: Apache-2.0
#include "tests/measure/kill_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace lodesman::measure {

void KillTable::begin(const std::string& event, const std::string& until,
                      std::optional<double> bound_s) {
  rows_.push_back({event, until, bound_s, {}});
}

void KillTable::add(double seconds) { rows_.back().seconds.push_back(seconds); }

void KillTable::print() const {
  fmt::print("| what happened | until | times | median s | worst s | bound s |\n");
  fmt::print("|---|---|---|---|---|---|\n");
  for (const Row& row : rows_) {
    auto sorted = row.seconds;
    std::sort(sorted.begin(), sorted.end());
    const auto at = [&](std::size_t i) {
      return sorted.empty() ? std::string{"-"} : fmt::format("{:.3f}", sorted[i]);
    };
    fmt::print("| {} | {} | {} | {} | {} | {} |\n", row.event, row.until, sorted.size(),
               at(sorted.size() / 2), at(sorted.empty() ? 0 : sorted.size() - 1),
               row.bound_s ? fmt::format("{:.1f}", *row.bound_s) : "-");
  }
  std::fflush(stdout);
}

bool KillTable::keeps_all_bounds() const {
  return std::all_of(rows_.begin(), rows_.end(), [](const Row& row) {
    return !row.bound_s || std::all_of(row.seconds.begin(), row.seconds.end(),
                                       [&](double s) { return s <= *row.bound_s; });
  });
}

}  // namespace lodesman::measure
