// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <memory>

#include "tests/support/allocations.h"
#include "tests/support/catch.h"
#include "tests/support/echo_statistics.h"
#include "tests/support/noisy_pings.h"

namespace lodesman {
namespace {

using testing::ellipse_at;
using testing::kUsualGrid;
using testing::median;
using testing::NoisyPings;
using testing::wall_through;

[[nodiscard]] std::vector<std::uint8_t> echoes_of(const SonarPing& ping) {
  return {ping.echo.begin(), ping.echo.begin() + ping.echo_count};
}

[[nodiscard]] std::vector<MovingObstacle> some_scene() {
  return {ellipse_at(-3.0, 14.0, 1.0, 0.6), wall_through({{-20.0, 24.0}, {15.0, 20.0}}),
          wall_through({{8.0, 4.0}, {12.0, 26.0}})};
}

TEST_CASE("noisy water: the same seed gives the same pings, another one others",
          "[hal_sim][sonar]") {
  for (const WaterKind& kind : {kTankWater, kSeaWater}) {
    NoisyPings one{kind, some_scene(), 7};
    NoisyPings same{kind, some_scene(), 7};
    NoisyPings other{kind, some_scene(), 8};
    std::vector<std::uint8_t> before;
    for (int i = 0; i < 20; ++i) {
      const auto echoes = echoes_of(one.next());
      CHECK(echoes == echoes_of(same.next()));
      CHECK(echoes != echoes_of(other.next()));
      CHECK(echoes != before);
      before = echoes;
    }
  }
}

// Of the real frames of docs/sonar_simulation.md, by the same reckoning.
TEST_CASE("noisy water: speckle varies and is alike in neighbours as in real frames",
          "[hal_sim][sonar]") {
  for (const WaterKind& kind : {kTankWater, kSeaWater}) {
    std::vector<double> variation;
    std::vector<std::vector<double>> alike(5);
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      NoisyPings water{kind, some_scene(), seed};
      for (int i = 0; i < 5; ++i) {
        const testing::Speckle speckle = testing::speckle_of(water.next());
        variation.push_back(speckle.variation);
        std::size_t at = 0;
        for (const double correlation : speckle.along) {
          alike[at++].push_back(correlation);
        }
        for (const double correlation : speckle.across) {
          alike[at++].push_back(correlation);
        }
      }
    }
    CHECK(median(variation) == Approx(0.37).epsilon(0.2));
    CHECK(median(alike[0]) == Approx(0.64).epsilon(0.2));  // 1 bin
    CHECK(median(alike[1]) == Approx(0.28).epsilon(0.25));
    CHECK(median(alike[2]) == Approx(0.06).margin(0.06));   // 4 bins
    CHECK(median(alike[3]) == Approx(0.40).epsilon(0.25));  // 1 beam
    CHECK(median(alike[4]) == Approx(0.29).epsilon(0.35));
  }
}

TEST_CASE("noisy water: it is brighter far off, and the bottom is a step behind a dark ring",
          "[hal_sim][sonar]") {
  WaterKind kind = kSeaWater;
  kind.bottom_from = kind.bottom_to = 0.6;
  NoisyPings water{kind, {}, 1};
  std::vector<double> sum(kUsualGrid.bins);
  for (int i = 0; i < 40; ++i) {
    const auto medians = testing::range_medians(water.next());
    std::transform(sum.begin(), sum.end(), medians.begin(), sum.begin(), std::plus{});
  }
  const auto mean = [&sum](std::ptrdiff_t from, std::ptrdiff_t to) {
    return median({sum.begin() + from, sum.begin() + to});
  };
  CHECK(mean(470, 500) > 1.5 * mean(30, 60));
  CHECK(mean(305, 330) / mean(270, 290) == Approx(2.5).margin(0.5));
  CHECK(mean(297, 299) < 0.7 * mean(270, 290));
  CHECK(mean(0, 4) > 5.0 * mean(60, 90));  // the head's own ring-down
}

TEST_CASE("noisy water: a strong echo is heard as a ring of 4 to 9 % of it in all beams",
          "[hal_sim][sonar]") {
  WaterKind kind = kSeaWater;
  kind.outliers = kind.particles = kind.dashed_stripes = 0.0;  // bright, and without a ring
  std::vector<double> shares;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    NoisyPings water{kind, {ellipse_at(-3.0, 14.0, 0.7, 0.5, 0.5)}, seed};
    for (int i = 0; i < 10; ++i) {
      const auto of_ping = testing::ring_shares(water.next());
      shares.insert(shares.end(), of_ping.begin(), of_ping.end());
    }
  }
  REQUIRE(shares.size() > 100);
  CHECK(median(shares) > 0.04);
  CHECK(median(shares) < 0.09);
}

TEST_CASE("noisy water: a wall is brightest square on, and nowhere quite gone",
          "[hal_sim][sonar]") {
  std::vector<double> square;
  std::vector<double> slanting;
  std::vector<double> grazing;
  const std::vector<std::vector<Vertex>> walls{
      {{-30.0, 16.0}, {30.0, 16.0}}, {{6.2, 3.8}, {16.9, 24.7}}, {{10.5, 6.0}, {10.2, 28.0}}};
  for (const auto& wall : walls) {
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      NoisyPings water{kSeaWater, {wall_through(wall)}, seed};
      for (const auto& piece : testing::wall_pieces(water.next(), wall)) {
        (piece.incidence_rad < to_rad(8.0)    ? square
         : piece.incidence_rad < to_rad(60.0) ? slanting
                                              : grazing)
            .push_back(piece.contrast);
      }
    }
  }
  CHECK(median(square) > 1.5 * median(slanting));
  CHECK(median(slanting) > 2.0);
  CHECK(median(slanting) < 6.0);
  CHECK(median(grazing) > 1.2);
  CHECK(median(grazing) < median(slanting));
}

TEST_CASE("noisy water: a wall that is seen end on, or is a post, is heard at its corner",
          "[hal_sim][sonar]") {
  const std::vector<std::vector<Vertex>> walls{{{0.13, 15.0}, {0.21, 24.0}},
                                               {{0.13, 15.0}, {0.13, 15.0}}};
  for (const auto& wall : walls) {
    NoisyPings with{kSeaWater, {wall_through(wall)}, 3};
    NoisyPings without{kSeaWater, {}, 3};
    double sum = 0.0;
    double empty = 0.0;
    for (int i = 0; i < 40; ++i) {
      const auto at_corner = [](std::uint32_t beam, std::uint32_t bin) {
        return beam >= 59 && beam <= 61 && bin >= 248 && bin <= 252;
      };
      for (const double echo : testing::echoes_inside(with.next(), at_corner)) {
        sum += echo;
      }
      for (const double echo : testing::echoes_inside(without.next(), at_corner)) {
        empty += echo;
      }
    }
    CHECK(sum > 1.5 * empty);
  }
}

TEST_CASE("noisy water: any grid and any scene gives a whole ping, and nothing is allocated",
          "[hal_sim][sonar]") {
  const std::vector<MovingObstacle> scene{ellipse_at(0.0, 0.0, 5.0, 4.0),  // the boat is in it
                                          ellipse_at(0.3, 0.6, 0.01, 0.01),
                                          wall_through({{0.0, 0.0}, {0.0, 0.0}, {0.0, 500.0}}),
                                          wall_through({{-1.0, 0.5}, {1.0, 0.5}})};
  for (const EchoGrid& grid :
       {EchoGrid{1, 1, 1.0, to_rad(1.0)}, EchoGrid{2, 1000, 300.0, to_rad(180.0)},
        EchoGrid{512, 3, 2.0, to_rad(60.0)}, EchoGrid{512, 1000, 50.0, to_rad(120.0)}}) {
    for (const WaterKind& kind : {kTankWater, kSeaWater}) {
      NoisyPings empty{kind, {}, 1, grid};
      NoisyPings full{kind, scene, 1, grid};
      std::uint64_t heard = 0;
      const testing::AllocationScope scope;
      for (int i = 0; i < 30; ++i) {
        heard += full.next().echo[0];
        heard += empty.next().echo[0];
      }
      CHECK(scope.count() == 0);
      CHECK(heard > 0);
    }
  }
}

TEST_CASE("noisy water: a ping of another grid is left alone", "[hal_sim][sonar]") {
  NoisyWater water{kSeaWater, kUsualGrid, 1};
  const auto ping = std::make_unique<SonarPing>();
  ping->make_image(60, 500, to_rad(60.0));
  water.draw(HeardScene{{}}, *ping);
  CHECK(std::all_of(ping->echo.begin(), ping->echo.end(), [](auto echo) { return echo == 0; }));
}

}  // namespace
}  // namespace lodesman
