// SPDX-License-Identifier: Apache-2.0
// A stopwatch for reports, apart from clock.h so that tasks can measure without holding a clock.
// Any thread.
#pragma once

#include "mid_level/base/time.h"

namespace lodesman {

// How long a piece of work took on this machine. A measurement for reports and nothing else: no
// decision may depend on it, and it never enters a recording hash.
class Stopwatch {
 public:
  Stopwatch() noexcept;
  [[nodiscard]] Duration elapsed() const noexcept;

 private:
  Time started_;
};

}  // namespace lodesman
