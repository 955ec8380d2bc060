// SPDX-License-Identifier: Apache-2.0
// The tasks that are stepped again, as the boat has them. One thread.
#pragma once

#include <memory>
#include <span>

#include "deploy/operator/replay/publication_log.h"
#include "drivers/hal/devices.h"
#include "high_level/tasks/high_level.h"
#include "low_level/tasks/low_level.h"
#include "mid_level/runtime/task.h"

namespace lodesman::cli {

struct ReplayOptions {
  LowLevelOptions low;
  HighLevelOptions high;
};

// Gives a step the ping that the recorded one took from the device.
class RecordedSonar final : public ImagingSonar {
 public:
  // False where a ping is missing that this step, or an earlier one, may have taken.
  [[nodiscard]] bool prepare(Time stepped, const ChannelLog& pings);
  [[nodiscard]] ReadStatus poll(Time now, SonarPing& out) noexcept override;
  // Pings of before are nobody's.
  void begin_after(std::uint64_t sequence) noexcept { taken_ = sequence; }
  // Whether the recording has pings after those that steps were given.
  [[nodiscard]] bool has_more(const ChannelLog& pings) const noexcept {
    return pings.after(taken_) != nullptr;
  }

 private:
  std::uint64_t taken_ = 0;
  bool has_ping_ = false;
  std::unique_ptr<SonarPing> ping_ = std::make_unique<SonarPing>();
};

// `sonar` must outlive the task.
[[nodiscard]] std::unique_ptr<Task> make_task(TaskId task, Blackboard& board,
                                              const ReplayOptions& options, RecordedSonar& sonar);

// By their names: the channels on which that task says what it has decided.
[[nodiscard]] std::span<const char* const> decisions_of(TaskId task) noexcept;

}  // namespace lodesman::cli
