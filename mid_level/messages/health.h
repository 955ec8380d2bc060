// SPDX-License-Identifier: Apache-2.0
// How the tasks themselves are doing.
// Plain data for the blackboard; any thread.
#pragma once

#include <cstdint>

#include "mid_level/messages/fields.h"

namespace lodesman {

// Written by the runner after each step of a task, on that task's own channel; read by displays.
struct TaskHealth {
  std::uint64_t steps = 0;          // [-] done so far
  std::uint64_t overruns = 0;       // [-] periods missed so far, and skipped
  std::uint64_t last_step_ns = 0;   // [ns] of the last step, measured
  std::uint64_t worst_step_ns = 0;  // [ns] of the longest step, measured

  static constexpr auto fields() noexcept {
    using T = TaskHealth;
    return std::tuple{field("steps", &T::steps), field("overruns", &T::overruns),
                      measured_field("last_step_ns", &T::last_step_ns),
                      measured_field("worst_step_ns", &T::worst_step_ns)};
  }
};

}  // namespace lodesman
