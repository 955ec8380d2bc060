// SPDX-License-Identifier: Apache-2.0
// Response-time analysis of tasks with fixed priorities: how long after its release a step may end
// at the worst, from how long steps take and how often they are released. Pure; any thread.
//
// One core, exact for releases that may come as close together as their streams allow: Joseph and
// Pandya, "Finding response times in a real-time system" (1986), with the busy period of Lehoczky,
// "Fixed priority scheduling of periodic task sets with arbitrary deadlines" (1990) and the release
// jitter of Audsley et al., "Applying new scheduling theory to static priority pre-emptive
// scheduling" (1993). Several cores, sufficient: the bound of Bertogna and Cirinei, "Response-time
// analysis for globally scheduled symmetric multiprocessor platforms" (2007).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "mid_level/base/time.h"

namespace lodesman::cli {

// Releases that come one `spacing` after the other, each up to `jitter` later than that.
struct ReleaseStream {
  Duration spacing{};  // > 0
  Duration jitter{};   // >= 0
};

struct AnalysedTask {
  int priority = 0;  // the higher one runs; equals are taken to run before each other
  Duration execution{};
  Duration deadline{};   // from the release
  Duration least_gap{};  // no two steps begin closer together, however often released; 0: no limit
  std::vector<ReleaseStream> releases;
};

struct AnalysedMachine {
  unsigned cores = 1;
  Duration blocking{};  // that any release may have to wait for in any case: the kernel's wake-up
};

// At most so many steps begin for releases within a window of that length.
[[nodiscard]] std::int64_t releases_within(const AnalysedTask& task, Duration window) noexcept;

// From release to end, at the worst; empty where there is no bound below a minute. On several cores
// the deadlines of all others are taken to hold.
[[nodiscard]] std::optional<Duration> worst_response(std::span<const AnalysedTask> tasks,
                                                     std::size_t which,
                                                     const AnalysedMachine& machine);

// What share of one core the steps take when all are released as often as may be; 1 is all of it.
[[nodiscard]] double utilisation(std::span<const AnalysedTask> tasks) noexcept;

// Up to this share, periodic tasks whose deadlines are their periods meet them under rate-monotonic
// priorities on one core: Liu and Layland, "Scheduling algorithms for multiprogramming in a hard
// real-time environment" (1973).
[[nodiscard]] double rate_monotonic_bound(std::size_t tasks) noexcept;

}  // namespace lodesman::cli
