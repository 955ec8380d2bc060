// SPDX-License-Identifier: Apache-2.0
// Finds the real data that tests may use, which is never part of this repository.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>

namespace lodesman::testing {

// The path of `relative` below LODESMAN_DATA_DIR (or the build's default). Where it is absent,
// prints why the calling test is skipped and gives nothing.
[[nodiscard]] inline std::optional<std::filesystem::path> data_path(const std::string& relative) {
  const char* named = std::getenv("LODESMAN_DATA_DIR");
  const char* fallback = std::getenv("LODESMAN_DATA_DIR_DEFAULT");
  const std::filesystem::path root = named != nullptr && *named != '\0' ? named
                                     : fallback != nullptr              ? fallback
                                                                        : "../shared/data";
  if (std::filesystem::exists(root / relative)) {
    return root / relative;
  }
  std::cout << "skipped: no " << (root / relative).string() << " (set LODESMAN_DATA_DIR)\n";
  return std::nullopt;
}

}  // namespace lodesman::testing
