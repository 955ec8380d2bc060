// SPDX-License-Identifier: Apache-2.0
// A Delta T aboard a vessel, behind datagrams in memory: what it hears, and what becomes of its
// datagrams on their way.
#include "hal_sim/emulators/emulated_sonar.h"

#include <cmath>
#include <memory>

#include "drivers/stream/memory_datagrams.h"
#include "tests/support/catch.h"
#include "tests/unit/emulators/support.h"

namespace lodesman {
namespace {

using namespace lodesman::testing;

[[nodiscard]] Scenario with_circle() {
  Scenario scenario;
  scenario.seed = 3;
  MovingObstacle mover;
  mover.at_start.centre_x_m = 0.0;
  mover.at_start.centre_y_m = 10.0;
  mover.at_start.semi_axis_first_m = mover.at_start.semi_axis_second_m = 1.0;
  scenario.obstacles = {mover};
  return scenario;
}

// The world's steps of 20 ms, and a host that takes what has come.
struct Listened {
  std::unique_ptr<MemoryDatagrams> datagrams = std::make_unique<MemoryDatagrams>();
  EmulatedSonar sonar;
  WorldSample world;
  std::int64_t ms = 0;
  std::vector<Bytes> heard;

  explicit Listened(const std::vector<Fault>& faults = {}, const Scenario& scenario = with_circle())
      : sonar{emulated_sonar_options(scenario), faults, at_ms(0)} {
    world.started = 1;
  }
  void run_until(std::int64_t until_ms) {
    for (; ms < until_ms; ms += 20) {
      world.stamp = at_ms(ms);
      world.scenario_time_s = static_cast<double>(ms) * 1e-3;
      sonar.feel(world, at_ms(ms));
      sonar.exchange(datagrams->far_end(), at_ms(ms));
      Bytes buffer(kLargestDatagram);
      for (auto came = datagrams->near_end().receive(buffer); came.any;
           came = datagrams->near_end().receive(buffer)) {
        heard.emplace_back(buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(came.size));
      }
    }
  }
  [[nodiscard]] std::vector<unsigned> numbers() const {
    std::vector<unsigned> all;
    for (const Bytes& record : heard) {
      all.push_back(record.size() > 96 ? (unsigned{record[95]} << 8U) | record[96] : 0);
    }
    return all;
  }
};

TEST_CASE("emulated sonar: it hears what is before the bow, as the scenario has it set",
          "[hal_sim][emulators]") {
  Listened listened;
  listened.run_until(1000);
  REQUIRE(listened.heard.size() == 10);  // each 50 ms after its ping
  const Bytes& image = listened.heard[0];
  REQUIRE(image.size() == 60256);
  const auto beam = [&image](std::size_t i) {
    return image.begin() + 256 + static_cast<std::ptrdiff_t>(i * 500);
  };
  CHECK(static_cast<int>(*(beam(60) + 150)) == 200);  // 9 m of 30
  CHECK(std::count(beam(0), beam(30), 0) == 30 * 500);
  // The heading and the place of the moment of the ping.
  Listened turned;
  turned.world.heading_rad = std::atan2(-5.0, 8.0);
  turned.world.x_m = 5.0;
  turned.world.y_m = 2.0;
  turned.run_until(100);
  REQUIRE(turned.heard.size() == 1);
  CHECK(((turned.heard[0][68] << 8U) | turned.heard[0][69]) == (0x8000 | 3280));
  CHECK(static_cast<int>(turned.heard[0][256 + 60 * 500 + 140]) == 200);  // sqrt(89) - 1 m
}

TEST_CASE("emulated sonar: what the host sends is obeyed", "[hal_sim][emulators]") {
  Listened listened;
  listened.run_until(200);
  Bytes frame =
      hex("45 43 00 01 00 00 00 03 0A 32 00 03 00 02 00 00 00 3A 98 03 01 01 00 1E 00 B4");
  frame.resize(256);
  CHECK(listened.datagrams->near_end().reply(frame));
  listened.run_until(600);
  CHECK(listened.sonar.device().settings().range_m == 10);
  CHECK(static_cast<int>(listened.heard.back()[80]) == 10);
  CHECK(static_cast<int>(listened.heard.back()[256 + 60 * 500 + 450]) == 200);  // 9 m of 10
}

TEST_CASE("emulated sonar: loss, doubles, ends cut off and overtaking, all counted",
          "[hal_sim][emulators]") {
  Listened lossy{{sonar_fault(FaultKind::kDrop, 0.2)}};
  lossy.run_until(40'020);
  const auto lost = lossy.sonar.network().injections().of(FaultKind::kDrop).count;
  CHECK(lost > 50);  // 80 of 400
  CHECK(lossy.heard.size() + lost == 400);

  Listened twice{{sonar_fault(FaultKind::kDuplicate, 0.2)}};
  twice.run_until(20'020);
  const auto doubles = twice.sonar.network().injections().of(FaultKind::kDuplicate).count;
  CHECK(doubles > 20);
  CHECK(twice.heard.size() == 200 + doubles);

  Listened cut{{sonar_fault(FaultKind::kCut, 0.2)}};
  cut.run_until(20'020);
  const auto cuts = cut.sonar.network().injections().of(FaultKind::kCut).count;
  CHECK(cuts > 20);
  CHECK(cut.heard.size() == 200);
  CHECK(static_cast<std::uint64_t>(
            std::count_if(cut.heard.begin(), cut.heard.end(),
                          [](const Bytes& record) { return record.size() < 60256; })) == cuts);

  Listened overtaken{{sonar_fault(FaultKind::kReorder, 0.2)}};
  overtaken.run_until(20'020);
  const auto numbers = overtaken.numbers();
  CHECK_FALSE(std::is_sorted(numbers.begin(), numbers.end()));
  auto sorted = numbers;
  std::sort(sorted.begin(), sorted.end());
  CHECK(std::unique(sorted.begin(), sorted.end()) == sorted.end());  // none twice
  CHECK(sorted.size() >= 198);                                       // and none lost but at the end
}

TEST_CASE("emulated sonar: silence and unplugging begin and end at their time",
          "[hal_sim][emulators]") {
  for (const FaultKind kind : {FaultKind::kStall, FaultKind::kDisconnect, FaultKind::kPower}) {
    Listened listened{{sonar_fault(kind, 0.0, 0.0, 1.0, 1.0)}};
    listened.run_until(1080);
    listened.heard.clear();
    listened.run_until(2000);
    CHECK(listened.heard.empty());
    listened.run_until(3000);
    CHECK(listened.heard.size() >= 9);
  }
}

TEST_CASE("emulated sonar: the same seed gives the same datagrams", "[hal_sim][emulators]") {
  const auto run = [](std::uint64_t seed) {
    Scenario scenario = with_circle();
    scenario.seed = seed;
    Listened listened{{sonar_fault(FaultKind::kDrop, 0.1), sonar_fault(FaultKind::kReorder, 0.1),
                       sonar_fault(FaultKind::kForeign, 3.0), sonar_fault(FaultKind::kRepeat, 0.1),
                       sonar_fault(FaultKind::kHang, 20.0), sonar_fault(FaultKind::kCut, 0.1)},
                      scenario};
    listened.run_until(10'000);
    return listened.heard;
  };
  const auto one = run(1);
  CHECK(one.size() > 30);
  CHECK(one == run(1));
  CHECK(one != run(2));
}

TEST_CASE("emulated sonar: one fault more moves no other", "[hal_sim][emulators]") {
  Listened alone{{sonar_fault(FaultKind::kDrop, 0.2)}};
  Listened beside{{sonar_fault(FaultKind::kDrop, 0.2), sonar_fault(FaultKind::kCut, 0.2)}};
  alone.run_until(10'000);
  beside.run_until(10'000);
  CHECK(beside.sonar.network().injections().of(FaultKind::kCut).count > 0);
  CHECK(alone.heard.size() == beside.heard.size());
}

TEST_CASE("emulated sonar: faults of what it hears are in the images that it sends",
          "[hal_sim][emulators]") {
  const auto cells_of = [](FaultKind kind, double value, std::size_t beam) {
    Listened listened{{sonar_fault(kind, 0.0, value)}};
    listened.world.thrust_load = 1.0;
    listened.run_until(500);
    REQUIRE(listened.heard.size() > 2);
    CHECK(listened.sonar.device().injections().of(kind).count == 1);
    const auto begin =
        listened.heard.back().begin() + 256 + static_cast<std::ptrdiff_t>(beam * 500);
    return Bytes{begin, begin + 500};
  };
  const auto lit = [](const Bytes& cells) {
    return std::count_if(cells.begin(), cells.end(), [](std::uint8_t e) { return e != 0; });
  };
  CHECK(lit(cells_of(FaultKind::kSaturated, 0.0, 5)) == 500);
  CHECK(lit(cells_of(FaultKind::kInterference, 100.0, 5)) > 300);
  CHECK(lit(cells_of(FaultKind::kFrozen, 0.0, 60)) == 4);  // the circle ahead
  CHECK(lit(cells_of(FaultKind::kBlinded, 20.0, 60)) == 0);
  const auto covered = [&](std::size_t beam) { return lit(cells_of(FaultKind::kWeed, 0.0, beam)); };
  CHECK(covered(0) + covered(39) + covered(79) + covered(119) >= 25);  // 1.5 m of 30
}

TEST_CASE("emulated sonar: profiles have no faults of images", "[hal_sim][emulators]") {
  EmulatedSonarOptions options = emulated_sonar_options(with_circle());
  options.program.settings.sends_image = false;
  DeltaTProgram profiles{options.program, at_ms(0)};
  CHECK_FALSE(profiles.has_fault(FaultKind::kWeed));
  CHECK(profiles.has_fault(FaultKind::kRepeat));
}

TEST_CASE("emulated sonar: a fault is added while it runs, if device or way can have it",
          "[hal_sim][emulators]") {
  Listened listened;
  listened.run_until(100);
  FaultTimetable& faults = listened.sonar.faults();
  const auto add = [&](const Fault& fault) {
    return faults.add(fault, listened.sonar.device(), listened.sonar.network());
  };
  CHECK_FALSE(add(sonar_fault(FaultKind::kFlip)));
  CHECK_FALSE(add(ahrs_fault(FaultKind::kStall)));
  CHECK(add(sonar_fault(FaultKind::kJump, 0.0, 50.0)));
  CHECK(add(sonar_fault(FaultKind::kStall)));
  listened.run_until(200);
  listened.heard.clear();
  listened.run_until(1000);
  CHECK(listened.heard.empty());
  faults.clear();
  listened.run_until(2000);
  CHECK(listened.heard.size() >= 9);
  CHECK(listened.numbers().front() > 50);
}

}  // namespace
}  // namespace lodesman
