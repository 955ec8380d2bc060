// SPDX-License-Identifier: Apache-2.0
// What the shipped detector makes of pings in noisy water.
#include <cmath>
#include <memory>

#include "low_level/sonar/contrast.h"
#include "tests/support/catch.h"
#include "tests/support/noisy_pings.h"
#include "tests/unit/sonar/synthetic.h"

namespace lodesman {
namespace {

using testing::ellipse_at;
using testing::NoisyPings;
using testing::touches;
using testing::wall_through;

struct Seen {
  double found = 0.0;   // share of the pings
  double others = 0.0;  // obstacles a ping
};

[[nodiscard]] Seen look(const WaterKind& kind, const std::vector<MovingObstacle>& scene) {
  constexpr int kSeeds = 16;
  constexpr int kPings = 40;
  ContrastDetector detector{testing::shipped_options()};
  const auto seen = std::make_unique<SonarObstacles>();
  int found = 0;
  int others = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    NoisyPings water{kind, scene, seed};
    water.go_on(testing::kUntilUsual);
    for (int i = 0; i < kPings; ++i) {
      detector.detect(water.next(), *seen);
      bool is_found = false;
      for (std::uint32_t k = 0; k < seen->count; ++k) {
        const bool is_there = !scene.empty() && touches(seen->obstacles[k], scene.front().at_start);
        is_found = is_found || is_there;
        others += is_there ? 0 : 1;
      }
      found += is_found ? 1 : 0;
    }
  }
  return {found / double{kSeeds * kPings}, others / double{kSeeds * kPings}};
}

TEST_CASE("noisy water: a disc is found in nine pings of ten, 10 to 20 m off", "[hal_sim][sonar]") {
  for (const double range_m : {10.0, 15.0, 20.0}) {
    for (const double radius_m : {0.5, 1.0}) {
      const double bearing_rad = to_rad(2.5 * range_m - 40.0);
      CAPTURE(range_m, radius_m);
      CHECK(look(kSeaWater, {ellipse_at(range_m * std::sin(bearing_rad),
                                        range_m * std::cos(bearing_rad), radius_m, radius_m)})
                .found >= 0.9);
    }
  }
}

TEST_CASE("noisy water: a wall is found in nine pings of ten, 10 to 20 m off", "[hal_sim][sonar]") {
  for (const double range_m : {10.0, 15.0, 20.0}) {
    CAPTURE(range_m);
    const auto wall = wall_through({{-40.0, range_m + 3.0}, {40.0, range_m - 3.0}});
    CHECK(look(kSeaWater, {wall}).found >= 0.9);
    CHECK(look(kTankWater, {wall}).found >= 0.9);
  }
}

TEST_CASE("noisy water: empty water shows obstacles now and then, as real frames do",
          "[hal_sim][sonar]") {
  const Seen sea = look(kSeaWater, {});
  CHECK(sea.others > 0.02);
  CHECK(sea.others < 0.3);
  CHECK(look(kTankWater, {}).others < 0.1);
}

}  // namespace
}  // namespace lodesman
