// SPDX-License-Identifier: Apache-2.0
// Files of a run directory: whatever happens to the program or the disk, what stands there is
// whole. One thread.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "mid_level/base/time.h"

namespace lodesman::cli {

// Where a file is made before it takes its name.
[[nodiscard]] std::filesystem::path unfinished(const std::filesystem::path& path);

// All of the text under that name, or nothing new there and a StartupError that says why.
void write_whole_file(const std::filesystem::path& path, std::string_view text);

// A file whose room is taken before others fill the disk. Until it is written there is no file of
// that name, and afterwards it is whole.
class ReservedFile {
 public:
  // Throws StartupError when there is no such room.
  ReservedFile(std::filesystem::path path, std::size_t bytes);
  ReservedFile(const ReservedFile&) = delete;
  ReservedFile& operator=(const ReservedFile&) = delete;
  ~ReservedFile();

  // Once. Throws StartupError when it cannot be written, which leaves no file.
  void write(std::string_view text);

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
};

// Lines that are written while they come, every second or in larger pieces. The file ends after a
// whole line; the first failure is kept and is the end of it.
class LineFile {
 public:
  // An empty file; StartupError when it cannot be made.
  explicit LineFile(std::filesystem::path path);
  LineFile(const LineFile&) = delete;
  LineFile& operator=(const LineFile&) = delete;
  ~LineFile();

  void add(std::string_view line);  // with its line end
  void flush();
  // One line that says why not all is written; empty as long as all is.
  [[nodiscard]] const std::string& fault() const noexcept { return fault_; }

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::string waiting_;
  std::string fault_;
  Time flushed_{};
};

}  // namespace lodesman::cli
