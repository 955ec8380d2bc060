// SPDX-License-Identifier: Apache-2.0
// Interference along a bearing: faint rays that stay for long, and dashed stripes now and then.
// They belong to the head, and turn with it. One thread; never allocates.
#pragma once

#include <cstdint>

#include "hal_sim/sonar/echo_levels.h"
#include "hal_sim/sonar/lasting.h"

namespace lodesman {

class Stripes {
 public:
  Stripes(const WaterKind& kind, const EchoGrid& grid) : kind_{kind}, grid_{grid} {}

  // Adds to levels whose water is drawn.
  void draw(EchoLevels& levels, RandomStream& chance) noexcept;

 private:
  struct Ray {
    double beam = 0.0;
    double half_beams = 0.0;
    float times_water = 0.0F;  // [-] above it
    std::uint32_t pings_left = 0;
  };
  struct Dashed {
    std::uint32_t first_beam = 0;
    std::uint32_t beams = 0;
    float level = 0.0F;  // [-] of 255
    std::uint32_t pings_left = 0;
  };
  void begin_some(RandomStream& chance) noexcept;
  void draw_ray(const Ray& ray, EchoLevels& levels) const noexcept;
  void draw_dashes(const Dashed& stripe, EchoLevels& levels, RandomStream& chance) const noexcept;

  static constexpr std::size_t kMostRays = 4;  // as many as were seen at once
  static constexpr std::size_t kMostDashed = 1;
  WaterKind kind_;
  EchoGrid grid_;
  Lasting<Ray, kMostRays> rays_;
  Lasting<Dashed, kMostDashed> dashed_;
};

}  // namespace lodesman
