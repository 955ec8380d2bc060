// SPDX-License-Identifier: Apache-2.0
// A file of the tree as the house rules see it: its text, its code without comments and literals,
// and its blocks. One thread.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace lodesman::tidy {

struct SourceFile {
  SourceFile(std::string path_from_root, std::string whole_text);

  std::string path;  // from the root of the tree, with '/'
  std::string text;
  std::string code;  // the text with comments and literals blanked; newlines stand

  [[nodiscard]] bool is_cpp() const noexcept;     // .h or .cpp
  [[nodiscard]] bool is_header() const noexcept;  // .h
  // Whether the path is one of these, or lies below one that ends in '/'.
  [[nodiscard]] bool lies_in(const std::vector<std::string_view>& places) const;
};

enum class BlockKind { kNamespace, kType, kFunction, kOther };

// What stands between two braces.
struct Block {
  BlockKind kind = BlockKind::kOther;
  std::size_t first_line = 0;  // of its head, from 1
  std::size_t last_line = 0;
  std::string head;  // what stands before its brace
};

[[nodiscard]] std::vector<std::string> lines_of(const std::string& text);
[[nodiscard]] std::size_t line_at(const std::string& text, std::size_t offset);
// Every block, in the order of their ends. A brace heuristic, not a parser.
[[nodiscard]] std::vector<Block> blocks_of(const std::string& code);
// For each line, the kind of the innermost block that it begins in (kNamespace outside all).
[[nodiscard]] std::vector<BlockKind> block_at_lines(const std::string& code);

// Every file below `root` that belongs to the tree: no build, no run, nothing of git.
[[nodiscard]] std::vector<SourceFile> read_tree(const std::filesystem::path& root);

}  // namespace lodesman::tidy
