// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/pictures.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <opencv2/imgproc.hpp>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "low_level/path/jump_point_search.h"
#include "low_level/path/pixel_steps.h"
#include "low_level/sonar/image_codec.h"
#include "tests/bench/reference_a_star.h"

namespace lodesman::bench {
namespace {

// Blue, green, red. Told apart by those who see few colours, and by their brightness alone.
const cv::Scalar kWater{255, 255, 255};
const cv::Scalar kOutside{225, 225, 225};
const cv::Scalar kObstacle{130, 130, 130};
const cv::Scalar kExpanded{233, 180, 86};
const cv::Scalar kDiagonal{178, 114, 0};
const cv::Scalar kJumpPoint{0, 94, 213};
const cv::Scalar kInk{0, 0, 0};

// Round the view: the axes, and above it the legend.
constexpr int kLeft = 60;
constexpr int kTop = 50;
constexpr int kBottom = 50;
constexpr int kRight = 20;

cv::Point at(int column, int row) { return {kLeft + column, kTop + row}; }
cv::Point at(PathPixel pixel) { return at(pixel.column, pixel.row); }

void write(cv::Mat& picture, const std::string& text, cv::Point where) {
  cv::putText(picture, text, where, cv::FONT_HERSHEY_SIMPLEX, 0.45, kInk, 1, cv::LINE_AA);
}

void set(cv::Mat& picture, cv::Point where, const cv::Scalar& colour) {
  picture.at<cv::Vec3b>(where) = {static_cast<std::uint8_t>(colour[0]),
                                  static_cast<std::uint8_t>(colour[1]),
                                  static_cast<std::uint8_t>(colour[2])};
}

void draw_axes(cv::Mat& picture) {
  for (int column = 0; column < kViewColumns; column += 100) {
    cv::line(picture, at(column, kViewRows), at(column, kViewRows + 5), kInk);
    write(picture, std::to_string(column), at(column - 12, kViewRows + 20));
  }
  for (int row = 0; row <= kViewRows; row += 100) {
    cv::line(picture, at(-5, row), at(0, row), kInk);
    write(picture, std::to_string(row), at(-40, row + 5));
  }
  write(picture, "column [px]", at(kViewColumns / 2 - 45, kViewRows + 40));
  write(picture, "row [px]", {5, kTop - 14});
}

cv::Mat view_of(const PassableGrid& grid) {
  cv::Mat picture(kTop + kViewRows + kBottom, kLeft + kViewColumns + kRight, CV_8UC3, kWater);
  for (int row = 0; row < kViewRows; ++row) {
    for (int column = 0; column < kViewColumns; ++column) {
      if (!grid.passable(column, row)) {
        set(picture, at(column, row), in_fan(column, row) ? kObstacle : kOutside);
      }
    }
  }
  draw_axes(picture);
  return picture;
}

void draw_path(cv::Mat& picture, std::span<const PathPixel> path) {
  for (const PathPixel& pixel : path) {
    cv::circle(picture, at(pixel), 1, kInk, cv::FILLED);
  }
  for (const auto& [pixel, name] : {std::pair{path.front(), "start"}, {path.back(), "goal"}}) {
    cv::drawMarker(picture, at(pixel), kInk, cv::MARKER_TILTED_CROSS, 12, 2);
    write(picture, name, at(pixel) + cv::Point{10, -6});
  }
}

void draw_legend(cv::Mat& picture, const std::vector<std::pair<cv::Scalar, std::string>>& lines) {
  int x = kLeft + 40;
  for (const auto& [colour, text] : lines) {
    cv::rectangle(picture, {x, 12, 14, 14}, colour, cv::FILLED);
    cv::rectangle(picture, {x, 12, 14, 14}, kInk);
    write(picture, text, {x + 20, 24});
    x += 45 + 8 * static_cast<int>(text.size());
  }
}

void save(const cv::Mat& picture, const std::string& path) {
  const auto bytes = encode_png({picture.cols, picture.rows, picture.data});
  std::ofstream file{path, std::ios::binary};
  std::copy(bytes.begin(), bytes.end(), std::ostreambuf_iterator<char>{file});
  if (bytes.empty() || !file.flush()) {
    throw std::runtime_error(path + ": cannot be written");
  }
}

cv::Mat picture_of_a_star(const PassableGrid& grid, PathPixel start, PathPixel goal) {
  ReferenceAStar search{grid.fan()};
  const SearchResult result = search.search(grid, start, goal);
  cv::Mat picture = view_of(grid);
  for (int row = 0; row < kViewRows; ++row) {
    for (int column = 0; column < kViewColumns; ++column) {
      if (search.has_expanded(column, row)) {
        set(picture, at(column, row), kExpanded);
      }
    }
  }
  draw_path(picture, result.path);
  draw_legend(picture, {{kExpanded, std::to_string(result.expansions) + " pixels expanded"},
                        {kObstacle, "protection zones"},
                        {kInk, "path"}});
  return picture;
}

cv::Mat picture_of_jump_points(const PassableGrid& grid, PathPixel start, PathPixel goal) {
  JumpPointSearch search{grid.fan()};
  const SearchResult result = search.search(grid, start, goal);
  cv::Mat picture = view_of(grid);
  const JumpPoints& points = search.jump_points();
  for (std::int32_t i = 0; i < points.count(); ++i) {
    const JumpPoint& point = points[i];
    for (std::size_t diagonal = 0; diagonal < point.reach.size(); ++diagonal) {
      const int direction = 2 * static_cast<int>(diagonal) + 1;
      cv::line(picture, at(point.pixel), at(moved(point.pixel, direction, point.reach[diagonal])),
               kDiagonal);
    }
  }
  draw_path(picture, result.path);
  for (std::int32_t i = 0; i < points.count(); ++i) {
    cv::circle(picture, at(points[i].pixel), 4, kJumpPoint, cv::FILLED, cv::LINE_AA);
  }
  draw_legend(picture, {{kJumpPoint, std::to_string(points.count()) + " jump points, " +
                                         std::to_string(result.expansions) + " expansions"},
                        {kDiagonal, "diagonal runs"},
                        {kObstacle, "protection zones"},
                        {kInk, "path"}});
  return picture;
}

}  // namespace

void draw_pictures(const testing::RandomFrame& frame, const std::string& folder) {
  PassableGrid grid;
  frame.draw(grid);
  if (JumpPointSearch{}.search(grid, frame.start, frame.goal).reason != PathReason::kFound) {
    throw std::runtime_error("no path on this frame: give another --seed");
  }
  save(picture_of_a_star(grid, frame.start, frame.goal), folder + "/search-a-star.png");
  save(picture_of_jump_points(grid, frame.start, frame.goal), folder + "/search-jump-points.png");
}

}  // namespace lodesman::bench
