// SPDX-License-Identifier: Apache-2.0
// The boat's own calibration: the steady speed through the water that each SurgeRef settles at, as
// measured on straight runs. Plain values; any thread.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>

namespace lodesman {

inline constexpr int kMaxSurgeRef = 100;

struct SpeedPoint {
  double surge_ref = 0.0;  // (0, 100]
  double speed_m_s = 0.0;  // > 0
};

// A SurgeRef and the speed that it holds.
struct HeldSpeed {
  int surge_ref = 0;
  double speed_m_s = 0.0;
};

// A speed that is asked for must be within this share of one that a SurgeRef holds.
inline constexpr double kSpeedTolerance = 0.03;

// Straight lines from point to point, the first from rest; beyond the last point the line from rest
// through it. Astern as ahead, but for the sign.
class SpeedTable {
 public:
  static constexpr std::size_t kMaxPoints = 16;

  // 1 to kMaxPoints points, each with more of both than the one before it.
  explicit SpeedTable(std::span<const SpeedPoint> points);
  // The paper's eqs 24-25: k [m/s] > 0 for each unit of SurgeRef.
  [[nodiscard]] static SpeedTable proportional(double k_m_s);

  // surge_ref: [-100, 100].
  [[nodiscard]] double speed_m_s(int surge_ref) const noexcept;
  // The SurgeRef in [1, 100] whose speed is nearest.
  [[nodiscard]] HeldSpeed held(double speed_m_s) const noexcept;
  // Why a speed that is asked for cannot be held, in words; empty where it can.
  [[nodiscard]] std::string objection(double speed_m_s) const;
  // The largest SurgeRef in [1, 100] whose speed is no more; 1 where even that is faster.
  [[nodiscard]] HeldSpeed held_at_most(double speed_m_s) const noexcept;

 private:
  std::array<SpeedPoint, kMaxPoints> points_{};
  std::size_t count_ = 0;
};

}  // namespace lodesman
