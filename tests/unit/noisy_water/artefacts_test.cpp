// SPDX-License-Identifier: Apache-2.0
// What is heard and is not there, each alone in water that is silent otherwise.
#include <cmath>

#include "hal_sim/sonar/lasting.h"
#include "tests/support/catch.h"
#include "tests/support/echo_statistics.h"
#include "tests/support/noisy_pings.h"

namespace lodesman {
namespace {

using testing::ellipse_at;
using testing::NoisyPings;
using testing::wall_through;

// Dark, and as bright in all ranges from the ring-down on.
constexpr WaterKind kStill{
    .near_level = 4.0, .far_level = 4.0, .bottom_from = 1.0, .bottom_to = 1.0, .shadow = 1.0};
constexpr std::uint32_t kFromBin = 30;  // the ring-down is gone
constexpr std::uint8_t kEcho = 20;

struct Cell {
  std::uint32_t beam = 0;
  std::uint32_t bin = 0;
};

// Bright ones, of the beams up to before `end`.
[[nodiscard]] std::vector<Cell> bright_cells(const SonarPing& ping, std::uint32_t first = 0,
                                             std::uint32_t end = 120) {
  std::vector<Cell> cells;
  for (std::uint32_t beam = first; beam < end; ++beam) {
    for (std::uint32_t bin = kFromBin; bin < ping.bins; ++bin) {
      if (ping.echo[beam * ping.bins + bin] >= kEcho) {
        cells.push_back({beam, bin});
      }
    }
  }
  return cells;
}

TEST_CASE("noisy water: still water has no echoes", "[hal_sim][sonar]") {
  NoisyPings water{kStill, {}, 1};
  for (int i = 0; i < 20; ++i) {
    CHECK(bright_cells(water.next()).empty());
  }
}

TEST_CASE("noisy water: second echoes lie 2 to 8 m behind a body, in some pings",
          "[hal_sim][sonar]") {
  WaterKind kind = kStill;
  kind.second_echoes = 0.1;
  NoisyPings water{kind, {ellipse_at(0.0, 10.0, 0.5, 0.5)}, 1};
  int with = 0;
  for (int i = 0; i < 300; ++i) {
    bool any = false;
    for (const Cell& cell : bright_cells(water.next())) {
      const double range_m = 30.0 * cell.bin / 500.0;
      if (range_m > 11.2) {
        any = true;
        CHECK(range_m > 9.5 + 2.0 - 0.5);
        CHECK(range_m < 9.5 + 8.0 + 0.5);
        CHECK(std::abs(cell.beam - 59.5) < 6.0);
      }
    }
    with += any ? 1 : 0;
  }
  CHECK(with > 20);
  CHECK(with < 280);
}

TEST_CASE("noisy water: a mirror image lies as far behind a wall as the body before it",
          "[hal_sim][sonar]") {
  WaterKind kind = kStill;
  kind.mirror_images = 0.3;
  // The wall stands at 8 m to the right, the body 3 m off it: 11 m to the right is its image.
  NoisyPings water{
      kind, {ellipse_at(5.0, 12.0, 0.8, 0.8), wall_through({{8.0, -5.0}, {8.0, 60.0}})}, 2};
  const double range_m = std::hypot(11.0, 12.0);
  const double beam = 60.0 + to_deg(std::atan2(11.0, 12.0));
  int near_image = 0;
  for (int i = 0; i < 300; ++i) {
    const SonarPing& ping = water.next();
    const auto echoes = testing::echoes_inside(ping, [&](std::uint32_t b, std::uint32_t bin) {
      return std::abs(b + 0.5 - beam) < 1.5 && std::abs(ping.bin_range_m(bin) - range_m) < 0.3;
    });
    near_image += testing::median(echoes) > 6.0 ? 1 : 0;
  }
  CHECK(near_image > 20);
  CHECK(near_image < 290);
}

TEST_CASE("noisy water: without a wall or a body nothing is mirrored or echoed again",
          "[hal_sim][sonar]") {
  WaterKind kind = kStill;
  kind.mirror_images = kind.second_echoes = 1.0;
  NoisyPings water{kind, {wall_through({{-40.0, 12.0}, {40.0, 12.0}})}, 1};
  for (int i = 0; i < 30; ++i) {
    for (const Cell& cell : bright_cells(water.next())) {
      const double ahead_m =
          30.0 * (cell.bin + 0.5) / 500.0 * std::cos(to_rad(cell.beam + 0.5 - 60.0));
      CHECK(ahead_m == Approx(12.0).margin(1.2));
    }
  }
}

TEST_CASE("noisy water: a ray stays in its bearing over all ranges for many pings",
          "[hal_sim][sonar]") {
  WaterKind kind = kStill;
  kind.rays = 1.0;
  NoisyPings water{kind, {}, 1};
  const auto mean_of = [](const SonarPing& ping, std::uint32_t beam) {
    double sum = 0.0;
    for (std::uint32_t bin = kFromBin; bin < ping.bins; ++bin) {
      sum += ping.echo[beam * ping.bins + bin];
    }
    return sum / (ping.bins - kFromBin);
  };
  for (int i = 0; i < 4; ++i) {
    (void)water.next();
  }
  std::vector<bool> lit(120);
  int beams = 0;
  const SonarPing& fourth = water.next();
  for (std::uint32_t beam = 0; beam < 120; ++beam) {
    lit[beam] = mean_of(fourth, beam) > 5.0;
    beams += lit[beam] ? 1 : 0;
  }
  CHECK(beams >= 2);
  CHECK(beams <= 4 * 7);
  for (int i = 0; i < 20; ++i) {  // none lasts less
    const SonarPing& ping = water.next();
    for (std::uint32_t beam = 0; beam < 120; ++beam) {
      CHECK((mean_of(ping, beam) > 4.7 || !lit[beam]));
    }
  }
}

TEST_CASE("noisy water: a dashed stripe lights 3 to 5 beams, in part of their ranges",
          "[hal_sim][sonar]") {
  WaterKind kind = kStill;
  kind.dashed_stripes = 0.1;
  NoisyPings water{kind, {}, 1};
  int with = 0;
  for (int i = 0; i < 200; ++i) {
    const auto cells = bright_cells(water.next());
    if (cells.empty()) {
      continue;
    }
    ++with;
    CHECK(cells.back().beam - cells.front().beam < 5);
    CHECK(cells.size() > 100);
    CHECK(cells.size() < 5 * 400);
  }
  CHECK(with > 20);
  CHECK(with < 180);
}

TEST_CASE("noisy water: particles and outliers are a few cells, and gone after 5 pings",
          "[hal_sim][sonar]") {
  WaterKind kind = kStill;
  kind.particles = 0.05;
  NoisyPings water{kind, {}, 4};
  int lasted = 0;
  int longest = 0;
  int with = 0;
  for (int i = 0; i < 400; ++i) {
    const auto cells = bright_cells(water.next());
    CHECK(cells.size() <= 3 * 16);
    lasted = cells.empty() ? 0 : lasted + 1;
    longest = std::max(longest, lasted);
    with += cells.empty() ? 0 : 1;
  }
  CHECK(with > 10);
  CHECK(longest >= 2);
  CHECK(longest <= 15);  // some overlap
  kind.particles = 0.0;
  kind.outliers = 3.0;
  NoisyPings wrong{kind, {}, 4};
  for (int i = 0; i < 50; ++i) {
    const auto cells = bright_cells(wrong.next());
    CHECK(cells.size() <= 3);
  }
}

TEST_CASE("noisy water: a cloud stays where it is while the boat turns", "[hal_sim][sonar]") {
  WaterKind kind = kStill;
  kind.near_level = kind.far_level = 12.0;
  kind.clouds = 1.0;
  NoisyPings water{kind, {}, 1};
  const auto mean_echo = [](const SonarPing& ping, std::uint32_t first, std::uint32_t end) {
    double sum = 0.0;
    for (const double echo :
         testing::echoes_inside(ping, [=](std::uint32_t beam, std::uint32_t bin) {
           return beam >= first && beam < end && bin >= kFromBin;
         })) {
      sum += echo;
    }
    return sum / ((end - first) * (ping.bins - kFromBin));
  };
  for (int i = 0; i < 10; ++i) {
    (void)water.next();
  }
  const double before = mean_echo(water.next(), 0, 120);
  VehiclePose turned;
  turned.heading = Heading::clockwise_from_y_rad(to_rad(180.0));
  water.look_from(turned);
  CHECK(before > 12.5);
  CHECK(mean_echo(water.next(), 0, 120) < before - 0.3);
}

TEST_CASE("noisy water: as many pings are lost as it says", "[hal_sim][sonar]") {
  WaterKind kind = kStill;
  NoisyWater none{kind, testing::kUsualGrid, 1};
  kind.lost_pings = 0.05;
  NoisyWater some{kind, testing::kUsualGrid, 1};
  int lost = 0;
  for (int i = 0; i < 2000; ++i) {
    CHECK_FALSE(none.loses_ping());
    lost += some.loses_ping() ? 1 : 0;
  }
  CHECK(lost == Approx(100).margin(40));
}

TEST_CASE("noisy water: what lasts is there for its pings, and what finds no room is not",
          "[hal_sim][sonar]") {
  struct Thing {
    int name = 0;
    std::uint32_t pings_left = 0;
  };
  Lasting<Thing, 2> things;
  things.begin({1, 2});
  things.begin({2, 1});
  things.begin({3, 5});
  REQUIRE(things.now().size() == 2);
  things.age();
  REQUIRE(things.now().size() == 1);
  CHECK(things.now()[0].name == 1);
  things.begin({4, 0});
  CHECK(things.now().size() == 1);
  things.age();
  CHECK(things.now().empty());
}

}  // namespace
}  // namespace lodesman
