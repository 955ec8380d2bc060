// SPDX-License-Identifier: Apache-2.0
#include "tests/measure/sonar_figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "low_level/sonar/ping_image.h"
#include "tests/support/echo_statistics.h"
#include "tests/support/noisy_pings.h"

namespace lodesman::measure {
namespace {

namespace fs = std::filesystem;

constexpr double kAssignedRange_m = 30.0;  // the frames' own is not known
constexpr double kSquare_rad = to_rad(60.0);
constexpr double kGrazing_rad = to_rad(70.0);
constexpr int kSeeds = 16;  // bottoms, glints and speckle differ

// As large as the labelled ones, with the metres that were assigned to them.
[[nodiscard]] Obstacle target_of(int seed) {
  const double bearing_rad = to_rad(-20.0 + 5.0 * (seed % 9));
  const double range_m = 13.0 + 0.5 * (seed % 8);
  const double angle_rad = 0.4 * (seed % 8) - 1.5;
  return testing::ellipse_at(range_m * std::sin(bearing_rad), range_m * std::cos(bearing_rad), 2.6,
                             1.5, angle_rad)
      .at_start;
}

// Beside the boat, across the far range, or both.
[[nodiscard]] Walls walls_of(int seed) {
  const std::vector<Vertex> beside{{6.2, 3.8}, {16.9, 24.7}};
  const std::vector<Vertex> along{{10.5, 6.0}, {10.2, 28.0}};
  const std::vector<Vertex> across{{-22.0, 16.0}, {12.0, 26.0}};
  const std::array<Walls, 4> choices{Walls{beside}, Walls{along}, Walls{across},
                                     Walls{along, across}};
  return choices[static_cast<std::size_t>(seed) % choices.size()];
}

[[nodiscard]] bool is_inside(const Obstacle& o, double x_m, double y_m) {
  const double dx_m = x_m - o.centre_x_m;
  const double dy_m = y_m - o.centre_y_m;
  const double first_m = dx_m * std::sin(o.angle_rad) + dy_m * std::cos(o.angle_rad);
  const double second_m = dx_m * std::cos(o.angle_rad) - dy_m * std::sin(o.angle_rad);
  return std::hypot(first_m / o.semi_axis_first_m, second_m / o.semi_axis_second_m) <= 1.0;
}

[[nodiscard]] std::unique_ptr<SonarPing> read_frame(const fs::path& file) {
  auto ping = std::make_unique<SonarPing>();
  ping->range_m = kAssignedRange_m;
  ping->make_image(120, 500, to_rad(120.0));
  polar_to_ping(read_grey_image(file), file, *ping);
  return ping;
}

[[nodiscard]] Walls marked_walls(const nlohmann::json& frame) {
  Walls walls;
  for (const auto& line : frame.at("walls")) {
    walls.emplace_back();
    for (const auto& point : line) {
      walls.back().push_back({point.at(0).get<double>(), point.at(1).get<double>()});
    }
  }
  return walls;
}

}  // namespace

void add_figures(const SonarPing& ping,
                 const std::function<bool(std::uint32_t, std::uint32_t)>& is_target,
                 const Walls& walls, Figures& figures) {
  const testing::Speckle speckle = testing::speckle_of(ping);
  figures.variation.push_back(speckle.variation);
  figures.along.resize(speckle.along.size());
  figures.across.resize(speckle.across.size());
  for (std::size_t i = 0; i < speckle.along.size(); ++i) {
    figures.along[i].push_back(speckle.along[i]);
  }
  for (std::size_t i = 0; i < speckle.across.size(); ++i) {
    figures.across[i].push_back(speckle.across[i]);
  }
  figures.near_level.push_back(testing::background(ping, 0.04, 0.2));
  figures.far_level.push_back(testing::background(ping, 0.75, 1.0));
  for (const double share : testing::ring_shares(ping)) {
    figures.ring_share.push_back(share);
  }
  for (const auto& wall : walls) {
    for (const testing::WallPiece& piece : testing::wall_pieces(ping, wall)) {
      if (piece.incidence_rad < kSquare_rad || piece.incidence_rad > kGrazing_rad) {
        auto& pieces = piece.incidence_rad < kSquare_rad ? figures.wall : figures.grazing_wall;
        pieces.push_back(piece.contrast);
      }
    }
  }
  const auto medians = testing::range_medians(ping);
  const auto echoes = testing::echoes_inside(ping, is_target);
  const auto faint = testing::echoes_inside(ping, [&](std::uint32_t beam, std::uint32_t bin) {
    return is_target(beam, bin) &&
           ping.echo[std::size_t{beam} * ping.bins + bin] < 3.0 * medians[bin];
  });
  figures.target_median.push_back(testing::median(echoes));
  figures.target_p90.push_back(testing::quantile(echoes, 0.9));
  figures.target_peak.push_back(testing::quantile(echoes, 1.0));
  figures.target_faint.push_back(static_cast<double>(faint.size()) /
                                 static_cast<double>(std::max<std::size_t>(echoes.size(), 1)));
}

Figures simulated_figures(const WaterKind& kind, int pings) {
  Figures figures;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const Obstacle target = target_of(seed);
    const auto walls = walls_of(seed);
    std::vector<MovingObstacle> scene(1);
    scene[0].at_start = target;
    for (const auto& wall : walls) {
      scene.push_back(testing::wall_through(wall));
    }
    testing::NoisyPings water{kind, scene, static_cast<std::uint64_t>(seed)};
    water.go_on(testing::kUntilUsual);
    for (int i = 0; i < std::max(pings / kSeeds, 1); ++i) {
      const SonarPing& ping = water.next();
      const auto is_target = [&](std::uint32_t beam, std::uint32_t bin) {
        return is_inside(target, ping.bin_range_m(bin) * std::sin(ping.bearing_rad(beam)),
                         ping.bin_range_m(bin) * std::cos(ping.bearing_rad(beam)));
      };
      add_figures(ping, is_target, walls, figures);
    }
  }
  return figures;
}

Figures real_figures(const fs::path& folder) {
  std::ifstream file{folder / "truth.json"};
  const nlohmann::json frames = nlohmann::json::parse(file).at("frames");
  Figures figures;
  for (const auto& [name, truth] : frames.items()) {
    const std::string image = name + ".pgm";
    const auto ping = read_frame(folder / "polar_120x500" / image);
    const auto mask = read_frame(folder / "polar_mask_120x500" / image);
    add_figures(
        *ping,
        [&](std::uint32_t beam, std::uint32_t bin) {
          return mask->echo[std::size_t{beam} * mask->bins + bin] > 127;
        },
        marked_walls(truth), figures);
  }
  return figures;
}

}  // namespace lodesman::measure
