// SPDX-License-Identifier: Apache-2.0
// The cells of an image ping that its health is judged by, the same ones of each ping, and what
// they add up to beam by beam. Part of PingWatch; one thread; allocates when made and never after.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mid_level/messages/sonar.h"

namespace lodesman {

// A beam from behind the nearest metres on is cut in blocks of equal depth, and the first cells of
// each are taken, so that the work does not grow with the bins.
class PingSample {
 public:
  static constexpr std::uint32_t kBlocks = 16;
  static constexpr std::uint32_t kCells = 16;  // of a block
  static constexpr std::uint32_t kLeastBeams = 16;
  using Levels = std::array<float, kBlocks>;  // [0, 255] the mean echo of each block of a beam

  PingSample();

  // False where the ping is no image, breaks its own ranges or is too small to be judged.
  [[nodiscard]] bool take(const SonarPing& ping) noexcept;

  // Of the last ping that was taken. The beams, or what they reach, are not those of the one
  // before.
  [[nodiscard]] bool is_another_fan() const noexcept { return is_another_fan_; }
  [[nodiscard]] std::uint32_t beams() const noexcept { return fan_.beams; }
  [[nodiscard]] const Levels& levels(std::uint32_t beam) const noexcept { return levels_[beam]; }
  // [0, 255] The mean of a beam's blocks, and of its nearest cells.
  [[nodiscard]] std::span<const float> far() const noexcept { return all(far_); }
  [[nodiscard]] std::span<const float> near() const noexcept { return all(near_); }
  // [-] [0, 1] of a beam's cells that are not 0.
  [[nodiscard]] float lit_share(std::uint32_t beam) const noexcept { return lit_[beam]; }
  // [-] [0, 1] of all cells that are all but the brightest value there is.
  [[nodiscard]] double white_share() const noexcept { return white_share_; }
  // Each cell is as in the ping before.
  [[nodiscard]] bool repeats() const noexcept;
  // Of the cells that are not 0 enough are unlike the one before them in their beam: what is heard
  // of water is, what is drawn is not.
  [[nodiscard]] bool is_speckled() const noexcept;

 private:
  static constexpr std::size_t kCellsOfBeam = std::size_t{kBlocks} * kCells;
  struct Fan {
    std::uint32_t beams = 0;
    std::uint32_t bins = 0;
    std::uint32_t near_end = 0;   // [bin]
    std::uint32_t far_begin = 0;  // [bin]
    float range_m = 0.0F;
    float first_bearing_rad = 0.0F;

    friend bool operator==(const Fan&, const Fan&) = default;
  };

  template <class T>
  [[nodiscard]] std::span<const T> all(const std::array<T, kMaxBeams>& values) const noexcept {
    return std::span{values}.first(fan_.beams);
  }
  void gather(const SonarPing& ping) noexcept;
  void add_up(const SonarPing& ping) noexcept;

  Fan fan_;
  bool is_another_fan_ = true;
  std::uint32_t cells_of_block_ = 0;
  std::vector<std::uint8_t> cells_;
  std::vector<std::uint8_t> before_;  // the cells of the ping before
  std::array<Levels, kMaxBeams> levels_{};
  std::array<float, kMaxBeams> far_{};
  std::array<float, kMaxBeams> near_{};
  std::array<float, kMaxBeams> lit_{};
  double white_share_ = 0.0;
};

}  // namespace lodesman
