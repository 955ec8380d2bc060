// SPDX-License-Identifier: Apache-2.0
#include "tests/support/data_dir.h"

#include <sys/wait.h>

#include <array>
#include <cstdio>

namespace lodesman::testing {
namespace {

struct Outcome {
  int status = -1;
  std::string said;
};

// Runs this program's hidden test, which asks for data that nobody has, in such an environment.
[[nodiscard]] Outcome ask_for_absent_data(const std::string& environment) {
  const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
  const std::string command = environment + " '" + program + "' '[.absent]' 2>&1";
  FILE* pipe = popen(command.c_str(), "r");
  REQUIRE(pipe != nullptr);
  Outcome outcome;
  std::array<char, 256> some{};
  while (const auto size = std::fread(some.data(), 1, some.size(), pipe)) {
    outcome.said.append(some.data(), size);
  }
  outcome.status = WEXITSTATUS(pclose(pipe));
  return outcome;
}

TEST_CASE("a test of absent data", "[.absent]") {
  CHECK_FALSE(data_path("nobody-has-this").has_value());
}

TEST_CASE("data: a test without its data says so in the words that ctest counts as skipped",
          "[support]") {
  const Outcome outcome = ask_for_absent_data("CI= LODESMAN_DATA_DIR=/nowhere");
  CHECK(outcome.status == 0);
  CHECK(outcome.said.find("skipped: no /nowhere/nobody-has-this") != std::string::npos);
}

TEST_CASE("data: where CI is true a test without its data fails", "[support]") {
  const Outcome outcome = ask_for_absent_data("CI=true LODESMAN_DATA_DIR=/nowhere");
  CHECK(outcome.status != 0);
  CHECK(outcome.said.find("CI=true") != std::string::npos);
  CHECK(outcome.said.find("skipped:") == std::string::npos);
}

}  // namespace
}  // namespace lodesman::testing
