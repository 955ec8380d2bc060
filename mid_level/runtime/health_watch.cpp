// SPDX-License-Identifier: Apache-2.0
#include "mid_level/runtime/health_watch.h"

#include <algorithm>

namespace lodesman {
namespace {

[[nodiscard]] std::string in_seconds(Duration duration) {
  const auto tenths = std::chrono::duration_cast<std::chrono::milliseconds>(duration).count() / 100;
  return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " s";
}

}  // namespace

HealthWatch::HealthWatch(const Blackboard& board) {
  for (const TaskSpec& spec : kTaskTable) {
    tasks_.push_back({spec.id, silence_limit(spec.period),
                      Reader<TaskHealth>{board.task_health[static_cast<std::size_t>(spec.id)]},
                      std::nullopt});
  }
}

HealthWatch::HealthWatch(const Blackboard& board, std::span<const TaskEntry> tasks, Time since) {
  for (const TaskEntry& entry : tasks) {
    tasks_.push_back(
        {entry.spec.id, silence_limit(entry.spec.period),
         Reader<TaskHealth>{board.task_health[static_cast<std::size_t>(entry.spec.id)]}, since});
  }
}

// A stamp that is yet to come tells nothing, whoever wrote it.
void HealthWatch::listen(Watched& watched, Time now) noexcept {
  const auto* newest = watched.reader.latest();
  if (newest != nullptr && newest->stamp <= now) {
    watched.heard = std::max(watched.heard.value_or(Time{}), newest->stamp);
  }
}

bool HealthWatch::is_silent(const Watched& watched, Time now) noexcept {
  return watched.heard && now - *watched.heard > watched.limit;
}

bool HealthWatch::all_step(Time now) {
  return std::all_of(tasks_.begin(), tasks_.end(), [now](Watched& watched) {
    listen(watched, now);
    return watched.heard > watched.begun;
  });
}

std::vector<SilentTask> HealthWatch::silent(Time now) {
  std::vector<SilentTask> silent;
  for (Watched& watched : tasks_) {
    listen(watched, now);
    if (is_silent(watched, now)) {
      silent.push_back({watched.task, now - *watched.heard});
    }
  }
  return silent;
}

std::vector<std::string> HealthWatch::news(Time now) {
  std::vector<std::string> lines;
  for (Watched& watched : tasks_) {
    listen(watched, now);
    const std::string task = std::string{"task "} + to_string(watched.task);
    if (is_silent(watched, now)) {
      if (!watched.silent_since) {
        watched.silent_since = watched.heard;
        lines.push_back(task + " hangs: no word of it for " + in_seconds(now - *watched.heard));
      }
    } else if (watched.silent_since) {
      lines.push_back(task + " steps again, after " +
                      in_seconds(*watched.heard - *watched.silent_since));
      watched.silent_since.reset();
    }
  }
  return lines;
}

}  // namespace lodesman
