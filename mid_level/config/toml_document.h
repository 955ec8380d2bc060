// SPDX-License-Identifier: Apache-2.0
// Strict TOML for configurations and scenarios: every key must be known, of the right type and in
// range, or start-up refuses with `file:line: key: reason`. One thread, before any task runs.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "mid_level/base/startup_error.h"
#include "mid_level/base/time.h"

namespace lodesman {

// The numbers a key may hold. All of them finite, whatever the range says.
struct Range {
  double min = -std::numeric_limits<double>::max();
  double max = std::numeric_limits<double>::max();
  bool min_excluded = false;

  [[nodiscard]] static constexpr Range any() noexcept { return {}; }
  [[nodiscard]] static constexpr Range between(double low, double high) noexcept {
    return {low, high, false};
  }
  [[nodiscard]] static constexpr Range above(double low, double high) noexcept {
    return {low, high, true};
  }
};

class TomlTable;

// A parsed file, or several laid over one another.
class TomlDocument {
 public:
  // The largest file that is read at all.
  static constexpr std::size_t kMaxBytes = 1U << 20U;

  [[nodiscard]] static TomlDocument from_file(const std::filesystem::path& path);
  // `name` stands for the file in messages.
  [[nodiscard]] static TomlDocument from_text(std::string_view text, const std::string& name);
  TomlDocument(const TomlDocument&) = delete;
  TomlDocument& operator=(const TomlDocument&) = delete;
  TomlDocument(TomlDocument&&) noexcept;
  TomlDocument& operator=(TomlDocument&&) noexcept;
  ~TomlDocument();

  // The values of `over` replace those of this document, which must have each of its keys.
  void overlay(TomlDocument over);

  [[nodiscard]] TomlTable root() const;
  // Refuses the first key that nothing has read: it is unknown or misspelt.
  void require_all_keys_read() const;
  // The document as one TOML text, to be recorded or handed to another process.
  [[nodiscard]] std::string to_text() const;

  struct Impl;

 private:
  explicit TomlDocument(std::unique_ptr<Impl> impl) noexcept;
  std::unique_ptr<Impl> impl_;
};

// A table of a document. Values are read by key and thereby known; a missing key is an error
// unless it is asked for with a value to use instead. Must not outlive its document.
class TomlTable {
 public:
  [[nodiscard]] bool empty() const noexcept;
  [[nodiscard]] bool has(std::string_view key) const;

  [[nodiscard]] double number(std::string_view key, Range range) const;
  [[nodiscard]] double number_or(std::string_view key, Range range, double otherwise) const;
  [[nodiscard]] std::int64_t integer(std::string_view key, std::int64_t min,
                                     std::int64_t max) const;
  [[nodiscard]] std::int64_t integer_or(std::string_view key, std::int64_t min, std::int64_t max,
                                        std::int64_t otherwise) const;
  [[nodiscard]] bool boolean(std::string_view key) const;
  [[nodiscard]] bool boolean_or(std::string_view key, bool otherwise) const;
  // Seconds in the file.
  [[nodiscard]] Duration duration(std::string_view key, Range seconds) const;
  // Of at least one character, unless `min_length` is 0.
  [[nodiscard]] std::string text(std::string_view key, std::size_t max_length,
                                 std::size_t min_length = 1) const;
  // A list of up to `max_count` texts, each of at least one character.
  [[nodiscard]] std::vector<std::string> texts(std::string_view key, std::size_t max_length,
                                               std::size_t max_count) const;
  // One of a few words; gives its index in `words`.
  [[nodiscard]] std::size_t choice(std::string_view key,
                                   std::initializer_list<std::string_view> words) const;
  [[nodiscard]] std::array<double, 2> pair(std::string_view key, Range range) const;
  [[nodiscard]] std::vector<std::array<double, 2>> pairs(std::string_view key, Range range,
                                                         std::size_t min_count,
                                                         std::size_t max_count) const;
  // Lists of points; one list alone is taken for a list of one.
  [[nodiscard]] std::vector<std::vector<std::array<double, 2>>> polygons(
      std::string_view key, Range range, std::size_t min_corners, std::size_t max_corners,
      std::size_t max_count) const;
  [[nodiscard]] TomlTable table(std::string_view key) const;
  // [[key]] tables; none when the key is absent.
  [[nodiscard]] std::vector<TomlTable> tables(std::string_view key, std::size_t max_count) const;

  // Refuses the value of `key` (or its absence, at this table's line) for a reason of the caller's.
  [[noreturn]] void refuse(std::string_view key, const std::string& reason) const;

 private:
  friend class TomlDocument;
  TomlTable(TomlDocument::Impl& document, const void* table, std::string path) noexcept;

  [[nodiscard]] const void* find(std::string_view key) const;
  [[nodiscard]] const void* require(std::string_view key) const;
  [[nodiscard]] std::string path_of(std::string_view key) const;

  TomlDocument::Impl* document_;
  const void* table_;  // a toml::table, kept out of this header
  std::string path_;   // "mission", "obstacle[2]"; empty at the root
};

}  // namespace lodesman
