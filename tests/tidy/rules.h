// SPDX-License-Identifier: Apache-2.0
// The house rules that a program can check, each a function from a file to what is wrong in it.
// Pure; one thread.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tests/tidy/source_file.h"

namespace lodesman::tidy {

// "path:line: what", as compilers say it.
using Findings = std::vector<std::string>;

struct Rule {
  const char* name;
  Findings (*check)(const SourceFile& file);
};

// Every rule that looks at one file at a time.
[[nodiscard]] const std::vector<Rule>& rules();

// A room and what its files may include besides itself and mid_level/base: whole rooms or single
// files; an empty name stands for everything. docs/architecture.md shows this table.
struct Arrow {
  std::string_view room;
  std::vector<std::string_view> may_include;
};
[[nodiscard]] const std::vector<Arrow>& arrows();

// Includes follow the arrows between the rooms. Every file lies in a room.
[[nodiscard]] Findings include_arrows(const SourceFile& file);
// A library's headers stay in the rooms that wrap it.
[[nodiscard]] Findings library_rooms(const SourceFile& file);
// What leaves no symbol behind, and what tests do: for the rest see symbols.h.
[[nodiscard]] Findings fences(const SourceFile& file);
[[nodiscard]] Findings chance_in_tests(const SourceFile& file);
[[nodiscard]] Findings conditionals(const SourceFile& file);
[[nodiscard]] Findings truth_readers(const SourceFile& file);
// CLI11's own ranges let through what is not a number: number_options.h checks.
[[nodiscard]] Findings numbers_from_outside(const SourceFile& file);
// Tests beside running processes wait for what they read and take no fixed port.
[[nodiscard]] Findings hasty_tests(const SourceFile& file);
[[nodiscard]] Findings long_lines(const SourceFile& file);
[[nodiscard]] Findings long_files(const SourceFile& file);
[[nodiscard]] Findings licence_line(const SourceFile& file);
[[nodiscard]] Findings header_opening(const SourceFile& file);
[[nodiscard]] Findings message_units(const SourceFile& file);
[[nodiscard]] Findings machine_paths(const SourceFile& file);
[[nodiscard]] Findings unfinished(const SourceFile& file);

// Every .cpp is named in a CMakeLists.txt of its directory or one above it.
[[nodiscard]] Findings unlisted_sources(const std::vector<SourceFile>& tree);

// A document cites a test by its whole name, in backquotes: "subject: sentence". Each must exist.
[[nodiscard]] Findings missing_tests(const std::vector<SourceFile>& tree);

// docs/security.md: a row of a table of threats whose last column is headed "test" cites one, or is
// "the same" as the row above.
[[nodiscard]] Findings threats_without_tests(const std::vector<SourceFile>& tree);

}  // namespace lodesman::tidy
