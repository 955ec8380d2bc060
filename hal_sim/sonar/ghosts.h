// SPDX-License-Identifier: Apache-2.0
// Echoes of small bodies that came by another way: second echoes behind them, and mirror images
// behind walls. They follow what they are echoes of, and flicker. One thread; never allocates.
#pragma once

#include <cstdint>

#include "hal_sim/sonar/echo_levels.h"
#include "hal_sim/sonar/heard_scene.h"
#include "hal_sim/sonar/lasting.h"
#include "hal_sim/sonar/surface_echoes.h"

namespace lodesman {

class Ghosts {
 public:
  Ghosts(const WaterKind& kind, const EchoGrid& grid) : kind_{kind}, grid_{grid} {}

  // Adds to levels in which the surfaces are drawn.
  void draw(const HeardScene& scene, const SurfaceEchoes& surfaces, EchoLevels& levels,
            RandomStream& chance) noexcept;

 private:
  struct Ghost {
    std::uint32_t body = 0;  // its id
    std::uint32_t wall = 0;  // the id of the one it is mirrored in
    std::uint32_t side = 0;  // of that wall
    bool mirrored = false;
    double share = 0.0;             // [-] of how bright the body is
    double behind_nominal_m = 0.0;  // a second echo's
    std::uint32_t pings_left = 0;
  };
  // Where a body is heard.
  struct Heard {
    double beam = 0.0;
    double range_m = 0.0;
    double beams = 0.0;  // half its width
    bool any = false;
  };
  void begin_some(const HeardScene& scene, const SurfaceEchoes& surfaces,
                  RandomStream& chance) noexcept;
  void draw_one(const Ghost& ghost, const HeardScene& scene, const SurfaceEchoes& surfaces,
                EchoLevels& levels) const noexcept;
  [[nodiscard]] Heard where(const Obstacle& body, const HeardScene& scene,
                            const SurfaceEchoes& surfaces) const noexcept;
  [[nodiscard]] Heard mirrored(const Obstacle& body, const Ghost& ghost,
                               const HeardScene& scene) const noexcept;

  static constexpr std::size_t kMost = 16;
  WaterKind kind_;
  EchoGrid grid_;
  Lasting<Ghost, kMost> ghosts_;
};

}  // namespace lodesman
