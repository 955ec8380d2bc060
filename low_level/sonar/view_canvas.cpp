// SPDX-License-Identifier: Apache-2.0
#include "low_level/sonar/view_canvas.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lodesman::view {
namespace {

constexpr double kSubpixels = 1 << kShift;
constexpr double kFarPx = 20000.0;  // coordinates are cut here
constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
constexpr int kTextCasing = 3;  // [px] of the dark lines behind those of 1 px
constexpr double kDashPx = 6.0;
constexpr double kGapPx = 6.0;
constexpr double kLeastDashPx = 0.5;  // so that rounding never stands still

// Whether anything of a dash that begins or ends there may be in the picture.
[[nodiscard]] bool is_near(const cv::Mat& image, const cv::Point& at) {
  constexpr int kBeside = 16 << kShift;
  return at.x > -kBeside && at.y > -kBeside && at.x < (image.cols << kShift) + kBeside &&
         at.y < (image.rows << kShift) + kBeside;
}

// Those of an outline that may show, from its first corner on.
[[nodiscard]] std::vector<Outline> dashes_of(const cv::Mat& image, const Outline& outline,
                                             bool closed) {
  std::vector<Outline> dashes;
  const std::size_t sides = outline.size() < 2 ? 0 : outline.size() - (closed ? 0 : 1);
  double gone_px = 0.0;  // along the outline
  for (std::size_t i = 0; i < sides; ++i) {
    const cv::Point2d from = outline[i];
    const cv::Point2d way = cv::Point2d{outline[(i + 1) % outline.size()]} - from;
    const double length_px = std::hypot(way.x, way.y) / kSubpixels;
    const auto at = [&](double px) { return cv::Point{from + way * (px / length_px)}; };
    for (double px = 0.0; px < length_px;) {
      const double in_period = std::fmod(gone_px + px, kDashPx + kGapPx);
      const bool is_dash = in_period < kDashPx;
      const double left_px = (is_dash ? kDashPx : kDashPx + kGapPx) - in_period;
      const double end_px = std::min(length_px, px + std::max(left_px, kLeastDashPx));
      if (is_dash && (is_near(image, at(px)) || is_near(image, at(end_px)))) {
        dashes.push_back({at(px), at(end_px)});
      }
      px = end_px;
    }
    gone_px += length_px;
  }
  return dashes;
}

}  // namespace

cv::Scalar bgr(const ViewColour& colour) {
  return {static_cast<double>(colour.blue), static_cast<double>(colour.green),
          static_cast<double>(colour.red)};
}

cv::Point subpixel(const SonarView& view, double x_m, double y_m) {
  const auto cut = [](double px) {  // what is not a number is far away too
    const double near = px > -kFarPx ? std::min(px, kFarPx) : -kFarPx;
    return static_cast<int>(std::lround(near * kSubpixels));
  };
  return {cut(view.column_of(x_m)), cut(view.row_of(y_m))};
}

cv::Point whole_pixel(const SonarView& view, double x_m, double y_m) {
  const cv::Point fine = subpixel(view, x_m, y_m);
  return {fine.x >> kShift, fine.y >> kShift};
}

VehiclePoint place_of(const SonarView& view, int column, int row) {
  return view.to_vehicle({static_cast<std::int16_t>(column), static_cast<std::int16_t>(row)});
}

cv::Mat fan_mask() {
  cv::Mat mask = empty_mask();
  for (int row = 0; row < kViewRows; ++row) {
    for (int column = 0; column < kViewColumns; ++column) {
      mask.at<std::uint8_t>(row, column) = in_fan(column, row) ? 1 : 0;
    }
  }
  return mask;
}

cv::Mat empty_mask() { return {kViewRows, kViewColumns, CV_8U, cv::Scalar{0}}; }

void write_text(cv::Mat& image, const std::string& text, cv::Point at, double size,
                const ViewColour& colour) {
  cv::putText(image, text, at, kFont, size, bgr(view_colours::kOutside), kTextCasing, cv::LINE_AA);
  cv::putText(image, text, at, kFont, size, bgr(colour), 1, cv::LINE_AA);
}

cv::Rect text_box(const std::string& text, cv::Point at, double size) {
  int baseline = 0;
  const cv::Size box = cv::getTextSize(text, kFont, size, kTextCasing, &baseline);
  return {at.x - 1, at.y - box.height - 1, box.width + 2, box.height + baseline + 2};
}

void draw_outline(cv::Mat& image, const Outline& outline, bool closed, const ViewColour& colour,
                  int width) {
  if (outline.empty()) {
    return;
  }
  const std::vector<Outline> one{outline};
  cv::polylines(image, one, closed, bgr(view_colours::kBlack), width + 2, cv::LINE_AA, kShift);
  cv::polylines(image, one, closed, bgr(colour), width, cv::LINE_AA, kShift);
}

void draw_dashed(cv::Mat& image, const Outline& outline, bool closed, const ViewColour& colour,
                 int width) {
  const std::vector<Outline> dashes = dashes_of(image, outline, closed);
  if (width > 1) {  // a fine line would be lost on it
    cv::polylines(image, dashes, false, bgr(view_colours::kBlack), width + 2, cv::LINE_AA, kShift);
  }
  cv::polylines(image, dashes, false, bgr(colour), width, cv::LINE_AA, kShift);
}

void tint(cv::Mat& image, const cv::Mat& fan, const cv::Mat& mask, const ViewColour& colour,
          double opacity) {
  cv::Mat cut;
  cv::bitwise_and(mask, mask, cut, fan);
  cv::Mat filled = image.clone();
  filled.setTo(bgr(colour), cut);
  cv::addWeighted(filled, opacity, image, 1.0 - opacity, 0.0, image);
}

void paint(cv::Mat& image, const cv::Mat& fan, const cv::Mat& mask, const ViewColour& fill,
           const ViewColour& edge, double opacity) {
  tint(image, fan, mask, fill, opacity);
  cv::Mat cut;
  cv::bitwise_and(mask, mask, cut, fan);
  std::vector<Outline> edges;
  cv::findContours(cut, edges, cv::RETR_CCOMP, cv::CHAIN_APPROX_NONE);
  cv::drawContours(image, edges, -1, bgr(edge), 1, cv::LINE_AA);
}

bool is_drawable(const Obstacle& o) {
  return std::isfinite(o.centre_x_m) && std::isfinite(o.centre_y_m) &&
         std::isfinite(o.semi_axis_first_m) && std::isfinite(o.semi_axis_second_m) &&
         std::isfinite(o.angle_rad) && std::isfinite(o.protection_first_m) &&
         std::isfinite(o.protection_second_m) &&
         std::all_of(o.vertices.begin(), o.vertices.end(),
                     [](const Vertex& v) { return std::isfinite(v.x_m) && std::isfinite(v.y_m); });
}

Outline ellipse_outline(const SonarView& view, const Obstacle& o, double first_m, double second_m) {
  constexpr int kCorners = 96;
  Outline outline;
  const double s = std::sin(o.angle_rad);
  const double c = std::cos(o.angle_rad);
  for (int i = 0; i < kCorners; ++i) {
    const double turn = 2.0 * std::numbers::pi * i / kCorners;
    const double along = first_m * std::cos(turn);
    const double across = second_m * std::sin(turn);
    outline.push_back(subpixel(view, o.centre_x_m + along * s + across * c,
                               o.centre_y_m + along * c - across * s));
  }
  return outline;
}

Outline wall_outline(const SonarView& view, const Obstacle& wall) {
  Outline line;
  for (std::uint32_t i = 0; i < std::min<std::uint32_t>(wall.vertex_count, kMaxVertices); ++i) {
    line.push_back(subpixel(view, wall.vertices[i].x_m, wall.vertices[i].y_m));
  }
  return line;
}

void fill_shape(cv::Mat& mask, const SonarView& view, const Obstacle& o, bool protection) {
  const cv::Scalar set{255};
  if (o.shape == ObstacleShape::kEllipse) {
    const double first_m = protection ? o.protection_first_m : o.semi_axis_first_m;
    const double second_m = protection ? o.protection_second_m : o.semi_axis_second_m;
    cv::fillConvexPoly(mask, ellipse_outline(view, o, first_m, second_m), set, cv::LINE_8, kShift);
    return;
  }
  const Outline line = wall_outline(view, o);
  const bool closed = o.shape == ObstacleShape::kPolygon;
  if (line.empty()) {
    return;
  }
  if (closed) {
    cv::fillPoly(mask, std::vector<Outline>{line}, set, cv::LINE_8, kShift);
  }
  const double width_px = protection ? 2.0 * o.protection_first_m / view.metres_per_pixel() : 3.0;
  const int width = static_cast<int>(std::clamp(std::round(width_px), 1.0, 2000.0));
  cv::polylines(mask, std::vector<Outline>{line}, closed, set, width, cv::LINE_8, kShift);
}

Outline body_outline(const SonarView& view, const Obstacle& o) {
  return o.shape == ObstacleShape::kEllipse
             ? ellipse_outline(view, o, o.semi_axis_first_m, o.semi_axis_second_m)
             : wall_outline(view, o);
}

bool is_closed(const Obstacle& o) { return o.shape != ObstacleShape::kPolyline; }

}  // namespace lodesman::view
