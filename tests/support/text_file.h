// SPDX-License-Identifier: Apache-2.0
// A small file for one test, and what a refusal of it says. Test threads only.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "mid_level/base/startup_error.h"
#include "tests/unit/report/temporary_directory.h"

namespace lodesman::testing {

class TextFile {
 public:
  TextFile(const std::string& name, const std::string& text) : path_{directory_.path() / name} {
    std::ofstream{path_, std::ios::binary} << text;
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  TemporaryDirectory directory_;
  std::filesystem::path path_;
};

// The refusal without the path of the file: "2: width: must be ..."; empty where there is none.
template <class Read>
[[nodiscard]] std::string refusal_of(const TextFile& file, Read read) {
  try {
    (void)read(file.path());
  } catch (const StartupError& error) {
    const std::string prefix = file.path().string() + ":";
    const std::string line = error.what();
    return line.starts_with(prefix) ? line.substr(prefix.size()) : "no file named: " + line;
  }
  return {};
}

}  // namespace lodesman::testing
