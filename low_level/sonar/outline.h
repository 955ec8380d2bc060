// SPDX-License-Identifier: Apache-2.0
// The shape of an echo: its near and its far edge, beam by beam, as a polygon; or an ellipse, where
// it is too small for an outline to say more. One thread; allocates when made and never after.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "low_level/sonar/blob.h"
#include "low_level/sonar/bright_runs.h"
#include "mid_level/messages/obstacle.h"

namespace lodesman {

class EchoOutline {
 public:
  // [m] An echo that is shorter each way is an ellipse, which says as much of it.
  explicit EchoOutline(double longest_ellipse_m);

  // Its runs, beam by beam. Fills the shape alone: neither zone nor peak.
  void trace(const PolarGrid& grid, std::span<const BrightRun> runs, Obstacle& out) noexcept;
  [[nodiscard]] double nearest_m() const noexcept { return nearest_m_; }

 private:
  struct Edges {  // [-] in bins, of one beam
    double near = 0.0;
    double far = 0.0;
    bool any = false;
  };

  void take_edges(std::span<const BrightRun> runs) noexcept;
  void bridge_silent_beams() noexcept;
  [[nodiscard]] std::uint32_t chain(const PolarGrid& grid, bool near_side) noexcept;
  void write_polygon(const PolarGrid& grid, Obstacle& out) noexcept;
  void write_ellipse(const PolarGrid& grid, std::span<const BrightRun> runs,
                     Obstacle& out) noexcept;

  double longest_ellipse_m_;
  std::uint32_t first_beam_ = 0;
  std::uint32_t beams_ = 0;
  double nearest_m_ = 0.0;
  std::array<Edges, EchoPlane::kMaxAcross> edges_{};
  std::array<Vertex, EchoPlane::kMaxAcross + 2> line_{};
  std::vector<std::uint32_t> cells_;
};

}  // namespace lodesman
