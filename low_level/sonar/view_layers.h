// SPDX-License-Identifier: Apache-2.0
// The layers of a sonar view, from the lowest to the highest, each in the order in which it is
// drawn. For view_image.cpp alone, which runs on any best-effort thread and never in a real-time
// task.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "low_level/sonar/view_canvas.h"
#include "low_level/sonar/view_image.h"

namespace lodesman::view {

// One track in the vehicle's frame, at the time of the picture.
struct TrackShown {
  Obstacle body;
  Eigen::Vector2d velocity_m_s = Eigen::Vector2d::Zero();
  Eigen::Matrix2d place_m2 = Eigen::Matrix2d::Zero();  // its covariance
  bool may_move = false;
  bool surely_moves = false;
};
// Those of the picture that can be drawn.
[[nodiscard]] std::vector<TrackShown> shown_tracks(const ViewPicture& picture);

// The echoes of an image, or the returns of a profile; nothing of a ping that breaks its ranges.
// Gives which pixels a beam looks at, not 0; empty where none does.
[[nodiscard]] cv::Mat draw_ping(cv::Mat& image, const cv::Mat& fan, const ViewPicture& picture);
// Shades and hatches what nobody has seen, and tints what is known not to be free. `heard`: by this
// ping, as draw_ping says.
void draw_water(cv::Mat& image, const cv::Mat& fan, const cv::Mat& heard,
                const ViewPicture& picture);
void draw_rings(cv::Mat& image, const ViewPicture& picture);
// One area of all of it.
void draw_what_rests(cv::Mat& image, const ViewPicture& picture,
                     const std::vector<TrackShown>& tracks);
// Zones and bodies; on a chart only their edges.
void draw_obstacles(cv::Mat& image, const cv::Mat& fan, const ViewPicture& picture);
// Of each its number and the doubt about its place; dashed, or where it surely moves with its way
// in the next seconds.
void draw_what_moves(cv::Mat& image, const ViewPicture& picture,
                     const std::vector<TrackShown>& tracks);
void draw_path(cv::Mat& image, const ViewPicture& picture);
// Beside the fan, where they hide nothing.
void draw_labels(cv::Mat& image, const ViewPicture& picture);
void draw_legend(cv::Mat& image, const ViewPicture& picture);

// Samples, for the legend.
void draw_start_mark(cv::Mat& image, cv::Point at);
void draw_goal_mark(cv::Mat& image, cv::Point at, bool in_view);
void draw_path_line(cv::Mat& image, const std::vector<cv::Point>& pixels);
void draw_way(cv::Mat& image, cv::Point from, cv::Point to);  // an arrow, in sixteenths
void draw_doubt(cv::Mat& image, const Outline& ellipse);
void hatch(cv::Vec3b& pixel, int column, int row);

}  // namespace lodesman::view
