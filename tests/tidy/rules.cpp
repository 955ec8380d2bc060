// SPDX-License-Identifier: Apache-2.0
#include "tests/tidy/rules.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>

namespace lodesman::tidy {
namespace {

using Places = std::vector<std::string_view>;

constexpr std::size_t kMaxColumns = 100;
constexpr std::size_t kMaxFileLines = 400;

[[nodiscard]] std::string at(const SourceFile& file, std::size_t line, const std::string& what) {
  return file.path + ":" + std::to_string(line) + ": " + what;
}

// Every place in `text` (the file's, or its code) that the pattern fits.
[[nodiscard]] Findings matches(const SourceFile& file, const std::string& text,
                               const std::string& pattern) {
  Findings findings;
  const std::regex expression{pattern};
  const auto lines = lines_of(text);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    std::smatch match;
    if (std::regex_search(lines[i], match, expression)) {
      findings.push_back(at(file, i + 1, match.str()));
    }
  }
  return findings;
}

// The same in the code of C++ files outside `allowed`.
[[nodiscard]] Findings banned(const SourceFile& file, const std::string& pattern,
                              const Places& allowed) {
  return file.is_cpp() && !file.lies_in(allowed) ? matches(file, file.code, pattern) : Findings{};
}

[[nodiscard]] std::size_t columns_of(const std::string& line) {
  return static_cast<std::size_t>(
      std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

// What a CMake list is made of: words between spaces and brackets.
[[nodiscard]] std::vector<std::string> words_of(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '(' || c == ')'; }, ' ');
  std::istringstream stream{text};
  return {std::istream_iterator<std::string>{stream}, {}};
}

[[nodiscard]] bool needs_licence_line(const SourceFile& file) {
  static const std::regex sources{
      R"(\.(h|cpp|cmake|sh|py|gp|toml|m?js|css|html|service|rules)$|CMakeLists\.txt$|)"
      R"(\.clang-tidy$)"};
  return std::regex_search(file.path, sources) || file.text.starts_with("#!");
}

}  // namespace

// The thread sanitizer does not understand them.
Findings fences(const SourceFile& file) {
  return banned(file, R"(\batomic_(thread|signal)_fence\b)", {"tests/"});
}

Findings chance_in_tests(const SourceFile& file) {
  return file.path.starts_with("tests/")
             ? banned(file, R"(\b(s?rand|rand_r|drand48)\s*\(|\brandom_device\b)",
                      {"tests/tidy/forbidden_calls.cpp"})
             : Findings{};
}

Findings conditionals(const SourceFile& file) {
  return banned(file, R"(^\s*#\s*(if|ifdef|ifndef|elif|else)\b)", {"tests/support/catch.h"});
}

Findings truth_readers(const SourceFile& file) {
  return banned(
      file, R"(\b(world_truth|WorldTruth)\b)",
      {"mid_level/messages/vehicle.h", "mid_level/blackboard/blackboard.h", "hal_sim/world/world.h",
       "hal_sim/world/world.cpp", "hal_sim/world/world_task.h", "hal_sim/world/world_task.cpp",
       "high_level/tasks/estimator.h", "high_level/tasks/estimator.cpp", "deploy/", "tests/"});
}

Findings hasty_tests(const SourceFile& file) {
  if (!file.path.starts_with("tests/system/")) {
    return {};
  }
  Findings findings = matches(file, file.code, R"(\b(latest|next|fresh)\([^()]*\)->)");
  for (const auto& port :
       matches(file, file.text, R"(command_socket\.port ?= ?([1-9]\d{0,3}|[1-6]\d{4})\b)")) {
    findings.push_back(port);
  }
  return findings;
}

Findings numbers_from_outside(const SourceFile& file) {
  return banned(file, R"(\bCLI::(Range|Number|PositiveNumber|NonNegativeNumber|Bound)\b)",
                {"tests/"});
}

Findings long_lines(const SourceFile& file) {
  Findings findings;
  const auto lines = lines_of(file.text);
  for (std::size_t i = 0; file.is_cpp() && i < lines.size(); ++i) {
    if (columns_of(lines[i]) > kMaxColumns) {
      findings.push_back(at(file, i + 1, "is longer than 100 columns"));
    }
  }
  return findings;
}

Findings long_files(const SourceFile& file) {
  const std::size_t lines = lines_of(file.text).size();
  return file.is_cpp() && lines > kMaxFileLines
             ? Findings{at(file, lines, "is longer than 400 lines")}
             : Findings{};
}

Findings licence_line(const SourceFile& file) {
  if (!needs_licence_line(file)) {
    return {};
  }
  const auto lines = lines_of(file.text);
  const std::size_t place = file.text.starts_with("#!") || file.text.starts_with("<!") ? 1 : 0;
  const bool there = lines.size() > place && lines[place].find(
                                                 "SPDX-License-Identifier: "
                                                 "Apache-2.0") != std::string::npos;
  return there ? Findings{} : Findings{at(file, place + 1, "has no SPDX line")};
}

// What it is, and which thread may call it: that takes two sentences. Tests may do with one.
Findings header_opening(const SourceFile& file) {
  if (!file.is_header()) {
    return {};
  }
  const auto lines = lines_of(file.text);
  std::string opening;
  std::size_t line = 1;
  for (; line < lines.size() && lines[line].starts_with("//"); ++line) {
    opening += lines[line].substr(2) + " ";
  }
  Findings findings;
  std::size_t sentences = 0;
  for (auto end = opening.find(". "); end != std::string::npos; end = opening.find(". ", end + 1)) {
    ++sentences;
  }
  if (sentences < (file.path.starts_with("tests/") ? 1U : 2U)) {
    findings.push_back(at(file, 2, "does not open with two sentences"));
  }
  if (line >= lines.size() || lines[line] != "#pragma once") {
    findings.push_back(at(file, line + 1, "has no #pragma once after its opening"));
  }
  return findings;
}

Findings message_units(const SourceFile& file) {
  Findings findings;
  if (!file.path.starts_with("mid_level/messages/") || !file.is_header()) {
    return findings;
  }
  static const std::regex member{
      R"(^\s+(double|float|int|Time|Duration|std::u?int\d+_t|std::size_t)"
      R"(|std::array<(double|float|std::u?int\d+_t)\b[^>]*>)\s+\w+\s*(=[^;]*|\{[^;]*\})?;)"};
  const auto lines = lines_of(file.text);
  const auto kinds = block_at_lines(file.code);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (kinds[i + 1] != BlockKind::kType || !std::regex_search(lines[i], member)) {
      continue;
    }
    const bool above = i > 0 && lines[i - 1].find("// [") != std::string::npos &&
                       lines[i - 1].find_first_not_of(' ') == lines[i - 1].find("//");
    if (!above && lines[i].find("// [") == std::string::npos) {
      findings.push_back(at(file, i + 1, "is a field without [unit]"));
    }
  }
  return findings;
}

Findings machine_paths(const SourceFile& file) {
  return matches(file, file.text, R"((^|[\s"'`=(:])/(home|work|root|Users|mnt|tmp)/)");
}

Findings unfinished(const SourceFile& file) {
  return matches(file, file.text, std::string{R"(\b(TO)"} + "DO|FIX" + R"(ME)\b)");
}

Findings unlisted_sources(const std::vector<SourceFile>& tree) {
  std::set<std::string> listed;
  for (const SourceFile& list : tree) {
    if (list.path.ends_with("CMakeLists.txt")) {
      const auto folder = std::filesystem::path{list.path}.parent_path();
      for (const std::string& word : words_of(list.text)) {
        listed.insert((folder / word).lexically_normal().generic_string());
      }
    }
  }
  Findings findings;
  for (const SourceFile& file : tree) {
    if (file.path.ends_with(".cpp") && !listed.contains(file.path)) {
      findings.push_back(at(file, 1, "is named in no CMakeLists.txt"));
    }
  }
  return findings;
}

const std::vector<Rule>& rules() {
  static const std::vector<Rule> all{
      {"include arrows", include_arrows},
      {"library rooms", library_rooms},
      {"fences", fences},
      {"chance in tests", chance_in_tests},
      {"conditionals", conditionals},
      {"truth readers", truth_readers},
      {"hasty tests", hasty_tests},
      {"numbers from outside", numbers_from_outside},
      {"long lines", long_lines},
      {"long files", long_files},
      {"licence line", licence_line},
      {"header opening", header_opening},
      {"message units", message_units},
      {"machine paths", machine_paths},
      {"unfinished", unfinished},
  };
  return all;
}

}  // namespace lodesman::tidy
