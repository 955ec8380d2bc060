// SPDX-License-Identifier: Apache-2.0
// Decisions made again from recordings of runs in lock-step: none differs.
#include "tests/system/replayed.h"

using namespace lodesman;
using namespace lodesman::testing;

namespace {

// By then each has planned round what it meets; `tests/measure/replay.sh` replays whole voyages.
constexpr double kFirst_s = 30.0;

void check_shipped_scenarios(const std::string& profile) {
  const Scratch scratch{"replay"};
  int runs = 0;
  for (const auto& entry : fs::directory_iterator{share_directory() / "hal_sim" / "scenarios"}) {
    const std::string name = entry.path().stem().string();
    INFO(name);
    const fs::path file = sailed(scratch, name, profile, {}, kFirst_s);
    check_that_none_differs(replayed(file));
    fs::remove(file);
    ++runs;
  }
  CHECK(runs >= 24);
}

}  // namespace

TEST_CASE("replay: of each shipped scenario in the default profile no decision differs",
          "[system]") {
  check_shipped_scenarios("default");
}

TEST_CASE("replay: of each shipped scenario in the paper profile no decision differs", "[system]") {
  check_shipped_scenarios("paper");
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
