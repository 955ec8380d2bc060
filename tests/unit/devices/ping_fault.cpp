// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/sonar/ping_fault.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <set>

#include "hal_sim/devices/sim_sonar.h"
#include "low_level/sonar/ping_watch.h"
#include "tests/support/allocations.h"
#include "tests/support/catch.h"
#include "tests/support/speckled_water.h"
#include "tests/unit/devices/support.h"

namespace lodesman {
namespace {

using testing::HandWorld;
using testing::SpeckledWater;

[[nodiscard]] Fault echo_fault(FaultKind kind, double value = 0.0) {
  return {FaultDevice::kSonar, kind, 0.0, 1e5, 0.0, value};
}

struct AlteredPing {
  std::unique_ptr<SonarPing> ping = std::make_unique<SonarPing>();
  SpeckledWater water;
  PingFault fault;

  explicit AlteredPing(std::uint64_t seed = 1) : fault{seed} {
    ping->range_m = 30.0;
    ping->make_image(120, 500, to_rad(120.0));
  }
  void alter(const Fault& by, double thrust_load = 0.0) {
    water.fill(*ping);
    fault.alter(by, thrust_load, image_of(*ping));
  }
  [[nodiscard]] double mean(std::uint32_t beam, double from_m, double to_m) {
    double sum = 0.0;
    double count = 0.0;
    testing::for_cells(*ping, beam, from_m, to_m, [&](std::uint8_t& echo) {
      sum += echo;
      count += 1.0;
    });
    return sum / count;
  }
  [[nodiscard]] std::vector<std::uint8_t> echoes() const {
    return {ping->echo.begin(), ping->echo.begin() + ping->echo_count};
  }
};

TEST_CASE("ping fault: a saturated ping is all but white", "[hal_sim][devices]") {
  AlteredPing altered;
  altered.alter(echo_fault(FaultKind::kSaturated));
  const auto echoes = altered.echoes();
  CHECK(*std::min_element(echoes.begin(), echoes.end()) >= 240);
  CHECK(std::set<std::uint8_t>{echoes.begin(), echoes.end()}.size() > 5);
  altered.alter(echo_fault(FaultKind::kSaturated));
  CHECK(altered.echoes() != echoes);
}

TEST_CASE("ping fault: a frozen image comes again until the fault ends", "[hal_sim][devices]") {
  AlteredPing altered;
  altered.alter({});
  const auto before = altered.echoes();
  altered.alter(echo_fault(FaultKind::kFrozen));
  const auto frozen = altered.echoes();
  CHECK(frozen != before);
  for (int i = 0; i < 5; ++i) {
    altered.alter(echo_fault(FaultKind::kFrozen));
    CHECK(altered.echoes() == frozen);
  }
  altered.alter({});
  CHECK(altered.echoes() != frozen);
  altered.alter(echo_fault(FaultKind::kFrozen));
  CHECK(altered.echoes() != frozen);  // another one
}

TEST_CASE("ping fault: blinded is the sector ahead, as wide as it says", "[hal_sim][devices]") {
  for (const double width_deg : {10.0, 40.0, 360.0}) {
    AlteredPing altered;
    altered.alter(echo_fault(FaultKind::kBlinded, width_deg));
    for (std::uint32_t beam = 0; beam < 120; ++beam) {
      const bool is_blind = std::abs(altered.ping->bearing_rad(beam)) <= to_rad(width_deg) / 2.0;
      CHECK((altered.mean(beam, 0.0, 30.0) > 0.0) == !is_blind);
    }
  }
}

TEST_CASE("ping fault: weed is a haze on a third of the head with nothing behind it",
          "[hal_sim][devices]") {
  std::set<std::uint32_t> begins;
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
    AlteredPing altered{seed};
    altered.alter(echo_fault(FaultKind::kWeed));
    std::uint32_t covered = 0;
    for (std::uint32_t beam = 0; beam < 120; ++beam) {
      if (altered.mean(beam, 1.6, 30.0) > 0.0) {
        CHECK(altered.mean(beam, 0.0, 1.4) < 10.0);
        continue;
      }
      CHECK(altered.mean(beam, 0.0, 1.4) > 100.0);
      if (covered++ == 0) {
        begins.insert(beam);
      }
    }
    CHECK(covered == 40);
  }
  CHECK(begins.size() > 1);  // where it hangs is the seed's
}

TEST_CASE("ping fault: interference grows with the thrust", "[hal_sim][devices]") {
  AlteredPing altered;
  const Fault fault = echo_fault(FaultKind::kInterference, 120.0);
  altered.alter(fault, 0.0);
  const auto bright = [&altered] {
    const auto echoes = altered.echoes();
    return std::count_if(echoes.begin(), echoes.end(), [](std::uint8_t e) { return e > 60; });
  };
  CHECK(bright() == 0);
  altered.alter(fault, 0.3);
  const auto at_less = bright();
  altered.alter(fault, 1.0);
  CHECK(bright() > 2000);
  CHECK(bright() > 5 * at_less);
}

TEST_CASE("ping fault: any geometry is taken, other kinds alter nothing, nothing is allocated",
          "[hal_sim][devices]") {
  AlteredPing altered;
  const testing::AllocationScope scope;
  for (const std::uint32_t beams : {1U, 7U, 512U}) {
    for (const std::uint32_t bins : {1U, 100U, 1000U}) {
      altered.ping->make_image(beams, bins, 2.0);
      for (const FaultKind kind : {FaultKind::kSaturated, FaultKind::kFrozen, FaultKind::kBlinded,
                                   FaultKind::kWeed, FaultKind::kInterference}) {
        altered.fault.alter(echo_fault(kind, 50.0), 1.0, image_of(*altered.ping));
      }
    }
  }
  const std::uint64_t allocations = scope.count();
  CHECK(allocations == 0);
  altered.alter({});
  const auto before = altered.echoes();
  altered.fault.alter(echo_fault(FaultKind::kStall), 1.0, image_of(*altered.ping));
  altered.ping->kind = PingKind::kProfile;
  altered.fault.alter(echo_fault(FaultKind::kSaturated), 1.0, image_of(*altered.ping));
  CHECK(altered.echoes() == before);
}

TEST_CASE("ping fault: each kind is recognised for what it is", "[hal_sim][devices]") {
  struct Case {
    FaultKind kind;
    double value;
    PingTrouble trouble;
  };
  for (const Case& one : {Case{FaultKind::kSaturated, 0.0, PingTrouble::kSaturated},
                          Case{FaultKind::kFrozen, 0.0, PingTrouble::kFrozen},
                          Case{FaultKind::kBlinded, 40.0, PingTrouble::kBlindSector},
                          Case{FaultKind::kBlinded, 120.0, PingTrouble::kDeaf},
                          Case{FaultKind::kWeed, 0.0, PingTrouble::kWeed},
                          Case{FaultKind::kInterference, 120.0, PingTrouble::kInterference}}) {
    AlteredPing altered;
    const auto watch = std::make_unique<PingWatch>();
    const auto look = [&](const Fault& fault, int pings) {
      for (int i = 0; i < pings; ++i) {
        altered.alter(fault, 0.5);
        watch->look(*altered.ping);
      }
      return watch->trouble();
    };
    CAPTURE(name_of(one.kind));
    CHECK(look({}, 30) == PingTrouble::kNone);
    CHECK(look(echo_fault(one.kind, one.value), 15) == one.trouble);
    CHECK(look({}, 30) == PingTrouble::kNone);
  }
}

TEST_CASE("sim sonar: faults of its echoes alter its pings while numbers and times go on",
          "[hal_sim][devices]") {
  HandWorld world;
  Scenario scenario;
  MovingObstacle stone;
  stone.at_start.centre_y_m = 10.0;
  stone.at_start.semi_axis_first_m = stone.at_start.semi_axis_second_m = 2.0;
  stone.velocity_y_m_s = 1.0;
  scenario.obstacles = {stone};
  scenario.faults = {{FaultDevice::kSonar, FaultKind::kBlinded, 1.0, 1.0, 0.0, 60.0},
                     {FaultDevice::kSonar, FaultKind::kFrozen, 2.0, 1.0}};
  SimSonar sonar{scenario, world.link()};
  const auto ping = std::make_unique<SonarPing>();
  std::set<std::uint64_t> numbers;
  std::set<std::vector<std::uint8_t>> frozen;
  std::size_t frozen_pings = 0;
  for (int step = 0; step < 200; ++step) {
    world.step();
    if (sonar.poll(world.now(), *ping) != ReadStatus::kFresh) {
      continue;
    }
    CHECK(numbers.insert(ping->number).second);
    CHECK(ping->captured == world.now());
    const std::vector<std::uint8_t> echo{ping->echo.begin(), ping->echo.begin() + 120 * 500};
    const double time_s = world.state.scenario_time_s;
    const bool is_heard = std::any_of(echo.begin() + 58 * 500, echo.begin() + 62 * 500,
                                      [](std::uint8_t e) { return e != 0; });
    CHECK(is_heard == (time_s < 1.0 || time_s >= 2.0));
    if (time_s >= 2.0 && time_s < 3.0) {
      frozen.insert(echo);
      ++frozen_pings;
    }
  }
  CHECK(numbers.size() == 40);
  CHECK(frozen_pings >= 9);
  CHECK(frozen.size() == 1);
}

}  // namespace
}  // namespace lodesman
