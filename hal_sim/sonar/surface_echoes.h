// SPDX-License-Identifier: Apache-2.0
// What surfaces send back: walls by how square they stand to a beam, small bodies in glints all
// over, both with a smear behind them, spread over neighbouring beams and heard faintly in all.
// One thread; allocates when made and never after.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hal_sim/sonar/echo_levels.h"
#include "hal_sim/sonar/heard_scene.h"
#include "mid_level/base/random_stream.h"

namespace lodesman {

// Whether it sends back glints from all over, or as a wall does.
[[nodiscard]] bool is_small_body(const Obstacle& obstacle) noexcept;

class SurfaceEchoes {
 public:
  SurfaceEchoes(const WaterKind& kind, const EchoGrid& grid, RandomStream& chance);

  // Adds to levels whose water is drawn, and that are silent otherwise.
  void draw(const HeardScene& scene, EchoLevels& levels, RandomStream& chance) noexcept;

  // [-] of 255, the brightest of any beam at that range, of the newest ping.
  [[nodiscard]] float brightest(double bin) const noexcept;
  // [m] to the nearest surface in a beam of it; infinity: none.
  [[nodiscard]] double sight_m(std::uint32_t beam) const noexcept { return sights_m_[beam]; }

 private:
  void hear_beam(const HeardScene& scene, EchoLevels& levels, std::uint32_t beam) noexcept;
  void hear_wall(const HeardSurface& surface, EchoLevels& levels) noexcept;
  void hear_body(const HeardSurface& surface, const WorldPoint& from_W,
                 const Eigen::Vector2d& direction_W) noexcept;
  void hear_corners(const HeardScene& scene, EchoLevels& levels) noexcept;
  // Adds to the beam at hand; bins as real numbers, 0.5 the middle of the first.
  void add(double first, double bins, double level) noexcept;
  void spread(std::uint32_t beam, EchoLevels& levels) noexcept;
  void ring(EchoLevels& levels) noexcept;
  [[nodiscard]] double glint(std::uint32_t id, double x, double y) const noexcept;

  WaterKind kind_;
  EchoGrid grid_;
  std::vector<float> glints_;     // [-] of median 1, of any piece of any surface
  std::vector<float> column_;     // one beam, before it is spread
  std::vector<float> brightest_;  // a bin, over all beams
  std::vector<double> sights_m_;  // a beam
  // Bins from one to before another that are not silent.
  struct Part {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
  };
  std::vector<Part> touched_;  // a beam
  std::uint32_t begin_ = 0;    // the same, of the column
  std::uint32_t end_ = 0;
  float ping_gain_ = 1.0F;  // [-] bodies turn a little from ping to ping
};

}  // namespace lodesman
