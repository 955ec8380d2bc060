// SPDX-License-Identifier: Apache-2.0
// Counts operator new, where malloc is the sanitizers'.
#include <cstdlib>
#include <new>

#include "tests/support/allocations.h"

// All single-object forms together: one that is not replaced could meet another one's delete.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  lodesman::testing::count_allocation();
  return std::malloc(size == 0 ? 1 : size);
}
void* operator new(std::size_t size) {
  if (void* memory = operator new(size, std::nothrow)) {
    return memory;
  }
  throw std::bad_alloc{};
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { std::free(memory); }
