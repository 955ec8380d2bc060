// SPDX-License-Identifier: Apache-2.0
#include "low_level/sonar/ping_watch.h"

#include <algorithm>
#include <memory>
#include <numeric>
#include <random>
#include <set>
#include <vector>

#include "low_level/sonar/ping_image.h"
#include "tests/support/allocations.h"
#include "tests/support/catch.h"
#include "tests/support/data_dir.h"
#include "tests/support/speckled_water.h"
#include "tests/unit/sonar/synthetic.h"

namespace lodesman::testing {
namespace {

namespace fs = std::filesystem;

// Some pings in a row, each of water that is speckled anew, and changed by a test.
struct WatchBench {
  std::unique_ptr<PingWatch> watch = std::make_unique<PingWatch>();
  std::unique_ptr<SonarPing> ping = empty_ping();
  SpeckledWater water;

  template <class Change>
  void look(int pings, Change change) {
    for (int i = 0; i < pings; ++i) {
      water.fill(*ping);
      change(*ping);
      watch->look(*ping);
    }
  }
  void look(int pings) {
    look(pings, [](SonarPing&) {});
  }
  [[nodiscard]] std::size_t blind_count() const {
    const auto blind = watch->blind();
    return static_cast<std::size_t>(std::count(blind.begin(), blind.end(), 1));
  }
};

void silence(SonarPing& ping, std::uint32_t first, std::uint32_t end) {
  std::fill(ping.echo.begin() + first * ping.bins, ping.echo.begin() + end * ping.bins,
            std::uint8_t{0});
}

// Weed on those beams.
void cover(SonarPing& ping, SpeckledWater& water, std::uint32_t first, std::uint32_t end) {
  silence(ping, first, end);
  for (std::uint32_t beam = first; beam < end; ++beam) {
    for_cells(ping, beam, 0.0, 1.5, [&](std::uint8_t& echo) { echo = water.speckled(120.0); });
  }
}

TEST_CASE("ping watch: water and what stands in it are no trouble", "[low_level][sonar]") {
  WatchBench bench;
  for (std::uint32_t beam = 0; beam < 120; ++beam) {
    bench.water.gain[beam] = beam < 40 ? 4.0 : beam < 80 ? 1.0 : 0.4;
  }
  const auto wall = [&](SonarPing& ping) {
    for (std::uint32_t beam = 20; beam < 60; ++beam) {
      for_cells(ping, beam, 8.0, 9.0, [&](auto& echo) { echo = bench.water.speckled(120.0); });
      for_cells(ping, beam, 9.0, 30.0, [](auto& echo) { echo = echo / 3; });  // its shadow
    }
  };
  for (int i = 0; i < 10; ++i) {
    bench.look(5);
    CHECK(bench.watch->trouble() == PingTrouble::kNone);
    CHECK(bench.watch->blind().empty());
    bench.look(5, wall);
    CHECK(bench.watch->trouble() == PingTrouble::kNone);
    CHECK(bench.watch->blind().empty());
    CHECK(bench.watch->tells_of_water());
  }
  // The boat turns: what was the brightest is the darkest.
  std::reverse(bench.water.gain.begin(), bench.water.gain.begin() + 120);
  bench.look(20);
  CHECK(bench.watch->trouble() == PingTrouble::kNone);
  CHECK(bench.watch->blind().empty());
}

TEST_CASE("ping watch: a ping that is white all over tells nothing, from the first one on",
          "[low_level][sonar]") {
  WatchBench bench;
  bench.look(10);
  const auto white = [&](SonarPing& ping) {
    for (std::uint8_t& echo : ping.echo) {
      echo = static_cast<std::uint8_t>(240 + bench.water.random()() % 16);
    }
  };
  bench.look(1, white);
  CHECK_FALSE(bench.watch->tells_of_water());
  CHECK(bench.watch->trouble() == PingTrouble::kNone);  // one alone is not told
  bench.look(5, white);
  CHECK(bench.watch->trouble() == PingTrouble::kSaturated);
  bench.look(1);
  CHECK(bench.watch->tells_of_water());
  bench.look(10);
  CHECK(bench.watch->trouble() == PingTrouble::kNone);
  // A third of it is a near wall, and much of the rest is bright.
  bench.look(10, [&](SonarPing& ping) {
    for (std::uint32_t beam = 0; beam < 120; ++beam) {
      for_cells(ping, beam, 0.0, 30.0, [&](auto& echo) {
        echo = beam < 40 ? std::uint8_t{255} : bench.water.speckled(120.0);
      });
    }
  });
  CHECK(bench.watch->tells_of_water());
}

TEST_CASE("ping watch: speckle that comes again bit for bit is frozen", "[low_level][sonar]") {
  WatchBench bench;
  bench.look(10);
  int told_of_water = 0;
  for (int i = 0; i < 20; ++i) {
    bench.watch->look(*bench.ping);
    told_of_water += bench.watch->tells_of_water() ? 1 : 0;
  }
  CHECK(told_of_water < 5);
  CHECK(bench.watch->trouble() == PingTrouble::kFrozen);
  bench.look(1);
  CHECK(bench.watch->tells_of_water());
  bench.look(10);
  CHECK(bench.watch->trouble() == PingTrouble::kNone);
  // Twice the same is chance, or a datagram that came twice.
  for (int i = 0; i < 10; ++i) {
    bench.watch->look(*bench.ping);
    CHECK(bench.watch->tells_of_water());
    bench.look(2);
  }
  CHECK(bench.watch->trouble() == PingTrouble::kNone);
}

TEST_CASE("ping watch: what is drawn may come again", "[low_level][sonar]") {
  WatchBench bench;
  light_disc(*bench.ping, 9.0, 0.2, 1.0);
  for (int i = 0; i < 30; ++i) {
    bench.watch->look(*bench.ping);
  }
  CHECK(bench.watch->tells_of_water());
  std::replace(bench.ping->echo.begin(), bench.ping->echo.end(), std::uint8_t{0}, std::uint8_t{8});
  for (int i = 0; i < 30; ++i) {
    bench.watch->look(*bench.ping);
  }
  CHECK(bench.watch->tells_of_water());
  CHECK(bench.watch->trouble() == PingTrouble::kNone);
}

TEST_CASE("ping watch: beams that fall silent are blind at once, and are told of if it lasts",
          "[low_level][sonar]") {
  WatchBench bench;
  bench.look(40);
  const auto blind = [](SonarPing& ping) { silence(ping, 50, 70); };
  bench.look(1, blind);
  CHECK(bench.blind_count() == 20);
  CHECK(bench.watch->trouble() == PingTrouble::kNone);
  bench.look(20, blind);
  CHECK(bench.watch->trouble() == PingTrouble::kBlindSector);
  CHECK(bench.watch->tells_of_water());
  for (std::uint32_t beam = 0; beam < 120; ++beam) {
    CHECK((bench.watch->blind()[beam] == 1) == (beam >= 50 && beam < 70));
  }
  bench.look(20);
  CHECK(bench.watch->trouble() == PingTrouble::kNone);
  CHECK(bench.watch->blind().empty());
}

TEST_CASE("ping watch: what is blind from the beginning is found too, however much of the fan",
          "[low_level][sonar]") {
  for (const std::uint32_t hears : {100U, 60U, 30U, 10U}) {
    WatchBench bench;
    bench.look(10, [&](SonarPing& ping) { silence(ping, 0, 120 - hears); });
    INFO(hears);
    CHECK(bench.blind_count() == 120 - hears);
    CHECK(bench.watch->trouble() == PingTrouble::kBlindSector);
  }
}

TEST_CASE("ping watch: beams that keep a tenth of what they heard are blind, as far as is learnt",
          "[low_level][sonar]") {
  WatchBench bench;
  bench.water.near_level = 30.0;
  bench.water.far_level = 60.0;
  const auto faint = [](SonarPing& ping) {
    for (std::uint32_t beam = 50; beam < 70; ++beam) {
      for_cells(ping, beam, 0.0, 30.0, [](auto& echo) { echo = echo / 10; });
    }
  };
  bench.look(10, faint);
  CHECK(bench.blind_count() == 0);  // it may always have been so
  bench.look(100);
  bench.look(10, faint);
  CHECK(bench.blind_count() == 20);
}

TEST_CASE("ping watch: without a background silence is no trouble", "[low_level][sonar]") {
  WatchBench bench;
  std::fill(bench.ping->echo.begin(), bench.ping->echo.end(), std::uint8_t{0});
  for (int i = 0; i < 60; ++i) {
    // What rests is seen again and again, and comes and goes.
    if (i % 20 < 10) {
      light_disc(*bench.ping, 9.0, 0.2, 1.0);
    } else {
      light_disc(*bench.ping, 9.0, 0.2, 1.0, 0);
    }
    bench.watch->look(*bench.ping);
    CHECK(bench.watch->tells_of_water());
    CHECK(bench.watch->trouble() == PingTrouble::kNone);
    CHECK(bench.watch->blind().empty());
  }
}

TEST_CASE("ping watch: a head that hears nothing from one ping to the next tells nothing",
          "[low_level][sonar]") {
  WatchBench bench;
  bench.look(40);
  bench.look(1, [](SonarPing& ping) { silence(ping, 0, 120); });
  CHECK_FALSE(bench.watch->tells_of_water());
  bench.look(5, [](SonarPing& ping) { silence(ping, 0, 120); });
  CHECK(bench.watch->trouble() == PingTrouble::kDeaf);
  bench.look(1);
  CHECK(bench.watch->tells_of_water());
  // Noise that came with rays and went with them was no water.
  WatchBench disturbed;
  const auto rays = [&disturbed](SonarPing& ping) {
    for (std::uint32_t beam = 4; beam < 120; beam += 8) {
      for_cells(ping, beam, 0.0, 30.0, [&](auto& echo) { echo = disturbed.water.speckled(60.0); });
    }
  };
  disturbed.look(60, rays);
  disturbed.look(10, [](SonarPing& ping) { silence(ping, 0, 120); });
  CHECK(disturbed.watch->tells_of_water());
  // Water that becomes clear bit by bit is another water.
  WatchBench clear;
  for (int i = 0; i < 100; ++i) {
    clear.water.gain.fill(1.0 - 0.01 * i);
    clear.look(1);
    CHECK(clear.watch->tells_of_water());
  }
  clear.look(10, [](SonarPing& ping) { silence(ping, 0, 120); });
  CHECK(clear.watch->tells_of_water());
  CHECK(clear.watch->trouble() == PingTrouble::kNone);
}

TEST_CASE("ping watch: a bright haze with nothing behind it is weed", "[low_level][sonar]") {
  WatchBench bench;
  bench.look(30);
  bench.look(20, [&](SonarPing& ping) { cover(ping, bench.water, 70, 110); });
  CHECK(bench.watch->trouble() == PingTrouble::kWeed);
  CHECK(bench.blind_count() == 40);
  bench.look(30);
  CHECK(bench.watch->trouble() == PingTrouble::kNone);
  // With the usual water behind it, it is a haze.
  bench.look(20, [&](SonarPing& ping) {
    for (std::uint32_t beam = 70; beam < 110; ++beam) {
      for_cells(ping, beam, 0.0, 1.5, [](auto& echo) { echo = 120; });
    }
  });
  CHECK(bench.watch->trouble() == PingTrouble::kNone);
  CHECK(bench.blind_count() == 0);
}

TEST_CASE("ping watch: rays in many bearings are interference, the usual few are not",
          "[low_level][sonar]") {
  WatchBench bench;
  const auto rays = [&bench](int count) {
    return [&bench, count](SonarPing& ping) {
      for (int i = 0; i < count; ++i) {
        const auto beam = static_cast<std::uint32_t>(bench.water.random()() % 120);
        for_cells(ping, beam, 0.0, 30.0, [&](auto& echo) { echo = bench.water.speckled(40.0); });
      }
    };
  };
  bench.look(30, rays(4));
  CHECK(bench.watch->trouble() == PingTrouble::kNone);
  bench.look(20, rays(16));
  CHECK(bench.watch->trouble() == PingTrouble::kInterference);
  CHECK(bench.watch->tells_of_water());
  CHECK(bench.watch->blind().empty());
  bench.look(20);
  CHECK(bench.watch->trouble() == PingTrouble::kNone);
}

TEST_CASE("ping watch: another fan is judged anew, a profile is not judged", "[low_level][sonar]") {
  WatchBench bench;
  bench.look(20, [](SonarPing& ping) { silence(ping, 0, 60); });
  REQUIRE(bench.watch->trouble() == PingTrouble::kBlindSector);
  bench.ping = empty_ping(10.0, 240, 300);
  bench.look(1);
  CHECK(bench.watch->trouble() == PingTrouble::kNone);
  bench.look(20, [](SonarPing& ping) { silence(ping, 100, 240); });
  CHECK(bench.watch->trouble() == PingTrouble::kBlindSector);
  CHECK(bench.blind_count() == 140);
  bench.ping->kind = PingKind::kProfile;
  bench.watch->look(*bench.ping);
  CHECK(bench.watch->trouble() == PingTrouble::kNone);
  CHECK(bench.watch->blind().empty());
  CHECK(bench.watch->tells_of_water());
}

TEST_CASE("ping watch: any bytes and any size are looked at, and nothing is allocated",
          "[low_level][sonar]") {
  WatchBench bench;
  std::mt19937 random{5};
  for (int round = 0; round < 120; ++round) {
    SonarPing& ping = *bench.ping;
    const auto beams = 1 + static_cast<std::uint32_t>(random() % kMaxBeams);
    const auto bins = 1 + static_cast<std::uint32_t>(random() % kMaxBins);
    ping.make_image(beams, bins, 2.0);
    ping.range_m = round % 5 == 0 ? 0.01 : 0.5 * static_cast<double>(1 + random() % 600);
    const auto spread = static_cast<std::uint32_t>(1 + random() % 256);
    for (std::size_t i = 0; i < ping.echo_count; ++i) {
      ping.echo[i] = static_cast<std::uint8_t>(random() % spread);
    }
    ping.echo_count += round % 7 == 0 ? 1 : 0;
    const AllocationScope scope;
    for (int again = 0; again < 3; ++again) {
      bench.watch->look(ping);
    }
    const std::uint64_t allocations = scope.count();
    CHECK(allocations == 0);
    CHECK((bench.watch->blind().empty() || bench.watch->blind().size() == beams));
  }
}

// Each file once, in the order of their names, as if they were one sonar's pings.
int files_looked_at(PingWatch& watch, const fs::path& folder, double sector_deg, bool is_fan) {
  std::set<fs::path> files;
  for (const auto& entry : fs::directory_iterator{folder}) {
    if (entry.path().extension() == ".png" || entry.path().extension() == ".pgm") {
      files.insert(entry.path());
    }
  }
  for (const fs::path& file : files) {
    const auto ping = empty_ping();
    ping->sector_rad = to_rad(sector_deg);
    const GreyImage image = read_grey_image(file);
    if (is_fan) {
      fan_to_ping(image, whole_image_fan(image, true), *ping);
    } else {
      polar_to_ping(image, file, *ping);
    }
    watch.look(*ping);
    CAPTURE(file);
    CHECK(watch.trouble() == PingTrouble::kNone);
    CHECK(watch.tells_of_water());
    CHECK(watch.blind().empty());
  }
  return static_cast<int>(files.size());
}

TEST_CASE("real frames: none of them is called troubled", "[low_level][sonar][data]") {
  struct Set {
    const char* folder;
    double sector_deg;
    bool is_fan;
    int files;
  };
  for (const Set& set : {Set{"fls_oculus_m1200d/polar_120x500", 120.0, false, 31},
                         Set{"fls_oculus_known_range/polar_120x500", 120.0, false, 5},
                         Set{"sonar_raw_oculus_pings/polar", 60.0, false, 3},
                         Set{"fls_moving_auv/sonar4", 120.0, false, 190},
                         Set{"fls_aris3000_watertank/fan", 30.0, true, 16},
                         Set{"fls_didson_river", 28.0, true, 12}}) {
    if (const auto folder = data_path(set.folder); folder) {
      PingWatch watch;
      CHECK(files_looked_at(watch, *folder, set.sector_deg, set.is_fan) == set.files);
    }
  }
}

TEST_CASE("real frames: a sector of one that falls silent is blind, and one that hangs is frozen",
          "[low_level][sonar][data]") {
  const auto folder = data_path("fls_moving_auv/sonar4");
  if (!folder) {
    return;
  }
  PingWatch watch;
  REQUIRE(files_looked_at(watch, *folder, 120.0, false) == 190);
  const fs::path last = *folder / "f_189.png";
  const auto ping = empty_ping();
  polar_to_ping(read_grey_image(last), last, *ping);
  silence(*ping, 30, 70);
  watch.look(*ping);
  REQUIRE(watch.blind().size() == 120);
  CHECK(std::accumulate(watch.blind().begin() + 30, watch.blind().begin() + 70, 0) == 40);
  CHECK(std::accumulate(watch.blind().begin(), watch.blind().end(), 0) == 40);
  for (int i = 0; i < 5; ++i) {
    watch.look(*ping);
  }
  CHECK(watch.trouble() == PingTrouble::kFrozen);
  CHECK_FALSE(watch.tells_of_water());
}

}  // namespace
}  // namespace lodesman::testing
