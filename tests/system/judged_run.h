// SPDX-License-Identifier: Apache-2.0
// A run of the whole boat in lock-step in the default profile, judged by one who sees everything:
// what was hit, when it could first be known, and whether it could have been avoided. One thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "deploy/operator/report/run_record.h"

namespace lodesman::testing {

struct Collision {
  double time_s = 0.0;                 // scenario time
  std::uint32_t obstacle = 0;          // id, as it stands in the scenario from 1 on
  std::optional<double> first_seen_s;  // when its track first stood on the blackboard, if before
  bool avoidable = false;              // from then on
};

struct JudgedRun {
  cli::RunResult result;
  std::optional<Collision> collision;
  bool waiting = false;  // held: it keeps a place, and the plan says why
  std::string last_rung;

  // The run, what became of it, and the command that sails it again. One line.
  std::string story;
};

// The scenario's own seed without one. Scenarios without a current only: a state's speed through
// the water is taken from the truth over ground.
[[nodiscard]] JudgedRun judged_run(const std::string& scenario_name,
                                   const std::vector<std::string>& sets = {},
                                   std::optional<std::uint64_t> seed = {});

// Of many runs.
struct Outcomes {
  int runs = 0;
  int reached = 0;
  int waiting = 0;  // held at the time limit, with a reason
  int adrift = 0;   // not reached, without one
  int avoidable = 0;
  int unavoidable = 0;  // collisions
  std::string notable;  // the story of each that was not reached

  void add(const JudgedRun& run);
  [[nodiscard]] std::string table() const;
};

}  // namespace lodesman::testing
