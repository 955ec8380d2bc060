// SPDX-License-Identifier: Apache-2.0
// Which tasks tell nothing of themselves any more: one whose step hangs cannot say so. Main threads
// and observers; one thread. It writes nothing to the blackboard and is handed the time.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mid_level/runtime/health.h"
#include "mid_level/runtime/task_table.h"

namespace lodesman {

// From when on the last that a task told is too old: twice and a half what it takes at most.
[[nodiscard]] constexpr Duration silence_limit(Duration period) noexcept {
  return 5 * (kHealthPeriod + period) / 2;
}

struct SilentTask {
  TaskId task = TaskId::kWorld;
  Duration silent{};  // since its last word, or since it was to begin
};

class HealthWatch {
 public:
  // Every task of the board that ever told of itself. The board must outlive the watch.
  explicit HealthWatch(const Blackboard& board);
  // These tasks, which are to step from `since` on; what was told before is another run's.
  HealthWatch(const Blackboard& board, std::span<const TaskEntry> tasks, Time since);

  // Whether each has told of itself since it was to begin.
  [[nodiscard]] bool all_step(Time now);
  // Those that are silent at `now`.
  [[nodiscard]] std::vector<SilentTask> silent(Time now);
  // One line for each task that fell silent, or spoke again, since the last call.
  [[nodiscard]] std::vector<std::string> news(Time now);

 private:
  struct Watched {
    TaskId task;
    Duration limit;
    Reader<TaskHealth> reader;
    std::optional<Time> heard;           // nothing: never
    std::optional<Time> begun = heard;   // to step
    std::optional<Time> silent_since{};  // as news() has said
  };

  static void listen(Watched& watched, Time now) noexcept;
  [[nodiscard]] static bool is_silent(const Watched& watched, Time now) noexcept;

  std::vector<Watched> tasks_;
};

}  // namespace lodesman
