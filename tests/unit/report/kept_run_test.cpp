// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/report/kept_run.h"

#include <algorithm>

#include "tests/support/catch.h"

using namespace lodesman;
using cli::KeptPlans;
using cli::KeptRows;
using cli::PlanRecord;

namespace {

PlanRecord plan_at(double t_s, PathReason reason) {
  PlanRecord plan;
  plan.id = static_cast<std::uint64_t>(t_s);
  plan.t_s = t_s;
  plan.reason = reason;
  return plan;
}

bool has(const std::vector<PlanRecord>& plans, std::uint64_t id) {
  return std::any_of(plans.begin(), plans.end(), [&](const auto& p) { return p.id == id; });
}

}  // namespace

TEST_CASE("kept rows: few are all kept, of many a bounded number evenly", "[report]") {
  KeptRows kept{100};
  for (int i = 0; i < 100; ++i) {
    kept.add({.t_s = 0.1 * i});
  }
  CHECK(kept.rows().size() == 100);
  for (int i = 100; i < 10'001; ++i) {
    kept.add({.t_s = 0.1 * i});
  }
  const auto rows = kept.rows();
  REQUIRE(rows.size() > 50);
  CHECK(rows.size() <= 101);
  CHECK(rows.front().t_s == Approx(0.0));
  CHECK(rows.back().t_s == Approx(1000.0));
  double widest_s = 0.0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    REQUIRE(rows[i].t_s > rows[i - 1].t_s);
    widest_s = std::max(widest_s, rows[i].t_s - rows[i - 1].t_s);
  }
  CHECK(widest_s < 20.1);
}

TEST_CASE("kept plans: of many a bounded number, and all that a picture tells of", "[report]") {
  KeptPlans kept{64};
  for (std::uint64_t i = 1; i <= 20'000; ++i) {
    const bool found = i > 3 && i != 1000 && i != 1001 && i < 19'990;
    kept.add(plan_at(static_cast<double>(i), found ? PathReason::kFound : PathReason::kNoPath),
             i == 4321);
    if (i == 500 || i == 1001) {
      kept.mark_closest();
    }
  }
  const auto plans = kept.plans();
  CHECK(plans.size() <= 64);
  CHECK(std::is_sorted(plans.begin(), plans.end(),
                       [](const auto& a, const auto& b) { return a.t_s < b.t_s; }));
  // The first of their kind, the change of side, the closest approach (found last, and newest), the
  // end likewise.
  for (const std::uint64_t id : {1U, 4U, 1000U, 4320U, 4321U, 999U, 1001U, 19'989U, 20'000U}) {
    INFO(id);
    CHECK(has(plans, id));
  }
}
