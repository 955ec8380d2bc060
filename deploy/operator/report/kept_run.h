// SPDX-License-Identifier: Apache-2.0
// What of a run stays in memory for its pictures, however long it is: a bounded number of rows and
// plans, evenly fewer where there were more. Plain values; any one thread.
#pragma once

#include <cstddef>
#include <vector>

#include "deploy/operator/report/run_record.h"

namespace lodesman::cli {

class KeptRows {
 public:
  explicit KeptRows(std::size_t most = 36'000) : most_{most} {}  // an hour of rows

  void add(const TrajectoryRow& row);
  // In their order, the first and the last among them.
  [[nodiscard]] std::vector<TrajectoryRow> rows() const;

 private:
  std::size_t most_;
  std::size_t stride_ = 1;  // of the rows added one in so many is kept
  std::size_t count_ = 0;
  std::vector<TrajectoryRow> rows_;
  TrajectoryRow last_;
};

class KeptPlans {
 public:
  explicit KeptPlans(std::size_t most = 2048) : most_{most} {}

  // `changes_side`: the first one that does, see SideFlips::first_s.
  void add(PlanRecord plan, bool changes_side);
  // Nothing was nearer so far than what is passed with the newest plan.
  void mark_closest() noexcept;
  // In their order. Among them whatever a picture tells of: the first plan and the first found one,
  // the first without a path before and after that, the change of side with the plan that it
  // replaced, the closest approach and the end, these two with the last found plan.
  [[nodiscard]] std::vector<PlanRecord> plans() const;

 private:
  struct Kept {
    PlanRecord plan;
    bool always = false;
    bool closest = false;
  };
  void thin_out();
  [[nodiscard]] std::size_t last_found() const noexcept;  // index; the size where there is none

  std::size_t most_;
  std::vector<Kept> plans_;
  bool any_found_ = false;
  bool any_without_path_ = false;
  bool any_without_path_after_ = false;  // after a found one
};

}  // namespace lodesman::cli
