// SPDX-License-Identifier: Apache-2.0
// What the boat does when something falls silent or goes: one table, by the constants that the
// program itself goes by. Any thread.
#pragma once

#include <string>
#include <vector>

#include "mid_level/base/time.h"

namespace lodesman {

struct Failsafe {
  std::string what;     // that is missing
  Duration after{};     // so long
  std::string happens;  // then
  std::string told;     // and who says so, where
};

[[nodiscard]] std::vector<Failsafe> failsafes();

// As a Markdown table, a row a line.
[[nodiscard]] std::vector<std::string> failsafe_rows();

}  // namespace lodesman
