// SPDX-License-Identifier: Apache-2.0
// What stands in a file. For tests.
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace lodesman::testing {

[[nodiscard]] inline std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream{file, std::ios::binary}.rdbuf();
  return text.str();
}

}  // namespace lodesman::testing
