// SPDX-License-Identifier: Apache-2.0
// Whether a package of npm's that a test wants is installed.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <string>

#include "tests/support/catch.h"
#include "tests/support/data_dir.h"

namespace lodesman::testing {

inline constexpr const char* kNodePackagesBy = "tests/support/install_node_packages.sh";

// `packages`: where that script has put what a test uses. With CI=true it has to be there, unless
// .ci/run has said that npm's registry is not to be reached.
[[nodiscard]] inline bool has_node_package(const std::filesystem::path& packages,
                                           const std::string& name) {
  const bool here = std::filesystem::exists(packages / "node_modules" / name);
  if (!here && data_is_required() && std::getenv("LODESMAN_WITHOUT_NPM") == nullptr) {
    FAIL("CI=true, and no " << name << " is installed (" << kNodePackagesBy << ")");
  }
  return here;
}

// The same, for a test that is nothing without it: says that it is skipped, in the words by which
// ctest knows it.
[[nodiscard]] inline bool is_skipped_without(const std::filesystem::path& packages,
                                             const std::string& name) {
  const bool here = has_node_package(packages, name);
  if (!here) {
    std::cout << "skipped: no " << name << " is installed (" << kNodePackagesBy << ")\n";
  }
  return !here;
}

}  // namespace lodesman::testing
