// SPDX-License-Identifier: Apache-2.0
// Obstacles from an image ping by contrast: cells brighter than what their range shows in most
// beams, joined to echoes, each with its outline. No absolute level decides anything. One thread
// owns a ContrastDetector; it allocates when made and never after.
#pragma once

#include <array>
#include <cstdint>

#include "low_level/sonar/blob_obstacles.h"
#include "low_level/sonar/bright_runs.h"
#include "low_level/sonar/echo_plane.h"
#include "low_level/sonar/outline.h"
#include "low_level/sonar/range_levels.h"
#include "mid_level/messages/sonar.h"

namespace lodesman {

class ContrastDetector {
 public:
  explicit ContrastDetector(const SegmentationOptions& options);

  // Obstacles nearest first. None is ever left out: where there are more than kMaxObstacles,
  // neighbours become one. A ping that breaks its own ranges, or is a profile, gives none.
  void detect(const SonarPing& ping, SonarObstacles& out) noexcept;

 private:
  void set_grid(const SonarPing& ping) noexcept;
  [[nodiscard]] double peak_of(const SonarPing& ping, const EchoSum& echo) const noexcept;
  void write(const SonarPing& ping, SonarObstacles& out) noexcept;

  SegmentationOptions options_;
  EchoPlane plane_;
  RangeLevels levels_;
  BrightRuns runs_;
  EchoOutline outline_;
  PolarGrid grid_;
  std::array<Obstacle, kMaxObstacles> found_{};
};

}  // namespace lodesman
