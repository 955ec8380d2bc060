// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/rt_test/thread_facts.h"

#include <unistd.h>

#include <fstream>
#include <sstream>

namespace lodesman::cli {
namespace {

namespace fs = std::filesystem;

[[nodiscard]] std::string proc_text(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream{file}.rdbuf();
  return text.str();
}

}  // namespace

std::optional<NamedThread> read_thread_stat(std::string_view line) {
  const auto open = line.find('(');
  const auto close = line.rfind(')');
  if (open == std::string_view::npos || close == std::string_view::npos || close < open) {
    return std::nullopt;
  }
  NamedThread thread;
  thread.name = line.substr(open + 1, close - open - 1);
  std::istringstream number{std::string{line.substr(0, open)}};
  std::istringstream rest{std::string{line.substr(close + 1)}};
  // proc(5): state, ppid, pgrp, session, tty_nr, tpgid, flags, minflt, cminflt, majflt, cmajflt,
  // utime, stime.
  std::string skipped;
  for (int field = 3; field <= 9; ++field) {
    rest >> skipped;
  }
  std::uint64_t user = 0;
  std::uint64_t kernel = 0;
  ThreadFacts& facts = thread.facts;
  number >> facts.thread;
  rest >> facts.minor_faults >> skipped >> facts.major_faults >> skipped >> user >> kernel;
  facts.cpu_ticks = user + kernel;
  return number && rest ? std::optional{thread} : std::nullopt;
}

std::uint64_t read_put_off(std::string_view status) {
  constexpr std::string_view kKey = "nonvoluntary_ctxt_switches:";
  const auto at = status.find(kKey);
  std::uint64_t count = 0;
  if (at != std::string_view::npos) {
    std::istringstream{std::string{status.substr(at + kKey.size())}} >> count;
  }
  return count;
}

std::map<std::string, ThreadFacts> thread_facts(pid_t process) {
  std::map<std::string, ThreadFacts> threads;
  std::error_code error;
  const fs::path tasks = fs::path{"/proc"} / std::to_string(process) / "task";
  for (fs::directory_iterator entry{tasks, error}, end; !error && entry != end;
       entry.increment(error)) {
    auto thread = read_thread_stat(proc_text(entry->path() / "stat"));
    if (!thread) {
      continue;  // it has ended meanwhile
    }
    thread->facts.put_off = read_put_off(proc_text(entry->path() / "status"));
    ThreadFacts& known = threads[thread->name];
    known = thread->facts.thread > known.thread ? thread->facts : known;
  }
  return threads;
}

pid_t child_named(const std::string& program) {
  const std::string own = std::to_string(getpid());
  std::istringstream children{proc_text(fs::path{"/proc"} / own / "task" / own / "children")};
  for (pid_t child = 0; children >> child;) {
    std::string name;
    std::istringstream{proc_text(fs::path{"/proc"} / std::to_string(child) / "comm")} >> name;
    if (name == program) {
      return child;
    }
  }
  return 0;
}

double ticks_per_second() noexcept { return static_cast<double>(sysconf(_SC_CLK_TCK)); }

}  // namespace lodesman::cli
