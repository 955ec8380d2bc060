// SPDX-License-Identifier: Apache-2.0
// The exceptions of this project: start-up refuses a file, an option or a machine with one
// line `file:line: key: reason`. Nothing throws once the tasks run.
#pragma once

#include <stdexcept>
#include <string>

namespace lodesman {

class StartupError : public std::runtime_error {
 public:
  explicit StartupError(const std::string& text) : std::runtime_error{one_line(text)} {}
  StartupError(const std::string& file, std::size_t line, const std::string& key,
               const std::string& reason)
      : StartupError{file + ":" + std::to_string(line) + ": " + key + ": " + reason} {}

 private:
  // Names and keys of files may hold anything; a refusal is one line that harms no terminal.
  [[nodiscard]] static std::string one_line(std::string text) {
    constexpr std::size_t kMaxLength = 1000;
    for (char& c : text) {
      c = (c >= '\0' && c < ' ') || c == '\x7f' ? '?' : c;
    }
    return text.size() <= kMaxLength ? text : text.substr(0, kMaxLength) + "...";
  }
};

// Nothing is wrong, but what is needed is not there yet: trying again later may do.
class NotYetError : public StartupError {
 public:
  using StartupError::StartupError;
};

}  // namespace lodesman
