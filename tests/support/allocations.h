// SPDX-License-Identifier: Apache-2.0
// Counts what a piece of code asks of the heap on the calling thread: every malloc, calloc, realloc
// and aligned allocation, and with them every operator new; in builds with a sanitizer, which
// replaces these functions itself, operator new alone. Link the target count_allocations: it
// replaces them for the whole program.
#pragma once

#include <cstdint>

namespace lodesman::testing {

// For what stands in place of the allocating functions.
void count_allocation() noexcept;

// Counts the calling thread's allocations while it lives. Scopes may be nested.
class AllocationScope {
 public:
  AllocationScope() noexcept;
  AllocationScope(const AllocationScope&) = delete;
  AllocationScope& operator=(const AllocationScope&) = delete;
  ~AllocationScope() = default;

  [[nodiscard]] std::uint64_t count() const noexcept;

 private:
  std::uint64_t before_;
};

}  // namespace lodesman::testing
