// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/report/kept_run.h"

#include <utility>

namespace lodesman::cli {
namespace {

[[nodiscard]] bool is_found(const PlanRecord& plan) { return plan.reason == PathReason::kFound; }

}  // namespace

void KeptRows::add(const TrajectoryRow& row) {
  last_ = row;
  if (count_++ % stride_ != 0) {
    return;
  }
  if (rows_.size() >= most_) {
    for (std::size_t i = 0; 2 * i < rows_.size(); ++i) {
      rows_[i] = rows_[2 * i];
    }
    rows_.resize((rows_.size() + 1) / 2);
    stride_ *= 2;
    if ((count_ - 1) % stride_ != 0) {
      return;
    }
  }
  rows_.push_back(row);
}

std::vector<TrajectoryRow> KeptRows::rows() const {
  std::vector<TrajectoryRow> rows = rows_;
  if (count_ > 0 && (count_ - 1) % stride_ != 0) {
    rows.push_back(last_);
  }
  return rows;
}

std::size_t KeptPlans::last_found() const noexcept {
  std::size_t i = plans_.size();
  while (i > 0 && !is_found(plans_[i - 1].plan)) {
    --i;
  }
  return i > 0 ? i - 1 : plans_.size();
}

void KeptPlans::add(PlanRecord plan, bool changes_side) {
  if (plans_.size() >= most_) {
    thin_out();
  }
  const bool found = is_found(plan);
  bool& seen = found ? any_found_ : any_found_ ? any_without_path_after_ : any_without_path_;
  const bool first_of_its_kind = !std::exchange(seen, true);
  if (const std::size_t before = last_found(); changes_side && before < plans_.size()) {
    plans_[before].always = true;
  }
  plans_.push_back({std::move(plan), first_of_its_kind || changes_side, false});
}

void KeptPlans::mark_closest() noexcept {
  for (Kept& kept : plans_) {
    kept.closest = false;
  }
  if (!plans_.empty()) {
    plans_.back().closest = true;
  }
  if (const std::size_t found = last_found(); found < plans_.size()) {
    plans_[found].closest = true;
  }
}

void KeptPlans::thin_out() {
  const std::size_t found = last_found();
  std::vector<Kept> fewer;
  for (std::size_t i = 0; i < plans_.size(); ++i) {
    const bool told = plans_[i].always || plans_[i].closest || i == found;
    if (told || i % 2 == 0 || i + 1 == plans_.size()) {
      fewer.push_back(std::move(plans_[i]));
    }
  }
  plans_ = std::move(fewer);
}

std::vector<PlanRecord> KeptPlans::plans() const {
  std::vector<PlanRecord> plans;
  plans.reserve(plans_.size());
  for (const Kept& kept : plans_) {
    plans.push_back(kept.plan);
  }
  return plans;
}

}  // namespace lodesman::cli
