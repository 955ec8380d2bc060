// SPDX-License-Identifier: Apache-2.0
#include "tests/support/allocations.h"

namespace lodesman::testing {
namespace {

thread_local constinit std::uint64_t t_allocations = 0;

}  // namespace

void count_allocation() noexcept { ++t_allocations; }

AllocationScope::AllocationScope() noexcept : before_{t_allocations} {}

std::uint64_t AllocationScope::count() const noexcept { return t_allocations - before_; }

}  // namespace lodesman::testing
