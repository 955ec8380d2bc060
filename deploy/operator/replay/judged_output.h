// SPDX-License-Identifier: Apache-2.0
// One channel that a task decides: what it publishes when it is stepped again, beside what the
// recording has. One thread.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "deploy/operator/replay/publication_log.h"
#include "deploy/operator/replay/verdict.h"
#include "mid_level/blackboard/blackboard.h"

namespace lodesman::cli {

// What one step published, or should have.
struct StepOutput {
  std::uint64_t recorded = 0;  // publications
  std::uint64_t outside = 0;   // recorded before this step, and after the one before it
  std::uint64_t missing = 0;   // not in the recording
  std::vector<Difference> differences;
};

class JudgedOutput {
 public:
  // By the channel's place in for_each_channel(). `after`: what was recorded before the task began.
  // The board must outlive it.
  [[nodiscard]] static std::unique_ptr<JudgedOutput> of(const Blackboard& board,
                                                        std::uint64_t channel, std::uint64_t after);
  JudgedOutput() = default;
  JudgedOutput(const JudgedOutput&) = delete;
  JudgedOutput& operator=(const JudgedOutput&) = delete;
  virtual ~JudgedOutput() = default;

  [[nodiscard]] virtual std::uint64_t channel() const noexcept = 0;
  // After each step. `ends`: so near to the recording's end that what it published may be lost.
  virtual void judge(Time stepped, const ChannelLog& log, bool ends, StepOutput& output) = 0;
  // What was recorded after the last step.
  [[nodiscard]] virtual std::uint64_t left(const ChannelLog& log) const noexcept = 0;
};

}  // namespace lodesman::cli
