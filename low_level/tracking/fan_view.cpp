// SPDX-License-Identifier: Apache-2.0
#include "low_level/tracking/fan_view.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "mid_level/geometry/obstacle_distance.h"

namespace lodesman {
namespace {

constexpr int kEllipsePoints = 32;
constexpr double kEdgeBeams = 2.0;     // of the fan, in which half an obstacle may be outside
constexpr double kHiddenFrom_m = 0.3;  // an echo so much nearer hides what is behind it
constexpr double kCutBeams = 1.5;      // what ends so near to the fan's end goes on beyond it

// Calls visit(a, b) for every edge of its outline, an ellipse as a polygon.
template <class Visit>
void for_each_edge(const Obstacle& o, Visit visit) {
  if (o.shape != ObstacleShape::kEllipse) {
    for_each_side(o, visit);
    return;
  }
  const Eigen::Vector2d middle{o.centre_x_m, o.centre_y_m};
  const Eigen::Vector2d along = first_axis(o.angle_rad) * o.semi_axis_first_m;
  const Eigen::Vector2d across =
      Eigen::Vector2d{std::cos(o.angle_rad), -std::sin(o.angle_rad)} * o.semi_axis_second_m;
  Eigen::Vector2d last = middle + along;
  for (int k = 1; k <= kEllipsePoints; ++k) {
    const double turn_rad = 2.0 * std::numbers::pi * k / kEllipsePoints;
    const Eigen::Vector2d next = middle + std::cos(turn_rad) * along + std::sin(turn_rad) * across;
    visit(last, next);
    last = next;
  }
}

}  // namespace

double FanView::beam_at(double x_m, double y_m) const noexcept {
  const double middle_rad = first_bearing_rad_ + 0.5 * (beams_ - 1.0) * beam_step_rad_;
  const double off_rad = std::remainder(std::atan2(x_m, y_m) - middle_rad, 2.0 * std::numbers::pi);
  return off_rad / beam_step_rad_ + 0.5 * (beams_ - 1.0);
}

void FanView::set(const SonarPing& ping, const SonarObstacles& seen, double nearest_m,
                  std::span<const std::uint8_t> blind) noexcept {
  beams_ = std::min<std::uint32_t>(ping.beams, kMaxBeams);
  first_bearing_rad_ = ping.first_bearing_rad;
  beam_step_rad_ = ping.beam_step_rad;
  nearest_m_ = nearest_m;
  farthest_m_ = ping.range_m;
  std::fill_n(clear_m_.begin(), beams_, static_cast<float>(farthest_m_));
  for (std::uint32_t i = 0; i < std::min<std::uint32_t>(seen.count, kMaxObstacles); ++i) {
    shade_shape(seen.obstacles[i]);
  }
  limit_to_listed(seen);
  limit_to_returns(ping);
  for (std::size_t beam = 0; beam < std::min<std::size_t>(blind.size(), beams_); ++beam) {
    clear_m_[beam] = blind[beam] != 0 ? 0.0F : clear_m_[beam];
  }
}

// Beyond the farthest of a list that was too short nothing is known.
void FanView::limit_to_listed(const SonarObstacles& seen) noexcept {
  if (seen.dropped == 0 || seen.count == 0) {
    return;
  }
  const Obstacle& last = seen.obstacles[std::min<std::size_t>(seen.count, kMaxObstacles) - 1];
  const double listed_m = std::hypot(last.centre_x_m, last.centre_y_m);
  for (float& clear : std::span{clear_m_}.first(beams_)) {
    clear = std::min(clear, static_cast<float>(listed_m));
  }
}

// A beam of a profile saw no farther than its return, whether or not that became an obstacle.
void FanView::limit_to_returns(const SonarPing& ping) noexcept {
  const auto returns = std::min<std::uint32_t>(beams_, ping.point_count);
  for (std::uint32_t beam = 0; beam < returns; ++beam) {
    if (ping.points[beam].range_m > 0.0) {
      clear_m_[beam] = std::min(clear_m_[beam], static_cast<float>(ping.points[beam].range_m));
    }
  }
}

void FanView::shade_shape(const Obstacle& o) noexcept {
  for_each_edge(o, [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) { shade_edge(a, b); });
}

void FanView::shade(double beam, double range_m) noexcept {
  if (beam >= 0.0 && beam < beams_) {
    float& clear = clear_m_[static_cast<std::size_t>(beam)];
    clear = std::min(clear, static_cast<float>(range_m));
  }
}

// Every beam between its ends, and the nearest to each end.
void FanView::shade_edge(const Eigen::Vector2d& from, const Eigen::Vector2d& to) noexcept {
  const double from_beam = beam_at(from.x(), from.y());
  const double to_beam = beam_at(to.x(), to.y());
  shade(std::round(from_beam), from.norm());
  shade(std::round(to_beam), to.norm());
  const double first = std::max(0.0, std::ceil(std::min(from_beam, to_beam)));
  const double last = std::min(beams_ - 1.0, std::floor(std::max(from_beam, to_beam)));
  const Eigen::Vector2d way = to - from;
  for (double beam = first; beam <= last; beam += 1.0) {
    const Eigen::Vector2d sight = first_axis(first_bearing_rad_ + beam * beam_step_rad_);
    const double across = sight.x() * way.y() - sight.y() * way.x();
    if (std::abs(across) > 0.0) {
      const double share = (from.x() * sight.y() - from.y() * sight.x()) / across;
      shade(beam, (from + std::clamp(share, 0.0, 1.0) * way).norm());
    }
  }
}

CutEnds FanView::cut_ends(const Obstacle& o) const noexcept {
  struct End {
    double beam;
    double range_m;
  };
  End port{std::numeric_limits<double>::infinity(), 0.0};
  End starboard{-std::numeric_limits<double>::infinity(), 0.0};
  for_each_edge(o, [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    for (const Eigen::Vector2d& at : {a, b}) {
      const double beam = beam_at(at.x(), at.y());
      port = beam < port.beam ? End{beam, at.norm()} : port;
      starboard = beam > starboard.beam ? End{beam, at.norm()} : starboard;
    }
  });
  return {port.beam < kCutBeams || is_hidden(std::floor(port.beam) - 1.0, port.range_m) ||
              is_hidden(std::floor(port.beam) - 2.0, port.range_m),
          starboard.beam > beams_ - 1.0 - kCutBeams ||
              is_hidden(std::ceil(starboard.beam) + 1.0, starboard.range_m) ||
              is_hidden(std::ceil(starboard.beam) + 2.0, starboard.range_m)};
}

// Behind something nearer; beyond the fan nothing hides anything.
bool FanView::is_hidden(double beam, double range_m) const noexcept {
  return beam >= 0.0 && beam < beams_ &&
         static_cast<double>(clear_m_[static_cast<std::size_t>(beam)]) < range_m - kHiddenFrom_m;
}

double FanView::visible_share(const Obstacle& ellipse) const noexcept {
  const double range_m = std::hypot(ellipse.centre_x_m, ellipse.centre_y_m);
  const double size_m = std::max(ellipse.semi_axis_first_m, ellipse.semi_axis_second_m);
  if (range_m - size_m < nearest_m_ || range_m + size_m > farthest_m_) {
    return 0.0;
  }
  const double middle = beam_at(ellipse.centre_x_m, ellipse.centre_y_m);
  if (middle < kEdgeBeams || middle > beams_ - 1.0 - kEdgeBeams) {
    return 0.0;
  }
  const double half = std::max(size_m / range_m / beam_step_rad_, 0.5);
  const auto from = static_cast<std::size_t>(std::max(0.0, std::floor(middle - half)));
  const auto to = static_cast<std::size_t>(std::min(beams_ - 1.0, std::ceil(middle + half)));
  std::size_t visible = 0;
  for (std::size_t beam = from; beam <= to; ++beam) {
    visible += static_cast<double>(clear_m_[beam]) > range_m - size_m - kHiddenFrom_m ? 1U : 0U;
  }
  return static_cast<double>(visible) / static_cast<double>(to - from + 1);
}

}  // namespace lodesman
