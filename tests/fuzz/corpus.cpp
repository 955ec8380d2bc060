// SPDX-License-Identifier: Apache-2.0
// Every seed of every target, and a fixed number of mutations of each: accepted, or refused as
// documented.
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/fuzz/mutation.h"
#include "tests/fuzz/targets.h"
#include "tests/support/catch.h"
#include "tests/support/text_of.h"

namespace lodesman::fuzz {
namespace {

namespace fs = std::filesystem;
using testing::text_of;

const fs::path kTree = LODESMAN_SOURCE_DIR;

[[nodiscard]] std::vector<fs::path> files_of(const fs::path& directory) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator{directory}) {
    files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

[[nodiscard]] std::vector<fs::path> seed_files(const Target& target) {
  std::vector<fs::path> files = files_of(kTree / "tests/fuzz/corpus" / target.name);
  if (!target.shipped.empty()) {
    const std::vector<fs::path> shipped = files_of(kTree / target.shipped);
    files.insert(files.end(), shipped.begin(), shipped.end());
  }
  return files;
}

void run(const Target& target, const std::string& input, const std::string& name) {
  INFO(name);
  try {
    target.run(input);
  } catch (const std::exception& error) {
    FAIL_CHECK(error.what() << "; the input:\n" << input);
  }
}

void run_all(std::string_view name) {
  const auto target = std::ranges::find(targets(), name, &Target::name);
  REQUIRE(target != targets().end());
  const std::vector<fs::path> files = seed_files(*target);
  REQUIRE(files.size() >= 5);
  std::vector<std::string> seeds;
  std::ranges::transform(files, std::back_inserter(seeds), text_of);
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    const std::string file = files[i].filename().string();
    run(*target, seeds[i], file);
    std::mt19937_64 chance{i};
    for (std::size_t n = 0; n < target->mutations / LODESMAN_ONE_OF_MUTATIONS; ++n) {
      run(*target, mutated(seeds[i], seeds, chance), file + ", mutation " + std::to_string(n));
    }
  }
}

TEST_CASE("fuzz corpus: command lines", "[fuzz]") { run_all("command_line"); }
TEST_CASE("fuzz corpus: configurations", "[fuzz]") { run_all("configuration"); }
TEST_CASE("fuzz corpus: what a sonar says", "[fuzz]") { run_all("delta_t"); }
TEST_CASE("fuzz corpus: frames of plan", "[fuzz]") { run_all("frames"); }
TEST_CASE("fuzz corpus: handshakes and sealed lines", "[fuzz]") { run_all("handshake"); }
TEST_CASE("fuzz corpus: images of segment", "[fuzz]") { run_all("image"); }
TEST_CASE("fuzz corpus: answers of a maestro", "[fuzz]") { run_all("maestro"); }
TEST_CASE("fuzz corpus: maps of plan", "[fuzz]") { run_all("map"); }
TEST_CASE("fuzz corpus: queries on a map", "[fuzz]") { run_all("map_queries"); }
TEST_CASE("fuzz corpus: messages in shared memory", "[fuzz]") { run_all("message"); }
TEST_CASE("fuzz corpus: what an AHRS says", "[fuzz]") { run_all("nav440"); }
TEST_CASE("fuzz corpus: answers of a roboclaw", "[fuzz]") { run_all("roboclaw"); }
TEST_CASE("fuzz corpus: scenarios", "[fuzz]") { run_all("scenario"); }
TEST_CASE("fuzz corpus: segment headers", "[fuzz]") { run_all("segment_header"); }
TEST_CASE("fuzz corpus: settings of the command line", "[fuzz]") { run_all("setting"); }
TEST_CASE("fuzz corpus: what is said to thrusters", "[fuzz]") { run_all("thruster_lines"); }

TEST_CASE("fuzz corpus: every folder of seeds has its target", "[fuzz]") {
  for (const fs::path& folder : files_of(kTree / "tests/fuzz/corpus")) {
    CHECK(std::ranges::count(targets(), folder.filename().string(), &Target::name) == 1);
  }
}

}  // namespace
}  // namespace lodesman::fuzz
