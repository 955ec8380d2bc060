// SPDX-License-Identifier: Apache-2.0
// The black box on the real drivers, against devices that are emulated to the byte.
#include "tests/support/catch.h"
#include "tests/system/program.h"
#include "tests/system/recording_contents.h"

using namespace lodesman;
using namespace lodesman::testing;

TEST_CASE("recorder: a run on emulated devices is recorded whole", "[system]") {
  const Scratch scratch{"recorder"};
  const auto scenario = scratch.file("scenario.toml", scenario_text(80.0));
  const fs::path out = scratch.file("run");
  auto arguments =
      sim(scenario, out,
          {"--record", "--quiet", "--time-limit", "20", "--set", "recorder.free_floor_mib=0"});
  arguments.front() = "hil";
  Program run{program("lodesman"), arguments};
  CHECK(run.status() == 1);  // the time limit
  const Contents contents = contents_of(out / "mission.mcap");
  CHECK(contents.ending == McapEnding::kWhole);
  check_told(contents);
  CHECK(contents.count("raw/attitude") > 0);
  CHECK(contents.count("raw/sonar_ping") > 0);
  CHECK(contents.count("raw/thrust_applied") > 0);
}
