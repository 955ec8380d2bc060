// SPDX-License-Identifier: Apache-2.0
#include "deploy/boat/failsafes.h"

#include <algorithm>
#include <fstream>
#include <string>

#include "deploy/boat/configuration.h"
#include "tests/support/catch.h"

using namespace lodesman;

TEST_CASE("docs: the table of failsafes is the program's own", "[docs]") {
  std::ifstream file{LODESMAN_DOCS "/operations.md"};
  std::vector<std::string> rows;
  std::string line;
  while (std::getline(file, line) && line != "<!-- failsafes begin -->") {
  }
  while (std::getline(file, line) && line != "<!-- failsafes end -->") {
    rows.push_back(line);
  }
  CHECK(rows == failsafe_rows());
}

TEST_CASE("failsafes: a gap between fixes is as long as the shipped configuration says",
          "[deploy][boat]") {
  const Duration gap = load_configuration("default", {}).high.estimator.filter.gate.longest_gap;
  const auto all = failsafes();
  CHECK(std::any_of(all.begin(), all.end(), [gap](const Failsafe& failsafe) {
    return std::string{failsafe.what}.starts_with("believed fix") && failsafe.after == gap;
  }));
}
