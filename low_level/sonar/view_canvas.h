// SPDX-License-Identifier: Apache-2.0
// What the layers of a sonar view are drawn with: places as pixels, masks, text. For view_*.cpp
// alone, which run on any best-effort thread and never in a real-time task.
#pragma once

#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "low_level/sonar/view_colours.h"
#include "mid_level/geometry/sonar_view.h"
#include "mid_level/messages/obstacle.h"

namespace lodesman::view {

inline constexpr int kShift = 4;  // OpenCV draws in sixteenths of a pixel
inline constexpr double kSmallText = 0.4;
inline constexpr double kFanHalf_rad = std::numbers::pi / 3.0;

using Outline = std::vector<cv::Point>;  // in sixteenths of a pixel

// As OpenCV has it: blue, green, red.
[[nodiscard]] cv::Scalar bgr(const ViewColour& colour);

// Coordinates are cut far outside the view.
[[nodiscard]] cv::Point subpixel(const SonarView& view, double x_m, double y_m);
[[nodiscard]] cv::Point whole_pixel(const SonarView& view, double x_m, double y_m);

// The vehicle frame at a pixel's centre.
[[nodiscard]] VehiclePoint place_of(const SonarView& view, int column, int row);

[[nodiscard]] cv::Mat fan_mask();    // 1 in the fan, exactly as the planner sees it
[[nodiscard]] cv::Mat empty_mask();  // of the view's size

// On a dark casing, from the left end of its base line.
void write_text(cv::Mat& image, const std::string& text, cv::Point at, double size,
                const ViewColour& colour = view_colours::kText);
// The box that it takes, casing included.
[[nodiscard]] cv::Rect text_box(const std::string& text, cv::Point at, double size);

// A line round the outline, or along it, on a black casing.
void draw_outline(cv::Mat& image, const Outline& outline, bool closed, const ViewColour& colour,
                  int width);
// Dashes of it, from its first corner on: what is less sure.
void draw_dashed(cv::Mat& image, const Outline& outline, bool closed, const ViewColour& colour,
                 int width);
// Tints a mask's area within the fan.
void tint(cv::Mat& image, const cv::Mat& fan, const cv::Mat& mask, const ViewColour& colour,
          double opacity);
// The same, and draws its edge. Overlapping shapes are one area, as zones
// are to the planner.
void paint(cv::Mat& image, const cv::Mat& fan, const cv::Mat& mask, const ViewColour& fill,
           const ViewColour& edge, double opacity);

// Whether an obstacle has a place and a size.
[[nodiscard]] bool is_drawable(const Obstacle& o);
// An ellipse by its semi-axes round the obstacle's centre, the first clockwise from ahead.
[[nodiscard]] Outline ellipse_outline(const SonarView& view, const Obstacle& o, double first_m,
                                      double second_m);
// A wall's vertices.
[[nodiscard]] Outline wall_outline(const SonarView& view, const Obstacle& wall);
// Sets the pixels of the obstacle, or of its protection zone.
void fill_shape(cv::Mat& mask, const SonarView& view, const Obstacle& o, bool protection);
// The body of any obstacle.
[[nodiscard]] Outline body_outline(const SonarView& view, const Obstacle& o);
[[nodiscard]] bool is_closed(const Obstacle& o);

}  // namespace lodesman::view
