// SPDX-License-Identifier: Apache-2.0
// Speed through the water, current and the heading sensor's offset from straight runs there and
// back: over ground, the boat's own speed turns with it and the current does not. One thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace lodesman::cli {

// A straight run: a place and a heading now and then, and the straight line through them by least
// squares.
class StraightRun {
 public:
  void add(double time_s, double x_m, double y_m, double heading_rad);

  [[nodiscard]] std::size_t count() const noexcept { return count_; }
  // Over ground; 0 without two places at two times.
  [[nodiscard]] double x_m_s() const noexcept { return slope(sum_tx_, sum_x_); }
  [[nodiscard]] double y_m_s() const noexcept { return slope(sum_ty_, sum_y_); }
  // The mean heading, as a direction: x east, y north.
  [[nodiscard]] double heading_x() const noexcept;
  [[nodiscard]] double heading_y() const noexcept;

 private:
  [[nodiscard]] double slope(double sum_product, double sum) const noexcept;

  std::size_t count_ = 0;
  double first_s_ = 0.0;
  double sum_t_ = 0.0, sum_tt_ = 0.0;
  double sum_x_ = 0.0, sum_tx_ = 0.0;
  double sum_y_ = 0.0, sum_ty_ = 0.0;
  double sum_sine_ = 0.0, sum_cosine_ = 0.0;
};

// What a run there and one back at the same SurgeRef tell.
struct PairOfRuns {
  int surge_ref = 0;
  double speed_m_s = 0.0;           // through the water
  double heading_offset_rad = 0.0;  // what the sensor says beyond where the boat goes
  double current_x_m_s = 0.0;       // east
  double current_y_m_s = 0.0;       // north
};

// Nothing where the runs are too short, or not there and back.
[[nodiscard]] std::optional<PairOfRuns> compare(int surge_ref, const StraightRun& there,
                                                const StraightRun& back) noexcept;

struct Calibration {
  std::vector<PairOfRuns> pairs;  // those that rise in speed, by SurgeRef
  double heading_offset_rad = 0.0;
};

// The pairs in order, without those that are not faster than the one before; the offset weighed
// with the speed.
[[nodiscard]] Calibration calibration_of(std::vector<PairOfRuns> pairs);

// To be pasted into a boat's configuration. `has_mounting`: it has such a section.
[[nodiscard]] std::string to_toml(const Calibration& calibration, bool has_mounting);

}  // namespace lodesman::cli
