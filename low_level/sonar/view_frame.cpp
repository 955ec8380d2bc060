// SPDX-License-Identifier: Apache-2.0
// Rings, path, marks and captions of a sonar view.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "low_level/sonar/view_layers.h"

namespace lodesman::view {
namespace {

constexpr double kCaptionText = 0.45;

// A step of the rings that gives three to seven of them.
[[nodiscard]] double ring_step_m(double range_m) {
  const double power = std::pow(10.0, std::floor(std::log10(range_m)));
  for (const double step : {0.2, 0.5, 1.0, 2.0}) {
    if (range_m / (step * power) <= 7.0) {
      return step * power;
    }
  }
  return 2.0 * power;
}

// Beside the fan's right edge, where they hide nothing.
void label_rings(cv::Mat& image, double range_m) {
  const SonarView view{range_m};
  const double step_m = ring_step_m(range_m);
  const int rings = static_cast<int>(std::floor(range_m / step_m + 1e-9));
  for (int ring = 1; ring <= rings; ++ring) {
    const double r = ring * step_m;
    std::array<char, 32> label{};
    std::snprintf(label.data(), label.size(), "%g m", r);
    cv::Point at = whole_pixel(view, r * std::sin(kFanHalf_rad), r * std::cos(kFanHalf_rad));
    at += cv::Point{6, 14};
    at.x = std::min(at.x, kViewColumns - 48);
    write_text(image, label.data(), at, kSmallText);
  }
}

void mark_goal(cv::Mat& image, const ViewPicture& picture) {
  const SonarView view{picture.range_m};
  const double x_m = picture.goal->xy_m.x();
  const double y_m = picture.goal->xy_m.y();
  if (!std::isfinite(x_m) || !std::isfinite(y_m)) {
    return;
  }
  const double distance_m = std::hypot(x_m, y_m);
  const double bearing_rad = std::atan2(x_m, y_m);
  const double shown_m = std::min(distance_m, picture.range_m);
  const double shown_rad = std::clamp(bearing_rad, -kFanHalf_rad, kFanHalf_rad);
  const bool in_view = distance_m <= picture.range_m && std::abs(bearing_rad) <= kFanHalf_rad;
  const cv::Point at =
      whole_pixel(view, shown_m * std::sin(shown_rad), shown_m * std::cos(shown_rad));
  draw_goal_mark(image, at, in_view);
  if (!in_view) {
    std::array<char, 48> label{};
    std::snprintf(label.data(), label.size(), "goal out of view: %.1f m", distance_m);
    const int width = text_box(label.data(), {0, 0}, kSmallText).width;
    const int left = at.x < kApexColumn ? at.x + 16 : at.x - 16 - width;  // towards the middle
    write_text(image, label.data(),
               {std::clamp(left, 4, kViewColumns - width - 4), std::clamp(at.y + 4, 60, 480)},
               kSmallText);
  }
}

void write_caption(cv::Mat& image, std::string_view caption) {
  int row = 20;
  for (std::size_t begin = 0; begin < caption.size(); row += 20) {
    const std::size_t end = std::min(caption.find('\n', begin), caption.size());
    write_text(image, std::string{caption.substr(begin, end - begin)}, {10, row}, kCaptionText);
    begin = end + 1;
  }
}

}  // namespace

void draw_rings(cv::Mat& image, const ViewPicture& picture) {
  const SonarView view{picture.range_m};
  const cv::Scalar colour =
      bgr(picture.is_chart() ? view_colours::kChartRing : view_colours::kRing);
  const cv::Point apex{kApexColumn, kApexRow};
  const double step_m = ring_step_m(picture.range_m);
  const int rings = static_cast<int>(std::floor(picture.range_m / step_m + 1e-9));
  for (int ring = 1; ring <= rings; ++ring) {
    const int radius = static_cast<int>(std::lround(ring * step_m / view.metres_per_pixel()));
    cv::ellipse(image, apex, {radius, radius}, -90.0, -60.0, 60.0, colour, 1, cv::LINE_AA);
  }
  for (const double bearing_rad :
       {-kFanHalf_rad, -kFanHalf_rad / 2.0, 0.0, kFanHalf_rad / 2.0, kFanHalf_rad}) {
    const cv::Point end = whole_pixel(view, picture.range_m * std::sin(bearing_rad),
                                      picture.range_m * std::cos(bearing_rad));
    cv::line(image, apex, end, colour, 1, cv::LINE_AA);
  }
  cv::ellipse(image, apex, {kFanRadiusPx, kFanRadiusPx}, -90.0, -60.0, 60.0, colour, 1,
              cv::LINE_AA);
}

void draw_path_line(cv::Mat& image, const std::vector<cv::Point>& pixels) {
  if (!pixels.empty()) {
    cv::polylines(image, pixels, false, bgr(view_colours::kBlack), 5, cv::LINE_AA);
    cv::polylines(image, pixels, false, bgr(view_colours::kPath), 2, cv::LINE_AA);
  }
}

void draw_start_mark(cv::Mat& image, cv::Point at) {
  cv::circle(image, at, 7, bgr(view_colours::kBlack), cv::FILLED, cv::LINE_AA);
  cv::circle(image, at, 5, bgr(view_colours::kText), cv::FILLED, cv::LINE_AA);
}

void draw_goal_mark(cv::Mat& image, cv::Point at, bool in_view) {
  cv::drawMarker(image, at, bgr(view_colours::kBlack), cv::MARKER_TILTED_CROSS, 18, 6, cv::LINE_AA);
  cv::drawMarker(image, at, bgr(view_colours::kText), cv::MARKER_TILTED_CROSS, 16, in_view ? 3 : 1,
                 cv::LINE_AA);
}

void draw_path(cv::Mat& image, const ViewPicture& picture) {
  std::vector<cv::Point> line;
  for (const PathPixel& pixel : picture.path) {
    line.emplace_back(pixel.column, pixel.row);
  }
  draw_path_line(image, line);
  draw_start_mark(image, {kApexColumn, kApexRow});
  if (picture.goal) {
    mark_goal(image, picture);
  }
}

void draw_labels(cv::Mat& image, const ViewPicture& picture) {
  label_rings(image, picture.range_m);
  write_caption(image, picture.caption);
}

}  // namespace lodesman::view
