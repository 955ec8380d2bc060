// SPDX-License-Identifier: Apache-2.0
// Decisions made again from recordings of runs in lock-step: none differs.
#include "tests/system/replayed.h"

using namespace lodesman;
using namespace lodesman::testing;

TEST_CASE("replay: of every shipped scenario, in both profiles, no decision differs", "[system]") {
  const Scratch scratch{"replay"};
  const fs::path shipped = share_directory() / "hal_sim" / "scenarios";
  int runs = 0;
  for (const auto& entry : fs::directory_iterator{shipped}) {
    for (const char* profile : {"default", "paper"}) {
      const std::string name = entry.path().stem().string();
      INFO(name << ", " << profile);
      const fs::path file = sailed(scratch, name, profile);
      check_that_none_differs(replayed(file));
      fs::remove(file);
      ++runs;
    }
  }
  CHECK(runs >= 48);
}

TEST_CASE("replay: with threads' jitter, doubt about tracks and another position, none differs",
          "[system]") {
  const Scratch scratch{"replay"};
  for (const char* source : {"gps", "dead_reckoning"}) {
    INFO(source);
    check_that_none_differs(replayed(
        sailed(scratch, "twenty-movers", "default",
               {"simulation.lockstep_jitter_s=0.003", "tracks.dropout=0.3",
                "tracks.place_sigma_m=0.2", std::string{"estimator.position_source="} + source},
               30.0)));
  }
}
