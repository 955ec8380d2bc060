// SPDX-License-Identifier: Apache-2.0
// The sonar view: the paper's image of 866 x 500 pixels, in which a fan of 120 degrees is drawn
// and the path is searched. The only place where pixels become metres. Any thread.
#pragma once

#include <cmath>

#include "mid_level/base/frames.h"
#include "mid_level/messages/path.h"

namespace lodesman {

inline constexpr int kViewColumns = 866;
inline constexpr int kViewRows = 500;
inline constexpr int kApexColumn = 433;
inline constexpr int kApexRow = 499;
inline constexpr int kFanRadiusPx = 500;

// The size of a view and of the fan in it. Only tests and benches have any but the sonar's own.
struct FanShape {
  int columns = kViewColumns;     // [px]
  int rows = kViewRows;           // [px]
  int apex_column = kApexColumn;  // [px]
  int apex_row = kApexRow;        // [px]
  int radius_px = kFanRadiusPx;   // [px]

  // In the fan: dx^2 + dy^2 <= radius^2 and dx^2 <= 3 dy^2 (60 degrees to each side).
  [[nodiscard]] constexpr bool holds(int column, int row) const noexcept {
    const int dx = column - apex_column;
    const int dy = apex_row - row;
    return column >= 0 && column < columns && row >= 0 && row < rows &&
           dx * dx + dy * dy <= radius_px * radius_px && dx * dx <= 3 * dy * dy;
  }
};

[[nodiscard]] constexpr bool in_fan(int column, int row) noexcept {
  return FanShape{}.holds(column, row);
}

// The view at a range setting; the vehicle's origin is the apex pixel's centre.
class SonarView {
 public:
  explicit SonarView(double range_m) noexcept : metres_per_pixel_{range_m / kFanRadiusPx} {}

  [[nodiscard]] double metres_per_pixel() const noexcept { return metres_per_pixel_; }

  // The centre of a pixel.
  [[nodiscard]] VehiclePoint to_vehicle(PathPixel pixel) const noexcept {
    return {{(pixel.column - kApexColumn) * metres_per_pixel_,
             (kApexRow - pixel.row) * metres_per_pixel_}};
  }
  // Pixel coordinates of a point, before rounding to a pixel; may lie far outside the view.
  [[nodiscard]] double column_of(double x_m) const noexcept {
    return kApexColumn + x_m / metres_per_pixel_;
  }
  [[nodiscard]] double row_of(double y_m) const noexcept {
    return kApexRow - y_m / metres_per_pixel_;
  }

 private:
  double metres_per_pixel_;  // [m/px] 0.06 at 30 m
};

}  // namespace lodesman
