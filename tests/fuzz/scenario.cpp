// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/scenario/scenario.h"

#include <cmath>

#include "hal_sim/world/world.h"
#include "mid_level/config/read_speed_table.h"
#include "tests/fuzz/oracle.h"
#include "tests/fuzz/targets.h"

namespace lodesman::fuzz {

void scenario(std::string_view input) {
  static const VesselParameters vessel =
      load_vessel(LODESMAN_SOURCE_DIR "/hal_sim/vessels/paper-asv.toml");
  static const SpeedTable speeds =
      read_speed_table(TomlDocument::from_file(LODESMAN_SOURCE_DIR "/deploy/config/default.toml")
                           .root()
                           .table("vehicle"));
  accepted_or_refused([&] {
    const Scenario scenario = read_scenario(TomlDocument::from_text(input, "s.toml"), speeds);
    require(scenario.obstacles.size() <= kMaxObstacles, "more obstacles than a frame holds");
    // What is accepted can be simulated.
    World world{scenario, vessel};
    for (const double time_s : {0.02, scenario.time_limit_s}) {
      world.step(0.02, time_s, {});
      const WorldTruth& truth = world.truth();
      require(std::isfinite(truth.x_m) && std::isfinite(truth.y_m) &&
                  std::isfinite(truth.heading_rad) && !std::isnan(truth.inoffensive_distance_m) &&
                  !std::isnan(truth.hull_clearance_m),
              "an accepted scenario cannot be simulated");
    }
  });
}

}  // namespace lodesman::fuzz
