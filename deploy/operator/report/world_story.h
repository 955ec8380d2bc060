// SPDX-License-Identifier: Apache-2.0
// Which moments of a run its world picture shows, and how much of the world: as the paper's
// Fig. 5 tells its run in four panels. Pure functions; any thread.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "deploy/operator/report/plot_script.h"
#include "deploy/operator/report/run_record.h"

namespace lodesman::cli {

inline constexpr std::size_t kMaxMoments = 4;

struct Moment {
  double t_s = 0.0;
  std::string caption;
  bool is_end = false;
  const PlanRecord* plan = nullptr;        // the newest then; into the record, as the others
  const PlanRecord* last_found = nullptr;  // the newest then that found a path
  const PlanRecord* replaced = nullptr;    // where the path changed side: the found plan before it
};

// The first plan, the first change of side, the first plan without a path, the end; the closest
// approach in the place of one that did not happen. At least the end, in the order of time.
[[nodiscard]] std::vector<Moment> story(const RunRecord& record);

struct ViewBox {
  Point low{};
  Point high{};
};

// Everything that those moments draw, and of far obstacles what lies near it.
[[nodiscard]] ViewBox view_box(const RunRecord& record, const std::vector<Moment>& moments);

// The row that holds at that time: the last one up to it, else the first; none: nullptr.
[[nodiscard]] const TrajectoryRow* row_at(const std::vector<TrajectoryRow>& rows, double t_s);

// A course, and time left to sail it.
[[nodiscard]] bool moves(const MovingObstacle& obstacle);

}  // namespace lodesman::cli
