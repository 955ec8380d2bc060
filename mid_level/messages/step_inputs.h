// SPDX-License-Identifier: Apache-2.0
// What a task looked at in one step: so much of each channel, and no more, so that the step can be
// made again (ADR 0038). Plain data for the blackboard; any thread.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "mid_level/messages/fields.h"

namespace lodesman {

// One of the task's readers.
struct SeenInput {
  std::uint64_t channel = 0;   // [-] its place in for_each_channel()
  std::uint64_t sequence = 0;  // [-] the newest publication that it could see; 0: there was none

  static constexpr auto fields() noexcept {
    return field_list(field("channel", &SeenInput::channel),
                      field("sequence", &SeenInput::sequence));
  }
};

// Published after each step, with the time that the step was given as its stamp, and once before
// the first, as the task was made. Its own channels a task sees as they are.
struct StepInputs {
  static constexpr std::size_t kMost = 16;

  std::uint64_t step = 0;  // [-] counted from 1; 0: made, not yet stepped
  // Nothing that it could see was written over, or half written, when it looked.
  bool whole = true;
  std::uint64_t count = 0;                // [-] of its readers
  std::array<SeenInput, kMost> inputs{};  // one a reader, in the task's order

  [[nodiscard]] std::size_t used_bytes() const noexcept {
    return offsetof(StepInputs, inputs) + std::min<std::size_t>(count, kMost) * sizeof(SeenInput);
  }

  static constexpr auto fields() noexcept {
    using S = StepInputs;
    return field_list(field("step", &S::step), field("whole", &S::whole), field("count", &S::count),
                      field("inputs", &S::inputs, &S::count));
  }
};

}  // namespace lodesman
