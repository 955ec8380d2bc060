// SPDX-License-Identifier: Apache-2.0
#include "deploy/boat/failsafes.h"

#include <fstream>

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
