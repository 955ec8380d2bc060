// SPDX-License-Identifier: Apache-2.0
// Counts what a piece of code asks of the heap: every malloc, calloc, realloc and aligned
// allocation of the calling thread, and with them every operator new. Linking allocations.cpp
// replaces these functions for the whole program, so it is not for builds with a sanitizer.
#pragma once

#include <cstdint>

namespace lodesman::testing {

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
