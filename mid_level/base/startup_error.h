// SPDX-License-Identifier: Apache-2.0
// The one exception of this project: start-up refuses a file, an option or a machine with one
// line `file:line: key: reason`. Nothing throws once the tasks run.
#pragma once

#include <stdexcept>
#include <string>

namespace lodesman {

class StartupError : public std::runtime_error {
 public:
  explicit StartupError(const std::string& one_line) : std::runtime_error{one_line} {}
  StartupError(const std::string& file, std::size_t line, const std::string& key,
               const std::string& reason)
      : std::runtime_error{file + ":" + std::to_string(line) + ": " + key + ": " + reason} {}
};

}  // namespace lodesman
