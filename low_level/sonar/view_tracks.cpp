// SPDX-License-Identifier: Apache-2.0
// What is followed from ping to ping.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "low_level/sonar/known_obstacles.h"
#include "low_level/sonar/view_layers.h"
#include "mid_level/base/time.h"

namespace lodesman::view {
namespace {

constexpr double kWay_s = 5.0;          // of its motion, as an arrow
constexpr double kDoubtSigmas = 2.0;    // of its place
constexpr double kLongestWay_s = 60.0;  // for which a track is foreseen
constexpr double kShortestWayPx = 4.0;  // less is a head without an arrow
constexpr double kFarthestNumberPx = 40.0;
constexpr double kSubpixels = 1 << kShift;

[[nodiscard]] bool is_track(const Track& track) {
  return is_drawable(track.shape) && std::isfinite(track.velocity_x_m_s) &&
         std::isfinite(track.velocity_y_m_s) && std::isfinite(track.place_xx_m2) &&
         std::isfinite(track.place_xy_m2) && std::isfinite(track.place_yy_m2) &&
         std::isfinite(track.velocity_xx_m2_s2) && std::isfinite(track.velocity_yy_m2_s2);
}

[[nodiscard]] TrackShown shown_track(const Track& track, Time at, const VehiclePose& pose) {
  const double ahead_s = std::clamp(to_seconds(at - track.last_seen), 0.0, kLongestWay_s);
  Obstacle there = track.shape;
  there.centre_x_m += ahead_s * track.velocity_x_m_s;
  there.centre_y_m += ahead_s * track.velocity_y_m_s;
  TrackShown one;
  one.body = to_vehicle(pose, there);
  one.body.id = track.id;
  // As the vehicle frame's axes lie in the tracks'.
  Eigen::Matrix2d axes;
  axes << std::cos(pose.heading.rad()), std::sin(pose.heading.rad()), -std::sin(pose.heading.rad()),
      std::cos(pose.heading.rad());
  Eigen::Matrix2d place;
  place << track.place_xx_m2, track.place_xy_m2, track.place_xy_m2, track.place_yy_m2;
  Eigen::Matrix2d drift;
  drift << track.velocity_xx_m2_s2, track.velocity_xy_m2_s2, track.velocity_xy_m2_s2,
      track.velocity_yy_m2_s2;
  one.place_m2 = axes.transpose() * (place + ahead_s * ahead_s * drift) * axes;
  one.velocity_m_s = axes.transpose() * Eigen::Vector2d{track.velocity_x_m_s, track.velocity_y_m_s};
  one.may_move = track.velocity_xx_m2_s2 > 0.0;
  one.surely_moves = one.may_move && track.surely_moves();
  return one;
}

[[nodiscard]] Outline doubt_of(const SonarView& view, const TrackShown& one) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes{one.place_m2};
  const auto sigma_m = [&](int i) { return std::sqrt(std::max(0.0, axes.eigenvalues()[i])); };
  Obstacle ellipse;
  ellipse.centre_x_m = one.body.centre_x_m;
  ellipse.centre_y_m = one.body.centre_y_m;
  ellipse.angle_rad = std::atan2(axes.eigenvectors()(0, 1), axes.eigenvectors()(1, 1));
  return ellipse_outline(view, ellipse, kDoubtSigmas * sigma_m(1), kDoubtSigmas * sigma_m(0));
}

void draw_mover(cv::Mat& image, const SonarView& view, const TrackShown& one) {
  outline_body(image, view, one.body, view_colours::kTrack, one.surely_moves ? 2 : 1);
  const Eigen::Vector2d from{one.body.centre_x_m, one.body.centre_y_m};
  const Eigen::Vector2d to = from + kWay_s * one.velocity_m_s;
  if (one.surely_moves && (to - from).norm() > kShortestWayPx * view.metres_per_pixel()) {
    draw_way(image, subpixel(view, from.x(), from.y()), subpixel(view, to.x(), to.y()));
  }
  draw_doubt(image, doubt_of(view, one));  // on top: it may be small
}

// Numbers beside what they name, each where it covers none of the others; one that finds no such
// place is left out.
class Numbers {
 public:
  // `to_right`: rather there than to the left.
  void write(cv::Mat& image, const std::string& text, cv::Point at, int away_px, bool to_right) {
    const cv::Size size = text_box(text, {0, 0}, kSmallText).size();
    std::array<cv::Point, 4> places{
        cv::Point{at.x + away_px, at.y + 4}, cv::Point{at.x - away_px - size.width, at.y + 4},
        cv::Point{at.x - size.width / 2, at.y - away_px},
        cv::Point{at.x - size.width / 2, at.y + away_px + size.height - 6}};
    if (!to_right) {
      std::swap(places[0], places[1]);
    }
    for (const cv::Point& place : places) {
      const cv::Rect box = text_box(text, place, kSmallText);
      const bool inside = (box & cv::Rect{0, 0, image.cols, image.rows}) == box;
      const bool is_taken = std::any_of(taken_.begin(), taken_.end(), [&](const cv::Rect& other) {
        return (other & box).area() > 0;
      });
      if (inside && !is_taken) {
        write_text(image, text, place, kSmallText, view_colours::kTrack);
        taken_.push_back(box);
        return;
      }
    }
  }

 private:
  std::vector<cv::Rect> taken_;
};

}  // namespace

void draw_way(cv::Mat& image, cv::Point from, cv::Point to) {
  constexpr double kHeadPx = 8.0;
  const double length_px = std::hypot(to.x - from.x, to.y - from.y) / kSubpixels;
  const double head = std::min(0.5, kHeadPx / std::max(length_px, 1.0));
  const auto arrow = [&](const ViewColour& colour, int width) {
    cv::arrowedLine(image, from, to, bgr(colour), width, cv::LINE_AA, kShift, head);
  };
  arrow(view_colours::kBlack, 4);
  arrow(view_colours::kTrack, 2);
}

void draw_doubt(cv::Mat& image, const Outline& ellipse) {
  constexpr std::size_t kDash = 4;  // of an outline's 96 sides, and as many between two dashes
  for (std::size_t first = 0; first + kDash < ellipse.size(); first += 2 * kDash) {
    const auto begin = ellipse.begin() + static_cast<std::ptrdiff_t>(first);
    cv::polylines(image, std::vector<Outline>{{begin, begin + kDash + 1}}, false,
                  bgr(view_colours::kTrack), 1, cv::LINE_AA, kShift);
  }
}

std::vector<TrackShown> shown_tracks(const ViewPicture& picture) {
  std::vector<TrackShown> shown;
  const std::uint32_t count =
      picture.tracks != nullptr ? std::min<std::uint32_t>(picture.tracks->count, kMaxObstacles) : 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (is_track(picture.tracks->tracks[i])) {
      shown.push_back(
          shown_track(picture.tracks->tracks[i], picture.tracks->captured, picture.pose));
    }
  }
  return shown;
}

void draw_what_rests(cv::Mat& image, const ViewPicture& picture,
                     const std::vector<TrackShown>& tracks) {
  const SonarView view{picture.range_m};
  cv::Mat area = empty_mask();
  for (const TrackShown& one : tracks) {
    if (!one.may_move) {
      fill_shape(area, view, one.body, false);
    }
  }
  const cv::Mat everywhere{kViewRows, kViewColumns, CV_8U, cv::Scalar{1}};
  paint(image, everywhere, area, view_colours::kOccupied, view_colours::kOccupied,
        picture.water ? 0.0 : view_colours::kOccupiedOpacity);
}

void draw_what_moves(cv::Mat& image, const ViewPicture& picture,
                     const std::vector<TrackShown>& tracks) {
  const SonarView view{picture.range_m};
  for (const TrackShown& one : tracks) {
    if (one.may_move) {
      draw_mover(image, view, one);
    }
  }
  Numbers numbers;
  for (const TrackShown& one : tracks) {
    const cv::Point at = whole_pixel(view, one.body.centre_x_m, one.body.centre_y_m);
    if (one.may_move && cv::Rect{0, 0, kViewColumns, kViewRows}.contains(at)) {
      const double size_px = std::max(one.body.semi_axis_first_m, one.body.semi_axis_second_m) /
                             view.metres_per_pixel();
      numbers.write(image, std::to_string(one.body.id), at,
                    static_cast<int>(std::min(size_px, kFarthestNumberPx)) + 6,
                    one.velocity_m_s.x() <= 0.0);  // beside its way
    }
  }
}

}  // namespace lodesman::view
