// SPDX-License-Identifier: Apache-2.0
// What a multibeam sonar at the vehicle's origin, looking ahead, hears: in each beam a clean echo
// of the nearest surface and nothing behind it; what real water adds is noisy_water.h's. Shared by
// the simulated sonar and by what stands in for a real one to the byte. One thread; nothing here
// allocates once it is made, or throws.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "hal_sim/sonar/echo.h"
#include "mid_level/base/frames.h"
#include "mid_level/geometry/moving_obstacle.h"

namespace lodesman {

// What a ray meets first; `obstacle` is null where it meets nothing, and valid up to the next
// observe().
struct HeardSurface {
  SurfaceHit hit;
  const Obstacle* obstacle = nullptr;
};

class HeardScene {
 public:
  explicit HeardScene(std::vector<MovingObstacle> obstacles);

  // The sonar is there at that time of the scenario: what exists then is where it is then.
  void observe(const VehiclePose& pose, double scenario_time_s) noexcept;
  // [m] to the nearest surface along a ray [rad], clockwise from straight ahead; infinity: none.
  [[nodiscard]] double range_m(double bearing_rad) const noexcept;
  // The same with how the ray meets it.
  [[nodiscard]] HeardSurface surface(double bearing_rad) const noexcept;

  [[nodiscard]] const VehiclePose& pose() const noexcept { return pose_; }
  // What there is, in the world.
  [[nodiscard]] std::span<const Obstacle> obstacles() const noexcept { return scene_; }

  // What a ray meets first.
  struct Surface {
    double range_m = std::numeric_limits<double>::infinity();  // [m] infinity: nothing
    std::size_t obstacle = 0;  // [-] whose surface, in the order in which they were given
  };
  // The same, as if each obstacle lay turned round the sonar by so much [rad], clockwise.
  [[nodiscard]] Surface nearest(double bearing_rad,
                                std::span<const double> turned_rad) const noexcept;

 private:
  std::vector<MovingObstacle> obstacles_;
  std::vector<Obstacle> scene_;     // room for all was made once
  std::vector<std::size_t> which_;  // of each in the scene: which obstacle it is
  VehiclePose pose_;
};

// Draws the echo of a surface into a silent beam whose bins reach `range_m` together, bin 0
// nearest; a surface that is not nearer than that leaves nothing.
void draw_echo(double surface_m, double range_m, std::span<std::uint8_t> bins) noexcept;

// [-] [0, 255] of the brightest bin of any echo.
inline constexpr std::uint8_t kBrightestEcho = 200;

}  // namespace lodesman
