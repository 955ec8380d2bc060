// SPDX-License-Identifier: Apache-2.0
// How a program is told to end: SIGINT, SIGTERM, SIGHUP (unless it was started under nohup), or,
// for a child of `lodesman sim`, the end of its standard input. Whatever a parent has blocked or
// ignored does not count. The main thread.
#pragma once

#include <functional>

#include "mid_level/base/time.h"

namespace lodesman {

// What all programs have in common: a broken pipe or a full quota is an error of the write, and
// children are waited for.
void settle_signals() noexcept;

// For programs with tasks: keeps the stop signals for wait_for_stop(), lets all others through. To
// be called before any thread is started.
void block_stop_signals() noexcept;
// From now on the end of standard input, a pipe whose other end the parent holds, is a stop too: it
// comes however the parent dies, and whatever rights this program has.
void stop_with_standard_input() noexcept;
// Down that pipe the launcher beats, once in kPulsePeriod.
inline constexpr Duration kPulsePeriod = std::chrono::milliseconds{50};
// Whether it has fallen silent, frozen perhaps: long enough to be sure, short enough for neutral
// within 0.5 s. Never for a program without such a pipe. Asked within wait_for_stop().
[[nodiscard]] bool launcher_is_silent() noexcept;
// Whether a stop has been asked for: for what waits before wait_for_stop().
[[nodiscard]] bool stop_asked() noexcept;
// Returns once a stop is asked for, or once `give_up` says true (asked forty times a second).
void wait_for_stop(const std::function<bool()>& give_up);

// For the operator's command: no signal is blocked, and each does what it usually does.
void unblock_signals() noexcept;
// From now on a stop signal interrupts what waits, and nothing else.
void catch_stop_signals() noexcept;
[[nodiscard]] bool stop_caught() noexcept;

}  // namespace lodesman
