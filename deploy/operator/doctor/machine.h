// SPDX-License-Identifier: Apache-2.0
// What this machine offers to the boat's programs, as plain facts. Measured by one thread, at no
// one's cost: every trial is undone at once.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "deploy/boat/common_options.h"

namespace lodesman::cli {

struct MachineFacts {
  bool root = false;

  bool fifo_allowed = false;  // tried, at the highest priority of the task table
  int fifo_priority = 0;      // that priority

  bool lock_unlimited = false;  // by limit or by right
  std::uint64_t lock_limit_bytes = 0;
  std::uint64_t lock_needed_bytes = 0;  // of the larger of the two programs, estimated

  bool shm_writable = false;  // tried
  std::uint64_t shm_free_bytes = 0;
  std::uint64_t segment_bytes = 0;
  std::vector<std::string> dead_segments;  // in /dev/shm, of programs that were killed

  bool gnuplot = false;
  std::vector<std::string> rt_test_missing;  // packages that lodesman rt-test can make use of

  std::string configuration;        // the directory; empty where there is none
  std::string configuration_error;  // one line; empty where every shipped file is valid

  std::filesystem::path program_directory;
  std::vector<std::string> programs_missing;

  bool preempt_rt = false;
  std::string governor;  // of the first processor; empty where the machine does not say
};

[[nodiscard]] MachineFacts measure_machine(const CommonOptions& common);

}  // namespace lodesman::cli
