// SPDX-License-Identifier: Apache-2.0
// What is in the water and is no obstacle: clouds of bubbles or plankton, particles, and single
// cells that are wrong. Clouds and particles stay where they are in the world. One thread; never
// allocates.
#pragma once

#include <cstdint>

#include "hal_sim/sonar/echo_levels.h"
#include "hal_sim/sonar/lasting.h"
#include "mid_level/base/frames.h"

namespace lodesman {

class Clutter {
 public:
  Clutter(const WaterKind& kind, const EchoGrid& grid) : kind_{kind}, grid_{grid} {}

  // Adds to levels whose water is drawn; the sonar is there.
  void draw(const VehiclePose& pose, EchoLevels& levels, RandomStream& chance) noexcept;

 private:
  struct Speck {
    WorldPoint at_W;
    double beams = 0.0;        // half its size
    double bins = 0.0;         // the same
    double level = 0.0;        // [-] of 255
    double times_water = 0.0;  // [-] the same, by how bright the water is there
    std::uint32_t pings_left = 0;
  };
  [[nodiscard]] WorldPoint somewhere(const VehiclePose& pose, RandomStream& chance) const noexcept;
  void begin_some(const VehiclePose& pose, RandomStream& chance) noexcept;
  void draw_one(const Speck& speck, const VehiclePose& pose, EchoLevels& levels) const noexcept;

  static constexpr std::size_t kMost = 64;
  WaterKind kind_;
  EchoGrid grid_;
  Lasting<Speck, kMost> specks_;
};

}  // namespace lodesman
