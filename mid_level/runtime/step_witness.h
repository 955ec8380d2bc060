// SPDX-License-Identifier: Apache-2.0
// Has a task look at its channels once a step, and publishes how far it saw each of them, so that
// the step can be made again from a recording. Part of a runner; one thread. It allocates nothing
// once made.
#pragma once

#include <algorithm>
#include <optional>

#include "mid_level/blackboard/channel_places.h"
#include "mid_level/runtime/task.h"

namespace lodesman {

class StepWitness {
 public:
  StepWitness(Blackboard& board, const TaskEntry& entry, Role role) : task_{*entry.task} {
    const auto inputs = task_.inputs();
    LODESMAN_CHECK(inputs.size() <= StepInputs::kMost);
    for (std::size_t i = 0; i < kReplayedCount && !inputs.empty(); ++i) {
      if (kStepInputsInfo[i].task == entry.spec.id) {
        writer_.emplace(board.step_inputs[i], role, kStepInputsInfo[i].channel);
      }
    }
    told_.count = inputs.size();
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      told_.inputs[i].channel = place_of(board, *inputs[i]);
    }
  }

  // Before the first step that this runner makes: of a task that never was stepped is told what
  // there was as it was made. What came between is its first step's.
  void begin(Time now) noexcept {
    if (task_.steps() == 0) {
      tell(now, [](const ChannelLook<>& input) { return input.newest_when_made(); });
    }
  }
  void look() noexcept {
    const auto inputs = task_.inputs();
    std::for_each(inputs.rbegin(), inputs.rend(), [](ChannelLook<>* input) { input->look(); });
  }
  void stepped(Time began) noexcept {
    task_.count_step();
    tell(began, [](const ChannelLook<>& input) { return input.newest_sequence(); });
  }

 private:
  template <class Saw>
  void tell(Time at, Saw saw) noexcept {
    if (!writer_) {
      return;
    }
    const auto inputs = task_.inputs();
    told_.step = task_.steps();
    told_.whole = true;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      told_.inputs[i].sequence = saw(*inputs[i]);
      told_.whole &= inputs[i]->is_whole();
    }
    writer_->publish(told_, at);
  }

  Task& task_;
  std::optional<Writer<StepInputs>> writer_;
  StepInputs told_;
};

}  // namespace lodesman
