// SPDX-License-Identifier: Apache-2.0
// Counts the allocations of programs that are started while it is in the environment, thread by
// thread. One thread, and no other that reads the environment.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <map>

#include "deploy/operator/rt_test/allocation_slots.h"

namespace lodesman::cli {

// The library beside this program, or where it is installed; empty where there is none, as in
// builds with a sanitizer, which has a heap of its own.
[[nodiscard]] std::filesystem::path allocations_library();

class AllocationCounter {
 public:
  // Puts the library into the environment of what is started from now on. Its file, which lies in
  // `directory`, is left to whoever owns that. Without the library it counts nothing.
  explicit AllocationCounter(const std::filesystem::path& directory);
  AllocationCounter(const AllocationCounter&) = delete;
  AllocationCounter& operator=(const AllocationCounter&) = delete;
  ~AllocationCounter();

  // What is started from now on is not counted.
  void leave_environment() noexcept;
  // So far, by the threads' numbers; of a thread that is not among them nothing was asked, if a
  // main thread of its program is.
  [[nodiscard]] std::map<pid_t, std::uint64_t> counts() const;

 private:
  const AllocationSlots* slots_ = nullptr;
  bool in_environment_ = false;
};

}  // namespace lodesman::cli
