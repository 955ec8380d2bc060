// SPDX-License-Identifier: Apache-2.0
// LODESMAN_CHECK stops the program on a bug, in every build: the other process sees the silence
// and makes the boat safe. It is never used on input.
#pragma once

namespace lodesman {
[[noreturn]] void check_failed(const char* expression, const char* file, int line) noexcept;
}  // namespace lodesman

#define LODESMAN_CHECK(expression) \
  ((expression) ? static_cast<void>(0) : ::lodesman::check_failed(#expression, __FILE__, __LINE__))
