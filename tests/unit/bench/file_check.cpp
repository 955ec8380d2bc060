// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/bench/file_check.h"

#include <cstdlib>

#include "deploy/boat/configuration.h"
#include "tests/support/catch.h"
#include "tests/support/text_file.h"

namespace lodesman::testing {
namespace {

using namespace cli;

[[nodiscard]] std::string shipped(const std::string& file) {
  return (share_directory() / file).string();
}

TEST_CASE("check: shipped files are right, each as what it is", "[cli]") {
  const FileCheck scenario = check_file(shipped("hal_sim/scenarios/paper-static.toml"), {});
  REQUIRE(scenario.error.empty());
  REQUIRE(scenario.kind == "scenario");
  const FileCheck overlay = check_file(shipped("deploy/config/paper.toml"), {});
  REQUIRE(overlay.error.empty());
  REQUIRE(overlay.kind == "configuration");
  const FileCheck boat = check_file(shipped("deploy/config/boat.toml"), {});
  REQUIRE(boat.error.empty());
  REQUIRE(boat.kind == "configuration");
  const FileCheck vessel = check_file(shipped("hal_sim/vessels/paper-asv.toml"), {});
  REQUIRE(vessel.error.empty());
  REQUIRE(vessel.kind == "vessel");
  const auto json = overlay.to_json();
  REQUIRE(json.at("ok") == true);
  REQUIRE(json.at("error").is_null());
}

TEST_CASE("check: a wrong file is refused by line and key", "[cli]") {
  const auto refused = [](const std::string& text, const std::string& kind) {
    const TextFile file{"a.toml", text};
    const FileCheck result = check_file(file.path().string(), {});
    REQUIRE(result.kind == kind);
    REQUIRE(result.to_json().at("ok") == false);
    return result.error.substr(std::min(result.error.size(), file.path().string().size() + 1));
  };
  REQUIRE(refused("[zones]\n\nmargin = 1.0\n", "configuration") == "3: zones.margin: unknown key");
  REQUIRE(refused("[zones]\nmargin_m = 'x'\n", "configuration") ==
          "2: zones.margin_m: must be a number");
  REQUIRE(refused("[vehicle]\nhull_beam_m = 'x'\n", "configuration") ==
          "2: vehicle.hull_beam_m: must be a number");
  REQUIRE(refused("[mission]\nstart_m = [0.0, 0.0]\n", "scenario").find(": missing") !=
          std::string::npos);
  REQUIRE(refused("[vehicle]\nsurge_ref = 16\n", "scenario").find(": missing") !=
          std::string::npos);
  REQUIRE(refused("[simulation]\nscenario = 'paper-static'\nhull = 'nosuch'\n", "configuration") ==
          "3: simulation.hull: \"nosuch\" is neither a shipped hull (paper-asv, otter) nor a file");
  REQUIRE(
      refused("[vessel]\nmass_kg = -95.0\n", "vessel").starts_with("2: vessel.mass_kg: must be"));
  REQUIRE(refused("[mission\n", "unknown").starts_with("1: toml: "));
}

TEST_CASE("check: a file that is not there is of no kind", "[cli]") {
  const FileCheck result = check_file("/nowhere/a.toml", {});
  REQUIRE(result.kind == "unknown");
  REQUIRE(result.error == "/nowhere/a.toml:1: file: cannot be read");
}

TEST_CASE("check: what is given besides must be right for every command", "[cli]") {
  CommonOptions common;
  REQUIRE_NOTHROW(refuse_bad_configuration(common));
  common.sets.emplace_back("zones.margin_m=2.0");
  REQUIRE_NOTHROW(refuse_bad_configuration(common));
  common.sets.emplace_back("zones.margin=2.0");
  REQUIRE_THROWS_AS(refuse_bad_configuration(common), StartupError);
}

}  // namespace
}  // namespace lodesman::testing
