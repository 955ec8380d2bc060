// SPDX-License-Identifier: Apache-2.0
// What the machine grants to a real-time program: locked memory, and SCHED_FIFO up to a priority.
// The main thread, but for hold_fifo_priority().
#pragma once

#include <string>

namespace lodesman {

// Locks this process's memory and finds out how far SCHED_FIFO is granted for the task table. Empty
// when all is as it should be; otherwise one line that says what is missing, and for which tasks.
// To be called once, before the runner, by a thread that is not SCHED_FIFO.
[[nodiscard]] std::string set_up_realtime();

// Makes the calling thread SCHED_FIFO at `wanted`, or at the highest priority below it that is
// granted; returns the priority that it then holds, 0 where none is. Any thread.
int hold_fifo_priority(int wanted) noexcept;

// What is said of the tasks of the task table that want more than `granted`; empty when none does.
[[nodiscard]] std::string refused_priorities(int granted);

}  // namespace lodesman
