// SPDX-License-Identifier: Apache-2.0
// What the colours of a sonar view mean: in the corners below the fan.
#include <array>
#include <cstdio>

#include "low_level/sonar/view_layers.h"

namespace lodesman::view {
namespace {

constexpr int kLeft = 12;
constexpr int kRight = 714;
constexpr int kSwatchPx = 18;
constexpr int kRowPx = 19;

// One row above the other, the first at the bottom.
class Column {
 public:
  Column(cv::Mat& image, int left) : image_{image}, left_{left} {}

  // A box of what is there over what lies under it.
  void area(const ViewColour& fill, const ViewColour& edge, const char* text) {
    cv::rectangle(image_, box(), bgr(fill), cv::FILLED);
    cv::rectangle(image_, box(), bgr(edge), 1);
    name(text);
  }
  void tinted(const ViewColour& tint, double opacity, const char* text) {
    const cv::Scalar fill = bgr(view_colours::kUnheard) * (1.0 - opacity) + bgr(tint) * opacity;
    cv::rectangle(image_, box(), fill, cv::FILLED);
    cv::rectangle(image_, box(), bgr(tint), 1);
    name(text);
  }
  void outline(const ViewColour& colour, int width, const char* text) {
    draw_outline(image_, corners(), true, colour, width);
    name(text);
  }
  void dashed(const ViewColour& colour, const char* text) {
    draw_dashed(image_, corners(), true, colour, 2);
    name(text);
  }
  void hatched(const char* text) {
    const cv::Rect area = box();
    for (int row = area.y; row < area.y + area.height; ++row) {
      for (int column = area.x; column < area.x + area.width; ++column) {
        cv::Vec3b& pixel = image_.at<cv::Vec3b>(row, column);
        pixel = cv::Vec3b::all(kSample);
        hatch(pixel, column, row);
      }
    }
    name(text);
  }
  void doubt(const char* text) {
    draw_doubt(image_, ring());
    name(text);
  }
  void way(const char* text) {
    draw_way(image_, fine(left_, row_), fine(left_ + kSwatchPx, row_));
    name(text);
  }
  void path(const char* text) {
    draw_path_line(image_, {{left_, row_}, {left_ + kSwatchPx, row_}});
    name(text);
  }
  void start(const char* text) {
    draw_start_mark(image_, {left_ + kSwatchPx / 2, row_});
    name(text);
  }
  void goal(const char* text) {
    draw_goal_mark(image_, {left_ + kSwatchPx / 2, row_}, true);
    name(text);
  }

 private:
  static constexpr std::uint8_t kSample = 40;  // a faint echo's grey

  [[nodiscard]] static cv::Point fine(int column, int row) {
    return {column << kShift, row << kShift};
  }
  [[nodiscard]] cv::Rect box() const { return {left_, row_ - 6, kSwatchPx, 12}; }
  [[nodiscard]] Outline corners() const {
    return {fine(left_, row_ - 5), fine(left_ + kSwatchPx, row_ - 5),
            fine(left_ + kSwatchPx, row_ + 5), fine(left_, row_ + 5)};
  }
  // In the view whose pixel is a metre.
  [[nodiscard]] Outline ring() const {
    Obstacle ellipse;
    ellipse.centre_x_m = left_ + kSwatchPx / 2.0 - kApexColumn;
    ellipse.centre_y_m = kApexRow - row_;
    return ellipse_outline(SonarView{kFanRadiusPx}, ellipse, 6.0, kSwatchPx / 2.0);
  }
  void name(const char* text) {
    write_text(image_, text, {left_ + kSwatchPx + 8, row_ + 4}, kSmallText);
    row_ -= kRowPx;
  }

  cv::Mat& image_;
  int left_;
  int row_ = kViewRows - 12;
};

void name_path(Column& column, const ViewPicture& picture) {
  const bool planned = !picture.path.empty() || picture.goal;
  if (picture.goal) {
    column.goal("goal");
  }
  column.start(planned ? "start (sonar head)" : "sonar head");
  if (!picture.path.empty()) {
    column.path("path");
  }
}

void name_what_is_bright(Column& column, const ViewPicture& picture) {
  if (picture.bright_from > 0.0) {
    const ViewColour& colour = picture.is_chart() ? view_colours::kBrightest : view_colours::kEcho;
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "echo of %g or more", picture.bright_from);
    column.area(colour, colour, text.data());
  }
}

void name_areas(Column& column, const ViewPicture& picture) {
  if (picture.obstacles != nullptr) {
    column.area(view_colours::kObstacle, view_colours::kWhite, "obstacle");
  }
  if (picture.zones != nullptr) {
    column.area(view_colours::kZone, view_colours::kZoneEdge, "protection zone");
  }
}

void name_outlines(Column& column, const ViewPicture& picture) {
  if (picture.zones != nullptr) {
    column.outline(view_colours::kZone, 1, "protection zone");
  }
  if (picture.obstacles != nullptr) {
    column.outline(view_colours::kWhite, 1, "seen in this ping");
  }
}

void name_what_is_known(Column& column, const ViewPicture& picture) {
  if (picture.water) {
    column.hatched("not seen");
  }
  if (picture.tracks != nullptr) {
    column.doubt("its place, 2 sigma");
    column.way("its way in 5 s");
    column.outline(view_colours::kTrack, 2, "moves");
    column.dashed(view_colours::kTrack, "may move");
    column.tinted(view_colours::kRests, view_colours::kRestsOpacity, "rests");
  }
}

}  // namespace

void draw_legend(cv::Mat& image, const ViewPicture& picture) {
  Column left{image, kLeft};
  name_path(left, picture);
  name_what_is_bright(left, picture);
  if (picture.is_chart()) {
    name_outlines(left, picture);
    Column right{image, kRight};
    name_what_is_known(right, picture);
  } else {
    name_areas(left, picture);
  }
}

}  // namespace lodesman::view
