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
  for (const char* name : {"lodesman", "lodesman-low", "lodesman-high"}) {
    CHECK(run(prefix / "bin" / name, {"--version"}) == 0);
  }
  CHECK(fs::exists(prefix / "share" / "doc" / "lodesman" / "README.md"));
  const fs::path out = scratch.file("run");
  CHECK(run(prefix / "bin" / "lodesman",
            {"sim", "paper-static", "--lockstep", "--quiet", "--out", out.string()}) == 0);
  CHECK(nlohmann::json::parse(std::ifstream{out / "result.json"})["outcome"] == "goal");
  CHECK(fs::exists(out / "heading.png"));
}
