// SPDX-License-Identifier: Apache-2.0
// Where count_allocations.cpp, preloaded into another program, tells how often each of its threads
// has asked the heap for memory: a file that both have mapped. Plain atomics; any thread.
//
// A slot is claimed once by its thread and written by it alone. `thread` is stored last: whoever
// reads it, by acquire, sees a count of that thread, never one before it.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace lodesman::cli {

struct AllocationSlot {
  std::atomic<std::int32_t> thread{0};  // its number in the system; 0: nobody's
  std::atomic<std::uint64_t> count{0};  // of malloc, calloc, realloc and what aligns, so of new
};

struct AllocationSlots {
  static constexpr std::uint32_t kMost = 256;  // threads beyond are not counted

  std::atomic<std::uint32_t> claimed{0};  // may go beyond kMost
  std::array<AllocationSlot, kMost> slots{};
};

// The environment's variable that names the file.
inline constexpr const char* kAllocationsFile = "LODESMAN_ALLOCATIONS";
inline constexpr const char* kAllocationsLibrary = "liblodesman-allocations.so";

}  // namespace lodesman::cli
