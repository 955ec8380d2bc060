// SPDX-License-Identifier: Apache-2.0
#include "low_level/tracking/seen_water.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace lodesman {
namespace {

// Cells of the grid along the side of one of the coverage's.
constexpr int kFine = static_cast<int>(Coverage::kCell_m / EvidenceGrid::kCell_m);
constexpr std::size_t kFineSide = kFine * Coverage::kSide;

using FineRow = std::array<WaterState, kFineSide>;

[[nodiscard]] WaterState of_both(WaterState a, WaterState b) noexcept {
  if (a == WaterState::kOccupied || b == WaterState::kOccupied) {
    return WaterState::kOccupied;
  }
  return a == WaterState::kFree && b == WaterState::kFree ? WaterState::kFree
                                                          : WaterState::kUnknown;
}

// [-] of the cells, the first that one of the coverage's begins with.
[[nodiscard]] int first_cell(double middle_m) noexcept {
  const double coarse = std::floor(middle_m / Coverage::kCell_m) - Coverage::kSide / 2.0;
  return kFine * static_cast<int>(coarse);
}

void free_around(const Eigen::Vector2d& head, double radius_m, Coverage& out) noexcept {
  const auto index = [](double metres) noexcept {
    return static_cast<std::size_t>(std::clamp(std::floor(metres / Coverage::kCell_m), 0.0,
                                               static_cast<double>(Coverage::kSide - 1)));
  };
  const Eigen::Vector2d in_square = head - Eigen::Vector2d{out.west_x_m, out.south_y_m};
  for (auto row = index(in_square.y() - radius_m); row <= index(in_square.y() + radius_m); ++row) {
    for (auto column = index(in_square.x() - radius_m); column <= index(in_square.x() + radius_m);
         ++column) {
      const Eigen::Vector2d middle{(static_cast<double>(column) + 0.5) * Coverage::kCell_m,
                                   (static_cast<double>(row) + 0.5) * Coverage::kCell_m};
      const Eigen::Vector2d at{out.west_x_m + middle.x(), out.south_y_m + middle.y()};
      if ((middle - in_square).norm() <= radius_m &&
          out.at(at.x(), at.y()) == WaterState::kUnknown) {
        out.set(column, row, WaterState::kFree);
      }
    }
  }
}

}  // namespace

void describe_water(const EvidenceGrid& grid, const Eigen::Vector2d& head, double now_s,
                    double nearest_m, Coverage& out) noexcept {
  out.cells.fill(0);
  if (!EvidenceGrid::is_place(head.x(), head.y())) {
    return;
  }
  const int column0 = first_cell(head.x());
  const int row0 = first_cell(head.y());
  out.west_x_m = column0 * EvidenceGrid::kCell_m;
  out.south_y_m = row0 * EvidenceGrid::kCell_m;
  FineRow lower{};
  FineRow upper{};
  for (std::size_t row = 0; row < Coverage::kSide; ++row) {
    const int fine_row = row0 + kFine * static_cast<int>(row);
    grid.read_row(column0, fine_row, now_s - kFreeFor_s, lower);
    grid.read_row(column0, fine_row + 1, now_s - kFreeFor_s, upper);
    for (std::size_t column = 0; column < Coverage::kSide; ++column) {
      const std::size_t at = kFine * column;
      out.set(column, row,
              of_both(of_both(lower[at], lower[at + 1]), of_both(upper[at], upper[at + 1])));
    }
  }
  // A cell counts by its middle: half its diagonal more.
  free_around(head, nearest_m + std::sqrt(0.5) * Coverage::kCell_m, out);
}

}  // namespace lodesman
