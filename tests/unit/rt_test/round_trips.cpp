// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/rt_test/round_trips.h"

#include "deploy/boat/configuration.h"
#include "hal_sim/scenario/scenario.h"
#include "tests/support/catch.h"

namespace lodesman::cli {

TEST_CASE("round trips: every length is a scenario that lasts longer", "[operator][rt_test]") {
  const BoatConfig configuration = load_configuration("default", {});
  for (const double seconds : {5.0, 60.0, 599.9, kLongestRoundTrips_s}) {
    CAPTURE(seconds);
    const Scenario scenario =
        read_scenario(TomlDocument::from_text(round_trips_scenario(seconds), "round trips"),
                      configuration.speeds);
    CHECK(scenario.obstacles.size() == 4);
    CHECK(scenario.time_limit_s > seconds);
    double way_m = 0.0;
    WorldPoint at = scenario.mission.start.p_WV;
    for (const Goal& goal : scenario.mission.waypoints()) {
      const WorldPoint to{{goal.x_m, goal.y_m}};
      way_m += (to.xy_m - at.xy_m).norm();
      at = to;
    }
    CHECK(way_m / scenario.speed_m_s > seconds);
  }
}

}  // namespace lodesman::cli
