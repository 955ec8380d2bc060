// SPDX-License-Identifier: Apache-2.0
// What is followed from ping to ping.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
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
constexpr double kFastestWritten_m_s = 999.0;

[[nodiscard]] bool is_track(const Track& track) {
  return is_drawable(track.shape) && std::isfinite(track.velocity_x_m_s) &&
         std::isfinite(track.velocity_y_m_s) && std::isfinite(track.place_xx_m2) &&
         std::isfinite(track.place_xy_m2) && std::isfinite(track.place_yy_m2) &&
         std::isfinite(track.velocity_xx_m2_s2) && std::isfinite(track.velocity_yy_m2_s2);
}

[[nodiscard]] double seconds_of(Time at) { return to_seconds(at.time_since_epoch()); }

[[nodiscard]] TrackShown shown_track(const Track& track, Time at, const VehiclePose& pose) {
  const double ahead_s =
      std::clamp(seconds_of(at) - seconds_of(track.last_seen), 0.0, kLongestWay_s);
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
  const Outline body = body_outline(view, one.body);
  const Outline doubt = doubt_of(view, one);
  if (!one.surely_moves) {
    draw_dashed(image, body, is_closed(one.body), view_colours::kTrack, 2);
    draw_dashed(image, doubt, true, view_colours::kTrack, 1);
    return;
  }
  draw_doubt(image, doubt);
  draw_outline(image, body, is_closed(one.body), view_colours::kTrack, 2);
  const Eigen::Vector2d from{one.body.centre_x_m, one.body.centre_y_m};
  const Eigen::Vector2d to = from + kWay_s * one.velocity_m_s;
  if ((to - from).norm() > kShortestWayPx * view.metres_per_pixel()) {
    draw_way(image, subpixel(view, from.x(), from.y()), subpixel(view, to.x(), to.y()));
  }
}

// Numbers beside what they name, each where it covers none of the others; one that finds no such
// place is left out.
class Numbers {
 public:
  void write(cv::Mat& image, const SonarView& view, const TrackShown& one) {
    const cv::Point at = whole_pixel(view, one.body.centre_x_m, one.body.centre_y_m);
    const cv::Rect picture{0, 0, image.cols, image.rows};
    if (!picture.contains(at)) {
      return;
    }
    const std::string text = text_of(one);
    const cv::Size size = text_box(text, {0, 0}, kSmallText).size();
    for (const cv::Point& place : places(at, size, away_px(view, one), one.velocity_m_s.x())) {
      const cv::Rect box = text_box(text, place, kSmallText);
      const bool is_taken = std::any_of(taken_.begin(), taken_.end(), [&](const cv::Rect& other) {
        return (other & box).area() > 0;
      });
      if ((box & picture) == box && !is_taken) {
        write_text(image, text, place, kSmallText, view_colours::kTrack);
        taken_.push_back(box);
        return;
      }
    }
  }

 private:
  // How fast, where that is known.
  [[nodiscard]] static std::string text_of(const TrackShown& one) {
    std::array<char, 48> text{};
    if (one.surely_moves) {
      std::snprintf(text.data(), text.size(), "%u: %.1f m/s", one.body.id,
                    std::min(one.velocity_m_s.norm(), kFastestWritten_m_s));
    } else {
      std::snprintf(text.data(), text.size(), "%u", one.body.id);
    }
    return text.data();
  }
  [[nodiscard]] static int away_px(const SonarView& view, const TrackShown& one) {
    const double size_px =
        std::max(one.body.semi_axis_first_m, one.body.semi_axis_second_m) / view.metres_per_pixel();
    return static_cast<int>(std::clamp(size_px, 0.0, kFarthestNumberPx)) + 6;
  }
  // The best first: beside its way.
  [[nodiscard]] static std::array<cv::Point, 4> places(cv::Point at, cv::Size size, int away,
                                                       double to_starboard_m_s) {
    const cv::Point right{at.x + away, at.y + 4};
    const cv::Point left{at.x - away - size.width, at.y + 4};
    const cv::Point above{at.x - size.width / 2, at.y - away};
    const cv::Point below{at.x - size.width / 2, at.y + away + size.height - 6};
    return to_starboard_m_s <= 0.0 ? std::array{right, left, above, below}
                                   : std::array{left, right, above, below};
  }

  // At first by what the legend says at the picture's lower corners.
  std::vector<cv::Rect> taken_{{0, kViewRows - 100, 170, 100},
                               {kViewColumns - 160, kViewRows - 120, 160, 120}};
};

}  // namespace

void draw_way(cv::Mat& image, cv::Point from, cv::Point to) {
  constexpr double kHeadPx = 8.0;
  const double length_px = std::hypot(to.x - from.x, to.y - from.y) / (1 << kShift);
  const double head = std::min(0.5, kHeadPx / std::max(length_px, 1.0));
  const auto arrow = [&](const ViewColour& colour, int width) {
    cv::arrowedLine(image, from, to, bgr(colour), width, cv::LINE_AA, kShift, head);
  };
  arrow(view_colours::kBlack, 4);
  arrow(view_colours::kTrack, 2);
}

void draw_doubt(cv::Mat& image, const Outline& ellipse) {
  Outline pixels;
  for (const cv::Point& corner : ellipse) {
    pixels.emplace_back(corner.x >> kShift, corner.y >> kShift);
  }
  const cv::Rect box = cv::boundingRect(pixels) & cv::Rect{0, 0, image.cols, image.rows};
  if (box.area() > 0) {
    cv::Mat area{image.rows, image.cols, CV_8U, cv::Scalar{0}};
    cv::fillConvexPoly(area, ellipse, cv::Scalar{1}, cv::LINE_8, kShift);
    cv::Mat part = image(box);
    cv::Mat filled = part.clone();
    filled.setTo(bgr(view_colours::kTrack), area(box));
    cv::addWeighted(filled, view_colours::kDoubtOpacity, part, 1.0 - view_colours::kDoubtOpacity,
                    0.0, part);
  }
  cv::polylines(image, std::vector<Outline>{ellipse}, true, bgr(view_colours::kTrack), 1,
                cv::LINE_AA, kShift);
}

std::vector<TrackShown> shown_tracks(const ViewPicture& picture) {
  std::vector<TrackShown> shown;
  const bool any = picture.tracks != nullptr && picture.is_chart();
  const std::uint32_t count =
      any ? std::min<std::uint32_t>(picture.tracks->count, kMaxObstacles) : 0;
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
  paint(image, everywhere, area, view_colours::kRests, view_colours::kRests,
        picture.water ? 0.0 : view_colours::kRestsOpacity);
}

void draw_what_moves(cv::Mat& image, const ViewPicture& picture,
                     const std::vector<TrackShown>& tracks) {
  const SonarView view{picture.range_m};
  for (const bool sure : {false, true}) {  // on top what is surer
    for (const TrackShown& one : tracks) {
      if (one.may_move && one.surely_moves == sure) {
        draw_mover(image, view, one);
      }
    }
  }
  Numbers numbers;
  for (const bool sure : {true, false}) {
    for (const TrackShown& one : tracks) {
      if (one.may_move && one.surely_moves == sure) {
        numbers.write(image, view, one);
      }
    }
  }
}

}  // namespace lodesman::view
