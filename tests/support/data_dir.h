// SPDX-License-Identifier: Apache-2.0
// Finds the real data that tests may use, which is never part of this repository.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <string_view>

#include "tests/support/catch.h"

namespace lodesman::testing {

// Whether CI=true: there, data that is absent is a failure.
[[nodiscard]] inline bool data_is_required() {
  const char* ci = std::getenv("CI");
  return ci != nullptr && std::string_view{ci} == "true";
}

// The path of `relative` below LODESMAN_DATA_DIR (or the build's default). Where it is absent,
// prints why the calling test is skipped, in the words by which ctest knows it, and gives nothing.
[[nodiscard]] inline std::optional<std::filesystem::path> data_path(const std::string& relative) {
  const char* named = std::getenv("LODESMAN_DATA_DIR");
  const char* fallback = std::getenv("LODESMAN_DATA_DIR_DEFAULT");
  const std::filesystem::path root = named != nullptr && *named != '\0' ? named
                                     : fallback != nullptr              ? fallback
                                                                        : "../shared/data";
  if (std::filesystem::exists(root / relative)) {
    return root / relative;
  }
  const std::string absent = "no " + (root / relative).string() + " (set LODESMAN_DATA_DIR)";
  if (data_is_required()) {
    FAIL("CI=true, and there is " << absent);
  }
  std::cout << "skipped: " << absent << "\n";
  return std::nullopt;
}

}  // namespace lodesman::testing
