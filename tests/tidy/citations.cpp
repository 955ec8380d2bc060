// SPDX-License-Identifier: Apache-2.0
// The tests that the documents cite, word for word, and those that there are.
#include <algorithm>
#include <set>
#include <sstream>

#include "tests/tidy/rules.h"

namespace lodesman::tidy {
namespace {

// The literals that begin at `at`, joined as the compiler joins them.
[[nodiscard]] std::string literals_at(const std::string& text, std::size_t at) {
  std::string joined;
  for (;;) {
    at = text.find_first_not_of(" \n", at);
    if (at == std::string::npos || text[at] != '"') {
      return joined;
    }
    for (++at; at < text.size() && text[at] != '"'; ++at) {
      at += text[at] == '\\' ? 1U : 0U;
      joined += text.substr(at, 1);
    }
    ++at;
  }
}

[[nodiscard]] std::set<std::string> test_names(const std::vector<SourceFile>& tree) {
  const std::string macro = "TEST_CASE(";
  std::set<std::string> names;
  for (const SourceFile& file : tree) {
    if (!file.is_cpp() || !file.path.starts_with("tests/")) {
      continue;
    }
    for (auto at = file.text.find(macro); at != std::string::npos;
         at = file.text.find(macro, at + 1)) {
      names.insert(literals_at(file.text, at + macro.size()));
    }
  }
  return names;
}

// "subject: a sentence", in the lower case and of two words at least behind the colon.
[[nodiscard]] bool cites_a_test(const std::string& span) {
  const auto colon = span.find(": ");
  const auto is_subject = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == ' ' || c == '_' || c == '-';
  };
  return colon != std::string::npos && colon > 0 && span[0] >= 'a' && span[0] <= 'z' &&
         std::all_of(span.begin(), span.begin() + static_cast<std::ptrdiff_t>(colon), is_subject) &&
         span.find(' ', colon + 2) != std::string::npos;
}

// With line ends as the spaces that they are read as.
[[nodiscard]] std::string span_of(const std::string& text, std::size_t from, std::size_t to) {
  std::string span = text.substr(from, to - from);
  std::replace(span.begin(), span.end(), '\n', ' ');
  return span;
}

[[nodiscard]] bool cites_one_of(const std::string& cell, const std::set<std::string>& names) {
  for (std::size_t open = cell.find('`'); open != std::string::npos;) {
    const std::size_t close = cell.find('`', open + 1);
    if (close == std::string::npos) {
      return false;
    }
    if (names.contains(cell.substr(open + 1, close - open - 1))) {
      return true;
    }
    open = cell.find('`', close + 1);
  }
  return false;
}

}  // namespace

Findings threats_without_tests(const std::vector<SourceFile>& tree) {
  const std::set<std::string> names = test_names(tree);
  Findings findings;
  for (const SourceFile& file : tree) {
    if (file.path != "docs/security.md") {
      continue;
    }
    bool in_table = false;
    std::istringstream lines{file.text};
    std::string line;
    for (std::size_t number = 1; std::getline(lines, line); ++number) {
      const bool begins = line.ends_with("| test |");
      in_table = line.starts_with("|") && (in_table || begins);
      if (!in_table || begins || line.starts_with("|---")) {
        continue;
      }
      const std::size_t cell = line.rfind(" | ");
      if (cell == std::string::npos || (!line.substr(cell + 3).starts_with("the same") &&
                                        !cites_one_of(line.substr(cell), names))) {
        findings.push_back(file.path + ":" + std::to_string(number) + ": cites no test");
      }
    }
  }
  return findings;
}

Findings missing_tests(const std::vector<SourceFile>& tree) {
  const std::set<std::string> names = test_names(tree);
  Findings findings;
  for (const SourceFile& file : tree) {
    if (!file.path.ends_with(".md")) {
      continue;
    }
    std::size_t open = file.text.find('`');
    while (open != std::string::npos) {
      const std::size_t close = file.text.find('`', open + 1);
      if (close == std::string::npos) {
        break;
      }
      const std::string span = span_of(file.text, open + 1, close);
      if (cites_a_test(span) && !names.contains(span)) {
        findings.push_back(file.path + ":" + std::to_string(line_at(file.text, open)) +
                           ": there is no test '" + span + "'");
      }
      open = file.text.find('`', close + 1);
    }
  }
  return findings;
}

}  // namespace lodesman::tidy
