// SPDX-License-Identifier: Apache-2.0
// The lines of an input file, and the numbers in them, read with limits and refused by line. One
// thread, before anything runs; everything that is wrong throws StartupError.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "mid_level/base/startup_error.h"

namespace lodesman::cli {

// The whole file without its line ends (LF or CRLF). A pipe will do as well.
[[nodiscard]] std::vector<std::string> read_lines(const std::filesystem::path& file,
                                                  std::size_t max_bytes);

// A place in a file, for refusals.
struct LinePlace {
  const std::filesystem::path& file;
  std::size_t line;  // from 1 on

  [[noreturn]] void refuse(const std::string& key, const std::string& reason) const;
};

// The whole text must be the number.
[[nodiscard]] std::int64_t whole_number(const LinePlace& place, const std::string& key,
                                        std::string_view text, std::int64_t min, std::int64_t max);
[[nodiscard]] double finite_number(const LinePlace& place, const std::string& key,
                                   std::string_view text);

}  // namespace lodesman::cli
