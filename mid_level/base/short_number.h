// SPDX-License-Identifier: Apache-2.0
// A number as people are told it: four digits, and no more zeros than that takes. Any thread.
#pragma once

#include <cstdio>
#include <string>

namespace lodesman {

[[nodiscard]] inline std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

}  // namespace lodesman
