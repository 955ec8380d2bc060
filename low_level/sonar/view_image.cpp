// SPDX-License-Identifier: Apache-2.0
#include "low_level/sonar/view_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "low_level/sonar/image_codec.h"

namespace lodesman {
namespace {

// Blue, green, red. Each layer differs from those it touches in brightness too, and has an
// outline, so that no reader depends on telling red from green.
const cv::Scalar kOutside{34, 22, 14};
const cv::Scalar kWater{92, 56, 24};
const cv::Scalar kRing{150, 112, 78};
const cv::Scalar kText{235, 228, 220};
const cv::Scalar kZone{168, 238, 178};  // light green: the brightest area
const cv::Scalar kZoneEdge{225, 255, 230};
const cv::Scalar kObstacle{44, 36, 208};  // red: dark inside a white edge
const cv::Scalar kObstacleEdge{255, 255, 255};
const cv::Scalar kPath{40, 225, 255};  // yellow on a black casing
const cv::Scalar kBlack{0, 0, 0};

constexpr int kShift = 4;  // OpenCV draws in sixteenths of a pixel
constexpr double kSubpixels = 1 << kShift;
constexpr double kFarPx = 20000.0;  // coordinates are cut here, far outside the view
constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
constexpr double kFanHalfRad = std::numbers::pi / 3.0;

cv::Point subpixel(const SonarView& view, double x_m, double y_m) {
  const double column = std::clamp(view.column_of(x_m), -kFarPx, kFarPx);
  const double row = std::clamp(view.row_of(y_m), -kFarPx, kFarPx);
  return {static_cast<int>(std::lround(column * kSubpixels)),
          static_cast<int>(std::lround(row * kSubpixels))};
}

cv::Point whole_pixel(const SonarView& view, double x_m, double y_m) {
  const cv::Point fine = subpixel(view, x_m, y_m);
  return {fine.x >> kShift, fine.y >> kShift};
}

void write_text(cv::Mat& image, const std::string& text, cv::Point at, double size = 0.45) {
  cv::putText(image, text, at, kFont, size, kOutside, 3, cv::LINE_AA);
  cv::putText(image, text, at, kFont, size, kText, 1, cv::LINE_AA);
}

// 1 in the fan, exactly as the planner sees it.
cv::Mat fan_mask() {
  cv::Mat mask{kViewRows, kViewColumns, CV_8U, cv::Scalar{0}};
  for (int row = 0; row < kViewRows; ++row) {
    for (int column = 0; column < kViewColumns; ++column) {
      mask.at<std::uint8_t>(row, column) = in_fan(column, row) ? 1 : 0;
    }
  }
  return mask;
}

// From water through brown to pale yellow; brightness rises with the echo all the way.
std::array<cv::Vec3b, 256> echo_shades() {
  std::array<cv::Vec3b, 256> shades;
  const cv::Vec3d dark{92, 56, 24};
  const cv::Vec3d brown{40, 105, 165};
  const cv::Vec3d pale{170, 240, 255};
  for (std::size_t i = 0; i < shades.size(); ++i) {
    const double strength = std::pow(static_cast<double>(i) / 255.0, 0.7);  // faint ones show too
    const cv::Vec3d shade = strength < 0.5 ? dark + (brown - dark) * (2.0 * strength)
                                           : brown + (pale - brown) * (2.0 * strength - 1.0);
    shades[i] = cv::Vec3b{shade};
  }
  return shades;
}

void draw_echoes(cv::Mat& image, const cv::Mat& fan, const SonarView& view, const SonarPing& ping) {
  if (ping.beams == 0 || ping.bins == 0 || ping.beams > kMaxBeams || ping.bins > kMaxBins ||
      !(ping.range_m > 0.0) || !(ping.beam_step_rad > 0.0)) {
    return;
  }
  const std::array<cv::Vec3b, 256> shades = echo_shades();
  for (int row = 0; row < kViewRows; ++row) {
    for (int column = 0; column < kViewColumns; ++column) {
      if (fan.at<std::uint8_t>(row, column) == 0) {
        continue;
      }
      const VehiclePoint p =
          view.to_vehicle({static_cast<std::int16_t>(column), static_cast<std::int16_t>(row)});
      const double bin = p.xy_m.norm() / ping.range_m * ping.bins;
      const double beam = ping.beam_at(std::atan2(p.xy_m.x(), p.xy_m.y()));
      if (beam >= 0.0 && beam < ping.beams && bin < ping.bins) {
        const std::uint32_t cell =
            static_cast<std::uint32_t>(beam) * ping.bins + static_cast<std::uint32_t>(bin);
        image.at<cv::Vec3b>(row, column) = shades[ping.echo[cell]];
      }
    }
  }
}

// The returns of a profile, as far as they lie in the view.
void draw_points(cv::Mat& image, const SonarView& view, const SonarPing& ping) {
  constexpr int kRadiusPx = 2;
  const cv::Vec3b pale = echo_shades().back();
  for (std::uint32_t beam = 0; beam < std::min<std::uint32_t>(ping.beams, kMaxBeams); ++beam) {
    const double range_m = ping.points[beam].range_m;
    const double bearing_rad = ping.bearing_rad(beam);
    if (range_m > 0.0 && range_m <= ping.range_m && std::abs(bearing_rad) <= kFanHalfRad) {
      cv::circle(
          image,
          whole_pixel(view, range_m * std::sin(bearing_rad), range_m * std::cos(bearing_rad)),
          kRadiusPx, cv::Scalar{pale}, cv::FILLED);
    }
  }
}

// The outline of an ellipse given by its semi-axes, the first clockwise from ahead.
std::vector<cv::Point> ellipse_outline(const SonarView& view, const Obstacle& o, double first_m,
                                       double second_m) {
  constexpr int kCorners = 96;
  std::vector<cv::Point> outline;
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

std::vector<cv::Point> wall_line(const SonarView& view, const Obstacle& wall) {
  std::vector<cv::Point> line;
  for (std::uint32_t i = 0; i < std::min<std::uint32_t>(wall.vertex_count, kMaxVertices); ++i) {
    line.push_back(subpixel(view, wall.vertices[i].x_m, wall.vertices[i].y_m));
  }
  return line;
}

// Sets the pixels of the obstacle, or of its protection zone.
void fill_shape(cv::Mat& mask, const SonarView& view, const Obstacle& o, bool protection) {
  const cv::Scalar set{255};
  if (o.shape == ObstacleShape::kEllipse) {
    const double first_m = protection ? o.protection_first_m : o.semi_axis_first_m;
    const double second_m = protection ? o.protection_second_m : o.semi_axis_second_m;
    cv::fillConvexPoly(mask, ellipse_outline(view, o, first_m, second_m), set, cv::LINE_8, kShift);
    return;
  }
  const std::vector<cv::Point> line = wall_line(view, o);
  const bool closed = o.shape == ObstacleShape::kPolygon;
  if (line.empty()) {
    return;
  }
  if (closed) {
    cv::fillPoly(mask, std::vector<std::vector<cv::Point>>{line}, set, cv::LINE_8, kShift);
  }
  const double width_px = protection ? 2.0 * o.protection_first_m / view.metres_per_pixel() : 3.0;
  const int width = static_cast<int>(std::clamp(std::round(width_px), 1.0, 2000.0));
  cv::polylines(mask, std::vector<std::vector<cv::Point>>{line}, closed, set, width, cv::LINE_8,
                kShift);
}

bool is_drawable(const Obstacle& o) {
  return std::isfinite(o.centre_x_m) && std::isfinite(o.centre_y_m) &&
         std::isfinite(o.semi_axis_first_m) && std::isfinite(o.semi_axis_second_m) &&
         std::isfinite(o.angle_rad) && std::isfinite(o.protection_first_m) &&
         std::isfinite(o.protection_second_m) &&
         std::all_of(o.vertices.begin(), o.vertices.end(),
                     [](const Vertex& v) { return std::isfinite(v.x_m) && std::isfinite(v.y_m); });
}

// Fills a mask's area within the fan and draws its edge. Overlapping zones are one area, as they
// are to the planner.
void paint(cv::Mat& image, const cv::Mat& fan, const cv::Mat& mask, const cv::Scalar& fill,
           const cv::Scalar& edge, double opacity) {
  cv::Mat cut;
  cv::bitwise_and(mask, mask, cut, fan);
  cv::Mat filled = image.clone();
  filled.setTo(fill, cut);
  cv::addWeighted(filled, opacity, image, 1.0 - opacity, 0.0, image);
  std::vector<std::vector<cv::Point>> edges;
  cv::findContours(cut, edges, cv::RETR_CCOMP, cv::CHAIN_APPROX_NONE);
  cv::drawContours(image, edges, -1, edge, 1, cv::LINE_AA);
}

void draw_obstacles(cv::Mat& image, const cv::Mat& fan, const SonarView& view,
                    const SonarObstacles& seen, bool over_echoes) {
  cv::Mat zones{kViewRows, kViewColumns, CV_8U, cv::Scalar{0}};
  cv::Mat bodies = zones.clone();
  for (std::uint32_t i = 0; i < std::min<std::uint32_t>(seen.count, kMaxObstacles); ++i) {
    if (is_drawable(seen.obstacles[i])) {
      fill_shape(zones, view, seen.obstacles[i], true);
      fill_shape(bodies, view, seen.obstacles[i], false);
    }
  }
  // Over echoes both are glass, so that one sees what was segmented.
  paint(image, fan, zones, kZone, kZoneEdge, over_echoes ? 0.45 : 1.0);
  paint(image, fan, bodies, kObstacle, over_echoes ? kObstacle : kObstacleEdge,
        over_echoes ? 0.35 : 1.0);
}

// A step of the rings that gives three to seven of them.
double ring_step_m(double range_m) {
  const double power = std::pow(10.0, std::floor(std::log10(range_m)));
  for (const double step : {0.2, 0.5, 1.0, 2.0}) {
    if (range_m / (step * power) <= 7.0) {
      return step * power;
    }
  }
  return 2.0 * power;
}

void draw_rings(cv::Mat& image, const SonarView& view, double range_m) {
  const cv::Point apex{kApexColumn, kApexRow};
  const double step_m = ring_step_m(range_m);
  const int rings = static_cast<int>(std::floor(range_m / step_m + 1e-9));
  for (int ring = 1; ring <= rings; ++ring) {
    const int radius = static_cast<int>(std::lround(ring * step_m / view.metres_per_pixel()));
    cv::ellipse(image, apex, {radius, radius}, -90.0, -60.0, 60.0, kRing, 1, cv::LINE_AA);
  }
  for (const double bearing_rad :
       {-kFanHalfRad, -kFanHalfRad / 2.0, 0.0, kFanHalfRad / 2.0, kFanHalfRad}) {
    const cv::Point end =
        whole_pixel(view, range_m * std::sin(bearing_rad), range_m * std::cos(bearing_rad));
    cv::line(image, apex, end, kRing, 1, cv::LINE_AA);
  }
  cv::ellipse(image, apex, {kFanRadiusPx, kFanRadiusPx}, -90.0, -60.0, 60.0, kRing, 1, cv::LINE_AA);
}

// Beside the fan's right edge, where they hide nothing.
void label_rings(cv::Mat& image, const SonarView& view, double range_m) {
  const double step_m = ring_step_m(range_m);
  const int rings = static_cast<int>(std::floor(range_m / step_m + 1e-9));
  for (int ring = 1; ring <= rings; ++ring) {
    const double r = ring * step_m;
    std::array<char, 32> label{};
    std::snprintf(label.data(), label.size(), "%g m", r);
    cv::Point at = whole_pixel(view, r * std::sin(kFanHalfRad), r * std::cos(kFanHalfRad));
    at += cv::Point{6, 14};
    at.x = std::min(at.x, kViewColumns - 48);
    write_text(image, label.data(), at, 0.4);
  }
}

void draw_path(cv::Mat& image, std::span<const PathPixel> path) {
  std::vector<cv::Point> line;
  for (const PathPixel& pixel : path) {
    line.emplace_back(pixel.column, pixel.row);
  }
  if (!line.empty()) {
    cv::polylines(image, line, false, kBlack, 5, cv::LINE_AA);
    cv::polylines(image, line, false, kPath, 2, cv::LINE_AA);
  }
}

void draw_start(cv::Mat& image, cv::Point at) {
  cv::circle(image, at, 7, kBlack, cv::FILLED, cv::LINE_AA);
  cv::circle(image, at, 5, kText, cv::FILLED, cv::LINE_AA);
}

void draw_goal(cv::Mat& image, cv::Point at, bool in_view) {
  cv::drawMarker(image, at, kBlack, cv::MARKER_TILTED_CROSS, 18, 6, cv::LINE_AA);
  cv::drawMarker(image, at, kText, cv::MARKER_TILTED_CROSS, 16, in_view ? 3 : 1, cv::LINE_AA);
}

void mark_goal(cv::Mat& image, const SonarView& view, const ViewPicture& picture) {
  const double x_m = picture.goal->xy_m.x();
  const double y_m = picture.goal->xy_m.y();
  if (!std::isfinite(x_m) || !std::isfinite(y_m)) {
    return;
  }
  const double distance_m = std::hypot(x_m, y_m);
  const double bearing_rad = std::atan2(x_m, y_m);
  const double shown_m = std::min(distance_m, picture.range_m);
  const double shown_rad = std::clamp(bearing_rad, -kFanHalfRad, kFanHalfRad);
  const bool in_view = distance_m <= picture.range_m && std::abs(bearing_rad) <= kFanHalfRad;
  const cv::Point at =
      whole_pixel(view, shown_m * std::sin(shown_rad), shown_m * std::cos(shown_rad));
  draw_goal(image, at, in_view);
  if (!in_view) {
    std::array<char, 48> label{};
    std::snprintf(label.data(), label.size(), "goal out of view: %.1f m", distance_m);
    int baseline = 0;
    const int width = cv::getTextSize(label.data(), kFont, 0.4, 1, &baseline).width;
    const int left = at.x < kApexColumn ? at.x + 16 : at.x - 16 - width;  // towards the middle
    write_text(image, label.data(),
               {std::clamp(left, 4, kViewColumns - width - 4), std::clamp(at.y + 4, 60, 480)}, 0.4);
  }
}

void draw_legend(cv::Mat& image, const ViewPicture& picture) {
  constexpr int kLeft = 12;
  int row = 412;
  const auto next_label = [&](const char* text) {
    write_text(image, text, {kLeft + 26, row + 4}, 0.4);
    row += 19;
  };
  const auto swatch = [&](const cv::Scalar& fill, const cv::Scalar& edge) {
    const cv::Rect box{kLeft, row - 6, 18, 12};
    cv::rectangle(image, box, fill, cv::FILLED);
    cv::rectangle(image, box, edge, 1);
  };
  swatch(kZone, kZoneEdge);
  next_label("protection zone");
  swatch(kObstacle, kObstacleEdge);
  next_label("obstacle");
  const std::array<PathPixel, 2> sample{PathPixel{kLeft, static_cast<std::int16_t>(row)},
                                        PathPixel{kLeft + 18, static_cast<std::int16_t>(row)}};
  draw_path(image, sample);
  next_label("path");
  draw_start(image, {kLeft + 9, row});
  next_label("start (sonar head)");
  if (picture.goal) {
    draw_goal(image, {kLeft + 9, row}, true);
    next_label("goal");
  }
}

void draw_caption(cv::Mat& image, std::string_view caption) {
  const std::size_t end = std::min(caption.find('\n'), caption.size());
  write_text(image, std::string{caption.substr(0, end)}, {10, 20});
  if (end < caption.size()) {
    write_text(image, std::string{caption.substr(end + 1)}, {10, 40});
  }
}

cv::Mat draw(const ViewPicture& picture) {
  const SonarView view{picture.range_m};
  const cv::Mat fan = fan_mask();
  cv::Mat image{kViewRows, kViewColumns, CV_8UC3, kOutside};
  image.setTo(kWater, fan);
  if (picture.ping != nullptr) {
    if (picture.ping->kind == PingKind::kProfile) {
      draw_points(image, view, *picture.ping);
    } else {
      draw_echoes(image, fan, view, *picture.ping);
    }
  }
  draw_rings(image, view, picture.range_m);
  if (picture.obstacles != nullptr) {
    draw_obstacles(image, fan, view, *picture.obstacles, picture.ping != nullptr);
  }
  draw_path(image, picture.path);
  draw_start(image, {kApexColumn, kApexRow});
  if (picture.goal) {
    mark_goal(image, view, picture);
  }
  label_rings(image, view, picture.range_m);
  draw_legend(image, picture);
  draw_caption(image, picture.caption);
  return image;
}

bool save(const std::filesystem::path& file, const ViewPicture& picture, ViewFormat format) {
  const std::vector<std::uint8_t> bytes = encode_view(picture, format);
  std::ofstream stream{file, std::ios::binary};
  for (const std::uint8_t byte : bytes) {
    stream.put(static_cast<char>(byte));
  }
  stream.close();
  return !bytes.empty() && stream.good();
}

}  // namespace

std::vector<std::uint8_t> encode_view(const ViewPicture& picture, ViewFormat format) {
  std::vector<std::uint8_t> bytes;
  if (!std::isfinite(picture.range_m) || picture.range_m <= 0.0) {
    return bytes;
  }
  try {
    const cv::Mat image = draw(picture);
    const BgrPixels pixels{image.cols, image.rows, image.data};
    bytes = format == ViewFormat::kPng ? encode_png(pixels) : encode_jpeg(pixels);
  } catch (const cv::Exception&) {
    bytes.clear();
  }
  return bytes;
}

bool save_jpeg(const std::filesystem::path& file, const ViewPicture& picture) {
  return save(file, picture, ViewFormat::kJpeg);
}

bool save_png(const std::filesystem::path& file, const ViewPicture& picture) {
  return save(file, picture, ViewFormat::kPng);
}

}  // namespace lodesman
