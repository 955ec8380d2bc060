// SPDX-License-Identifier: Apache-2.0
// Which water was seen. Free water is left as it is, and what nobody has seen is hatched; where no
// beam of this ping looks it is dark already, and free water is as where nothing is heard.
#include "low_level/sonar/view_layers.h"

namespace lodesman::view {
namespace {

constexpr int kHatchPx = 9;  // from one line to the next along a row

// [0, 1] of a line that rises to starboard.
[[nodiscard]] double hatching(int column, int row) {
  constexpr double kBeside = 0.35;  // of a smooth line's neighbours
  const int off = (column + row) % kHatchPx;
  return off == 0 ? 1.0 : (off == 1 || off == kHatchPx - 1 ? kBeside : 0.0);
}

}  // namespace

void hatch(cv::Vec3b& pixel, int column, int row) {
  const double line = 0.7 * hatching(column, row);
  const cv::Scalar colour = bgr(view_colours::kHatch);
  for (int i = 0; i < 3; ++i) {
    const double shaded = view_colours::kUnseenLight * pixel[i];
    pixel[i] = static_cast<std::uint8_t>(shaded + line * (colour[i] - shaded));
  }
}

void draw_water(cv::Mat& image, const cv::Mat& fan, const cv::Mat& heard,
                const ViewPicture& picture) {
  if (!picture.water || !picture.is_chart()) {
    return;
  }
  const SonarView view{picture.range_m};
  cv::Mat occupied = empty_mask();
  for (int row = 0; row < kViewRows; ++row) {
    for (int column = 0; column < kViewColumns; ++column) {
      if (fan.at<std::uint8_t>(row, column) == 0) {
        continue;
      }
      const WaterState state = picture.water(place_of(view, column, row));
      const bool is_heard = !heard.empty() && heard.at<std::uint8_t>(row, column) != 0;
      cv::Vec3b& pixel = image.at<cv::Vec3b>(row, column);
      if (state == WaterState::kFree && !is_heard) {
        pixel = cv::Vec3b{view_colours::kFaintest.blue, view_colours::kFaintest.green,
                          view_colours::kFaintest.red};
      } else if (state == WaterState::kUnknown && (is_heard || heard.empty())) {
        hatch(pixel, column, row);
      }
      occupied.at<std::uint8_t>(row, column) = state == WaterState::kOccupied ? 255 : 0;
    }
  }
  tint(image, fan, occupied, view_colours::kRests, view_colours::kRestsOpacity);
}

}  // namespace lodesman::view
