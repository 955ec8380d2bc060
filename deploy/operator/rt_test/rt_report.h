// SPDX-License-Identifier: Apache-2.0
// What `lodesman rt-test` has found: as a table for people, as JSON for programs, and whether the
// task table is kept. Pure; any thread.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "deploy/operator/rt_test/cyclictest.h"
#include "deploy/operator/rt_test/load.h"
#include "deploy/operator/rt_test/task_figures.h"

namespace lodesman::cli {

// At which cyclictest runs beside the tasks: the task table's highest.
[[nodiscard]] int cyclictest_priority() noexcept;

struct RtConditions {
  LoadKind load = LoadKind::kIdle;
  double wanted_s = 0.0;
  double seconds = 0.0;  // that were looked at
  unsigned cores = 1;
  std::string kernel;
  bool real_time_kernel = false;
  std::string processor;
};

// Of one task, from worst_response(); empty where there is no bound.
struct WorstResponses {
  std::optional<Duration> one_core;
  std::optional<Duration> all_cores;
};

struct RtReport {
  RtConditions conditions;
  std::vector<TaskFigures> tasks;         // in the order of the task table
  std::vector<WorstResponses> responses;  // of these
  double utilisation = 0.0;
  std::optional<CyclictestFigures> cyclictest;
  std::string cyclictest_why;  // it told nothing; empty where it was not asked for
};

// Of two looks, with the wake-up that cyclictest found worst as what any release may wait for.
[[nodiscard]] RtReport report_of(const RtConditions& conditions, const BoatLook& first,
                                 const BoatLook& last,
                                 const std::optional<CyclictestFigures>& cyclictest);

// Every reason why the task table is not kept, in words; empty where it is.
[[nodiscard]] std::vector<std::string> objections(const RtReport& report);

[[nodiscard]] std::vector<std::string> table_lines(const RtReport& report);
[[nodiscard]] nlohmann::ordered_json to_json(const RtReport& report);

}  // namespace lodesman::cli
