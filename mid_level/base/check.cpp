// SPDX-License-Identifier: Apache-2.0
#include "mid_level/base/check.h"

#include <cstdio>
#include <cstdlib>

namespace lodesman {

void check_failed(const char* expression, const char* file, int line) noexcept {
  std::fprintf(stderr, "%s:%d: bug: check failed: %s\n", file, line, expression);
  std::abort();
}

}  // namespace lodesman
