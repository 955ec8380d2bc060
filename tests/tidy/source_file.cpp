// SPDX-License-Identifier: Apache-2.0
#include "tests/tidy/source_file.h"

#include <algorithm>
#include <fstream>
#include <regex>
#include <sstream>

namespace lodesman::tidy {
namespace {

// Where a comment or literal that begins at `i` ends; `i` itself where none begins.
[[nodiscard]] std::size_t end_of_blank(const std::string& text, std::size_t i) {
  const auto after = [&](std::string_view end, std::size_t from) {
    const auto place = text.find(end, from);
    return place == std::string::npos ? text.size() : place + end.size();
  };
  if (text.compare(i, 2, "//") == 0) {
    return std::min(text.find('\n', i), text.size());
  }
  if (text.compare(i, 2, "/*") == 0) {
    return after("*/", i + 2);
  }
  if (text.compare(i, 2, "R\"") == 0) {
    const auto open = text.find('(', i);
    return after(")" + text.substr(i + 2, open - i - 2) + "\"", open);
  }
  // A digit before it makes it a separator (1'000), not a literal.
  const bool separator = text[i] == '\'' && i > 0 && std::isalnum(text[i - 1]) != 0;
  if (text[i] != '"' && (text[i] != '\'' || separator)) {
    return i;
  }
  std::size_t end = i + 1;
  while (end < text.size() && text[end] != text[i]) {
    end += text[end] == '\\' ? 2U : 1U;
  }
  return std::min(end + 1, text.size());
}

[[nodiscard]] std::string without_comments_and_literals(const std::string& text) {
  std::string code = text;
  std::size_t i = 0;
  while (i < text.size()) {
    const std::size_t end = end_of_blank(text, i);
    for (std::size_t k = i; k < end; ++k) {
      code[k] = text[k] == '\n' ? '\n' : ' ';
    }
    i = std::max(end, i + 1);
  }
  return code;
}

[[nodiscard]] BlockKind kind_of(const std::string& head, BlockKind outer) {
  static const std::regex is_namespace{R"(\bnamespace\b)"};
  static const std::regex is_type{R"(\b(class|struct|union|enum)\b[^()]*$)"};
  if (outer == BlockKind::kFunction || outer == BlockKind::kOther) {
    return BlockKind::kOther;
  }
  if (std::regex_search(head, is_namespace)) {
    return BlockKind::kNamespace;
  }
  if (std::regex_search(head, is_type) && head.find('=') == std::string::npos) {
    return BlockKind::kType;
  }
  return head.find('(') != std::string::npos ? BlockKind::kFunction : BlockKind::kOther;
}

// Calls on_open(head, offset of the head's first letter) and on_close(offset) for the braces.
template <class Open, class Close>
void walk_braces(const std::string& code, Open on_open, Close on_close) {
  std::size_t head = 0;
  for (std::size_t i = 0; i < code.size(); ++i) {
    if (code[i] == '#' && (i == 0 || code[i - 1] == '\n')) {  // a preprocessor line is no head
      i = std::min(code.find('\n', i), code.size() - 1);
      head = i + 1;
    } else if (code[i] == ';') {
      head = i + 1;
    } else if (code[i] == '{') {
      head = std::min(code.find_first_not_of(" \n\t", head), i);
      on_open(code.substr(head, i - head), head);
      head = i + 1;
    } else if (code[i] == '}') {
      on_close(i);
      head = i + 1;
    }
  }
}

}  // namespace

SourceFile::SourceFile(std::string path_from_root, std::string whole_text)
    : path{std::move(path_from_root)},
      text{std::move(whole_text)},
      code{without_comments_and_literals(text)} {}

bool SourceFile::is_header() const noexcept { return path.ends_with(".h"); }
bool SourceFile::is_cpp() const noexcept { return is_header() || path.ends_with(".cpp"); }

bool SourceFile::lies_in(const std::vector<std::string_view>& places) const {
  return std::any_of(places.begin(), places.end(), [&](std::string_view place) {
    return place.ends_with('/') ? path.starts_with(place) : path == place;
  });
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream{text};
  for (std::string line; std::getline(stream, line);) {
    lines.push_back(line);
  }
  return lines;
}

std::size_t line_at(const std::string& text, std::size_t offset) {
  return 1 + static_cast<std::size_t>(std::count(
                 text.begin(), text.begin() + static_cast<std::ptrdiff_t>(offset), '\n'));
}

std::vector<Block> blocks_of(const std::string& code) {
  std::vector<Block> open;
  std::vector<Block> closed;
  std::size_t member_inits = 0;  // the line of a constructor whose `: a_{x}` came before its body
  walk_braces(
      code,
      [&](const std::string& head, std::size_t offset) {
        const BlockKind outer = open.empty() ? BlockKind::kNamespace : open.back().kind;
        Block block{kind_of(head, outer), line_at(code, offset), 0, head};
        if (member_inits != 0 && (head.empty() || head.front() == ',')) {
          block.kind = BlockKind::kFunction;
          block.first_line = member_inits;
        }
        member_inits = 0;
        open.push_back(block);
      },
      [&](std::size_t offset) {
        if (open.empty()) {
          return;
        }
        Block block = open.back();
        open.pop_back();
        block.last_line = line_at(code, offset);
        const auto next = code.find_first_not_of(" \n\t", offset + 1);
        const bool goes_on = next != std::string::npos && (code[next] == ',' || code[next] == '{');
        if (block.kind == BlockKind::kFunction && goes_on) {
          member_inits = block.first_line;
        } else {
          closed.push_back(block);
        }
      });
  return closed;
}

std::vector<BlockKind> block_at_lines(const std::string& code) {
  std::vector<BlockKind> kinds(lines_of(code).size() + 2, BlockKind::kNamespace);
  std::vector<Block> blocks = blocks_of(code);
  // Outer blocks end later: painted first, the inner ones paint over them.
  std::reverse(blocks.begin(), blocks.end());
  for (const Block& block : blocks) {
    for (std::size_t line = block.first_line + 1; line <= block.last_line; ++line) {
      kinds[line] = block.kind;
    }
  }
  return kinds;
}

std::vector<SourceFile> read_tree(const std::filesystem::path& root) {
  namespace fs = std::filesystem;
  std::vector<SourceFile> files;
  for (auto entry = fs::recursive_directory_iterator{root};
       entry != fs::recursive_directory_iterator{}; ++entry) {
    const std::string name = entry->path().filename().string();
    if (entry->is_directory()) {
      const bool ours = entry.depth() > 0 ||
                        (name != "build" && name != "runs" && name != ".git" && name != ".cache");
      if (!ours) {
        entry.disable_recursion_pending();
      }
      continue;
    }
    if (name == ".git" || !entry->is_regular_file()) {
      continue;
    }
    std::ifstream stream{entry->path(), std::ios::binary};
    std::ostringstream text;
    text << stream.rdbuf();
    files.emplace_back(fs::relative(entry->path(), root).generic_string(), text.str());
  }
  std::sort(files.begin(), files.end(),
            [](const SourceFile& a, const SourceFile& b) { return a.path < b.path; });
  return files;
}

}  // namespace lodesman::tidy
