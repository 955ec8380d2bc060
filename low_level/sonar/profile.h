// SPDX-License-Identifier: Apache-2.0
// Obstacles from a profile: a range a beam. Returns of beams side by side belong to one surface
// where they are no farther apart than those of a surface that is met at the least incidence, with
// three standard deviations of their noise (the adaptive breakpoint detector of Borges and Aldon,
// 2004, equation 5) and a step of the head's ranges. By contrast a long run is a line along its
// returns; any other is a blob. A profile has the near side alone: of a short run that bulges
// towards the head the far side is taken to lie as far behind the line between its ends as the near
// side lies before it, so that a round stone is one ellipse, and not one a flank. One thread;
// allocates nothing once made.
#pragma once

#include <array>
#include <vector>

#include "low_level/sonar/blob_obstacles.h"
#include "low_level/sonar/thin_line.h"

namespace lodesman {

class ProfileDetector {
 public:
  explicit ProfileDetector(const SegmentationOptions& options);

  // Obstacles nearest first; of more than kMaxObstacles the farthest are dropped and counted. A
  // ping that is no profile, or breaks its own ranges, gives none.
  void detect(const SonarPing& ping, SonarObstacles& out) noexcept;

 private:
  void take_runs(const SonarPing& ping) noexcept;
  void end_run() noexcept;
  [[nodiscard]] bool is_long() const noexcept;
  void add_line() noexcept;
  void fill_far_side() noexcept;
  [[nodiscard]] bool fill_beam(std::uint32_t cell, double chord_m) noexcept;
  [[nodiscard]] bool is_return(const SonarPing& ping, std::uint32_t beam) const noexcept;
  [[nodiscard]] bool is_one_surface(const SonarPing& ping, std::uint32_t beam,
                                    std::uint32_t next) const noexcept;

  SegmentationOptions options_;
  BlobObstacles blobs_;
  PolarGrid grid_;
  std::vector<std::uint8_t> strength_;  // of each beam
  std::vector<std::uint32_t> cells_;    // of the run at hand
  std::array<Vertex, kMostLinePoints> line_{};
};

}  // namespace lodesman
