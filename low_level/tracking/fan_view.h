// SPDX-License-Identifier: Apache-2.0
// Up to where each beam of a ping saw nothing: what tells an obstacle that is gone from one that is
// hidden. One thread; allocates nothing.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "mid_level/base/frames.h"
#include "mid_level/messages/sonar.h"

namespace lodesman {

// Which ends of what was seen, as one looks along the beams, need not be the thing's own: the fan
// ends there, or something nearer hides the rest.
struct CutEnds {
  bool port = false;
  bool starboard = false;
};

class FanView {
 public:
  // The ping's beams, and its obstacles in the head's frame. Nothing is heard nearer than
  // `nearest_m`. Beams for which `blind` is not 0 saw nothing at all; empty: none is.
  void set(const SonarPing& ping, const SonarObstacles& seen, double nearest_m,
           std::span<const std::uint8_t> blind = {}) noexcept;

  [[nodiscard]] std::span<const float> clear_m() const noexcept {
    return std::span{clear_m_}.first(beams_);
  }
  // Of the beams that show that nothing is there: at the fan's ends too little of a thing is in
  // view for it to be found.
  [[nodiscard]] std::span<const float> sure_clear_m() const noexcept {
    return clear_m().subspan(unsure_beams(), beams_ - 2 * unsure_beams());
  }
  [[nodiscard]] double sure_first_bearing_rad() const noexcept {
    return first_bearing_rad_ + unsure_beams() * beam_step_rad_;
  }
  [[nodiscard]] double beam_step_rad() const noexcept { return beam_step_rad_; }
  [[nodiscard]] double nearest_m() const noexcept { return nearest_m_; }
  [[nodiscard]] double farthest_m() const noexcept { return farthest_m_; }
  // [-] [0, 1] of an ellipse [head's frame] that this ping could show: 0 outside of the fan, in
  // blind beams, behind what is nearer, or at the fan's edge.
  [[nodiscard]] double visible_share(const Obstacle& ellipse) const noexcept;

  // Of an obstacle of this ping [head's frame].
  [[nodiscard]] CutEnds cut_ends(const Obstacle& o) const noexcept;

 private:
  static constexpr std::uint32_t kUnsureBeams = 4;
  // At either end.
  [[nodiscard]] std::uint32_t unsure_beams() const noexcept {
    return std::min(kUnsureBeams, beams_ / 4);
  }
  void shade(double beam, double range_m) noexcept;
  void shade_edge(const Eigen::Vector2d& from, const Eigen::Vector2d& to) noexcept;
  void shade_shape(const Obstacle& o) noexcept;
  void limit_to_listed(const SonarObstacles& seen) noexcept;
  void limit_to_returns(const SonarPing& ping) noexcept;
  [[nodiscard]] double beam_at(double x_m, double y_m) const noexcept;
  [[nodiscard]] bool is_hidden(double beam, double range_m) const noexcept;

  std::uint32_t beams_ = 0;
  double first_bearing_rad_ = 0.0;
  double beam_step_rad_ = 0.0;
  double nearest_m_ = 0.0;
  double farthest_m_ = 0.0;
  std::array<float, kMaxBeams> clear_m_{};
};

}  // namespace lodesman
