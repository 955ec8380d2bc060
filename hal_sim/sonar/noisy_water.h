// SPDX-License-Identifier: Apache-2.0
// What a multibeam sonar hears in real water, for the simulated sonar: the scene's surfaces amid
// noise with the statistics of real frames (docs/sonar_simulation.md). The same seed, scene and
// order of pings give the same echoes. The boat is taken to stand still for as long as a ping
// takes. One thread; allocates when made and never after.
#pragma once

#include <cstdint>

#include "hal_sim/sonar/clutter.h"
#include "hal_sim/sonar/echo_levels.h"
#include "hal_sim/sonar/ghosts.h"
#include "hal_sim/sonar/heard_scene.h"
#include "hal_sim/sonar/speckle.h"
#include "hal_sim/sonar/stripes.h"
#include "hal_sim/sonar/surface_echoes.h"
#include "hal_sim/sonar/water_kind.h"
#include "hal_sim/sonar/water_level.h"
#include "mid_level/messages/sonar.h"

namespace lodesman {

class NoisyWater {
 public:
  // All pings that are drawn have this grid.
  NoisyWater(const WaterKind& kind, const EchoGrid& grid, std::uint64_t seed);

  // Whether the next ping never comes.
  [[nodiscard]] bool loses_ping() noexcept;
  // The echoes of a ping that was made an image of the grid, of a scene that was observed.
  void draw(const HeardScene& scene, SonarPing& ping) noexcept;

 private:
  WaterKind kind_;
  RandomStream chance_;
  SpeckleField speckle_;
  WaterLevel water_;
  SurfaceEchoes surfaces_;
  Ghosts ghosts_;
  Clutter clutter_;
  Stripes stripes_;
  EchoLevels levels_;
};

}  // namespace lodesman
