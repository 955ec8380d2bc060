// SPDX-License-Identifier: Apache-2.0
// The guard with everything above it out of its mind, or dead: nothing that rests is touched, and a
// boat that nobody steers stops.
#include <cmath>
#include <string>

#include "deploy/boat/named_scenario.h"
#include "mid_level/config/toml_document.h"
#include "tests/support/catch.h"
#include "tests/system/full_ahead.h"

using namespace lodesman;
using namespace lodesman::testing;

namespace {

constexpr const char* kStone =
    "shape = \"circle\"\ncentre_m = [0.4, 9.0]\nradius_m = 0.5\nprotection_m = 3.0\n";
constexpr const char* kQuay =
    "shape = \"polyline\"\npoints_m = [[-12.0, 4.0], [12.0, 14.0]]\nprotection_m = 1.0\n";

[[nodiscard]] Scenario water(const BoatConfig& config, const std::string& obstacle,
                             const std::string& scene) {
  const std::string text =
      "name = \"guard\"\nseed = 1\ntime_limit_s = 1000.0\n[mission]\nstart_m = [0.0, 0.0]\n"
      "start_heading_deg = 0.0\ngoal_m = [0.0, 30.0]\ngoal_radius_m = 0.5\n[vehicle]\n"
      "speed_m_s = 0.22\nradius_m = 0.5\n" +
      (obstacle.empty() ? "" : "[[obstacle]]\n" + obstacle) + "[sonar]\nscene = \"" + scene +
      "\"\n";
  return read_scenario(TomlDocument::from_text(text, "water"), config.speeds);
}

[[nodiscard]] BoatConfig boat(std::vector<std::string> sets = {},
                              const std::string& profile = "default") {
  CommonOptions options;
  options.sets = std::move(sets);
  return load_configuration(profile, options);
}

}  // namespace

TEST_CASE("guard: full ahead at what rests touches nothing, at any speed", "[system]") {
  const BoatConfig config = boat();
  for (const std::string scene : {"obstacles", "beams", "detections"}) {
    for (const char* obstacle : {kStone, kQuay}) {
      for (const double speed_m_s : {0.22, 1.12}) {
        INFO(scene << ", " << obstacle << ", " << speed_m_s << " m/s");
        const int surge_ref = config.speeds.held(speed_m_s).surge_ref;
        const FullAheadEnd end = sail_full_ahead(config, water(config, obstacle, scene),
                                                 {surge_ref, 12.0 / speed_m_s + 10.0});
        CHECK(end.least_clearance_m > 0.0);
        CHECK(end.least_clearance_m < 1.0);
        CHECK(end.fastest_m_s > 0.9 * speed_m_s);
        CHECK(std::abs(end.speed_m_s) < 0.03);
        CHECK(end.guard.state == GuardState::kHolding);
        CHECK(end.guard.reason == GuardReason::kObstacle);
      }
    }
  }
}

TEST_CASE("guard: off in the paper profile the same boat is on the stone", "[system]") {
  const BoatConfig config = boat({}, "paper");
  const FullAheadEnd end = sail_full_ahead(config, water(config, kStone, "obstacles"), {57, 20.0});
  CHECK(end.least_clearance_m < 0.0);
  CHECK(end.guard.state == GuardState::kOff);
  CHECK(end.guard.trips == 0);
}

TEST_CASE("guard: with the high level dead at speed the boat stops, and not astern", "[system]") {
  const BoatConfig config = boat();
  const FullAhead order{91, 40.0, 20.0};
  const FullAheadEnd guarded = sail_full_ahead(config, water(config, "", "obstacles"), order);
  const BoatConfig off = boat({"guard.enabled=false"});
  const FullAheadEnd coasted = sail_full_ahead(off, water(off, "", "obstacles"), order);
  CHECK(guarded.guard.reason == GuardReason::kSilence);
  CHECK(guarded.guard.trips == 1);
  CHECK(guarded.way_m < coasted.way_m - 1.0);
  CHECK(std::abs(guarded.speed_m_s) < 0.03);
  CHECK(guarded.least_m_s > -0.06);
}
