// SPDX-License-Identifier: Apache-2.0
// Bytes as a file that readers can open by its path, kept in memory: nothing touches a disk.
#pragma once

#include <filesystem>
#include <string_view>

namespace lodesman::fuzz {

class OutsideFile {
 public:
  explicit OutsideFile(std::string_view bytes);
  OutsideFile(const OutsideFile&) = delete;
  OutsideFile& operator=(const OutsideFile&) = delete;
  ~OutsideFile();

  [[nodiscard]] std::filesystem::path path() const;

 private:
  int descriptor_;
};

}  // namespace lodesman::fuzz
