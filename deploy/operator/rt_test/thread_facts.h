// SPDX-License-Identifier: Apache-2.0
// What the kernel tells of another process's threads: their page faults, the processor time they
// took, how often they were put off a core. Read from /proc; any thread.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace lodesman::cli {

// Since the thread began.
struct ThreadFacts {
  pid_t thread = 0;
  std::uint64_t minor_faults = 0;  // a page was there, not yet mapped
  std::uint64_t major_faults = 0;  // a page had to be read
  std::uint64_t cpu_ticks = 0;     // in user and kernel mode
  std::uint64_t put_off = 0;       // taken off its core though it had more to do
};

// The line of /proc/PID/task/TID/stat; its name may hold blanks and brackets. Empty where it is
// none.
struct NamedThread {
  std::string name;
  ThreadFacts facts;
};
[[nodiscard]] std::optional<NamedThread> read_thread_stat(std::string_view line);
// nonvoluntary_ctxt_switches of /proc/PID/task/TID/status; 0 where it does not say.
[[nodiscard]] std::uint64_t read_put_off(std::string_view status);

// By the threads' names; of two of one name the one with the higher number. Empty where there is no
// such process.
[[nodiscard]] std::map<std::string, ThreadFacts> thread_facts(pid_t process);

// A child of this process that runs that program; 0 where there is none.
[[nodiscard]] pid_t child_named(const std::string& program);

// Ticks of ThreadFacts::cpu_ticks in a second.
[[nodiscard]] double ticks_per_second() noexcept;

}  // namespace lodesman::cli
