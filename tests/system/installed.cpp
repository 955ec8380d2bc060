// SPDX-License-Identifier: Apache-2.0
// What `cmake --install` puts somewhere runs there, and knows nothing of where it was built.
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/system/program.h"

using namespace lodesman::testing;

namespace {

// The exit status of a program that is found by its name.
int run(const fs::path& program, const std::vector<std::string>& arguments) {
  Program child{program, arguments};
  return child.status();
}

}  // namespace

TEST_CASE("installed: programs find what is shared beside themselves, and sail", "[system]") {
  const Scratch scratch{"installed"};
  const fs::path prefix = scratch.file("prefix");
  REQUIRE(run(LODESMAN_CMAKE, {"--install", LODESMAN_BUILD_DIR, "--prefix", prefix.string()}) == 0);
  for (const char* name : {"lodesman", "lodesman-low", "lodesman-high", "lodesman-recorder",
                           "lodesman-console", "lodesman-bench", "lodesman-devices"}) {
    CHECK(run(prefix / "bin" / name, {"--version"}) == 0);
  }
  CHECK(fs::exists(prefix / "share" / "doc" / "lodesman" / "README.md"));
  CHECK(fs::exists(prefix / "lib" / "systemd" / "system" / "lodesman-low.service"));
  const fs::path out = scratch.file("run");
  CHECK(run(prefix / "bin" / "lodesman",
            {"sim", "paper-static", "--lockstep", "--quiet", "--out", out.string()}) == 0);
  CHECK(nlohmann::json::parse(std::ifstream{out / "result.json"})["outcome"] == "goal");
  CHECK(fs::exists(out / "heading.png"));
}

TEST_CASE(
    "installed: without lodesman-bench a boat has its words, and is told where the others are",
    "[system]") {
  const Scratch scratch{"boat-alone"};
  const fs::path program = scratch.file("lodesman");
  fs::copy_file(program_directory() / "lodesman", program);
  CHECK(run(program, {"--help"}) == 0);
  CHECK(run(program, {"sim", "--help"}) == 2);
  CHECK(run(program, {"simulate"}) == 2);
}
