// SPDX-License-Identifier: Apache-2.0
#include "low_level/sonar/track_oracle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "mid_level/geometry/obstacle_distance.h"

namespace lodesman {
namespace {

using Vec = Eigen::Vector2d;

constexpr std::size_t kLatePings = 32;
constexpr int kEdgeSamples = 24;   // of an ellipse at least ...
constexpr double kSample_m = 0.5;  // ... and else about so far apart; of a wall at most
// Of a velocity while nothing better is known.
constexpr double kUnknownVelocitySigma_m_s = 0.5;
// Where it should be seen and is not for so long, it is gone.
constexpr Duration kGoneAfter = std::chrono::seconds{2};

[[nodiscard]] Vec ellipse_point(const Obstacle& ellipse, double angle_rad) noexcept {
  const Vec along = first_axis(ellipse.angle_rad);
  const Vec across{along.y(), -along.x()};
  return Vec{ellipse.centre_x_m, ellipse.centre_y_m} +
         std::cos(angle_rad) * ellipse.semi_axis_first_m * along +
         std::sin(angle_rad) * ellipse.semi_axis_second_m * across;
}

// How many samples on from one at p the next is that may be within range of the viewer: those
// between lie nearer to p than p is too far off.
[[nodiscard]] std::int64_t samples_on(const Vec& p, const KnownView& view,
                                      double spacing_m) noexcept {
  const double too_far_m = (p - view.pose.p_WV.xy_m).norm() - view.range_m;
  return spacing_m > 0.0
             ? std::max<std::int64_t>(1, static_cast<std::int64_t>(too_far_m / spacing_m))
             : 1;
}

// Calls visit(point) until it says that it has seen enough.
template <class Visit>
void for_each_edge_point(const Obstacle& ellipse, const KnownView& view, Visit visit) noexcept {
  const double edge_max_m =
      2.0 * std::numbers::pi * std::max(ellipse.semi_axis_first_m, ellipse.semi_axis_second_m);
  const auto samples = std::max<std::int64_t>(kEdgeSamples, std::llround(edge_max_m / kSample_m));
  const double spacing_m = edge_max_m / static_cast<double>(samples);
  for (std::int64_t i = 0; i < samples;) {
    const double share = static_cast<double>(i) / static_cast<double>(samples);
    const Vec p = ellipse_point(ellipse, 2.0 * std::numbers::pi * share);
    if (visit(p)) {
      return;
    }
    i += samples_on(p, view, spacing_m);
  }
}

[[nodiscard]] bool segments_cross(const Vec& a, const Vec& b, const Vec& c, const Vec& d) noexcept {
  const auto side = [](const Vec& p, const Vec& q, const Vec& r) {
    return (q.x() - p.x()) * (r.y() - p.y()) - (q.y() - p.y()) * (r.x() - p.x());
  };
  return (side(a, b, c) > 0.0) != (side(a, b, d) > 0.0) &&
         (side(c, d, a) > 0.0) != (side(c, d, b) > 0.0);
}

// Whether an obstacle lies across the line of sight.
[[nodiscard]] bool hides(const Obstacle& obstacle, const Vec& from, const Vec& to) noexcept {
  if (obstacle.shape != ObstacleShape::kEllipse) {
    bool crossed = false;
    for_each_side(obstacle, [&](const Vec& a, const Vec& b) {
      crossed = crossed || segments_cross(from, to, a, b);
    });
    return crossed;
  }
  const Vec along = first_axis(obstacle.angle_rad);
  const Vec across{along.y(), -along.x()};
  // In the frame that makes the ellipse a unit circle.
  const auto to_unit = [&](const Vec& p) {
    const Vec offset = p - Vec{obstacle.centre_x_m, obstacle.centre_y_m};
    return Vec{along.dot(offset) / obstacle.semi_axis_first_m,
               across.dot(offset) / obstacle.semi_axis_second_m};
  };
  return segment_distance_m(to_unit(from), to_unit(to), Vec::Zero()) < 1.0;
}

// Calls visit(point, distance along the wall) at most kSample_m apart, where it may be in range.
template <class Visit>
void for_each_wall_point(const Obstacle& wall, const KnownView& view, Visit visit) noexcept {
  double walked_m = 0.0;
  for_each_side(wall, [&](const Vec& a, const Vec& b) {
    const double length_m = (b - a).norm();
    const auto parts =
        std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(length_m / kSample_m)));
    const double spacing_m = length_m / static_cast<double>(parts);
    for (std::int64_t i = 0; i <= parts;) {
      const double share = static_cast<double>(i) / static_cast<double>(parts);
      const Vec p = a + share * (b - a);
      visit(p, walked_m + share * length_m);
      i += samples_on(p, view, spacing_m);
    }
    walked_m += length_m;
  });
}

// The part of a polyline between two distances along it.
[[nodiscard]] Obstacle part_of(const Obstacle& wall, double from_m, double to_m) noexcept {
  Obstacle part = wall;
  part.vertex_count = 0;
  const auto add = [&](const Vec& p) {
    if (part.vertex_count < kMaxVertices) {
      part.vertices[part.vertex_count++] = {p.x(), p.y()};
    }
  };
  double walked_m = 0.0;
  for_each_side(wall, [&](const Vec& a, const Vec& b) {
    const double length_m = (b - a).norm();
    const double first_m = std::max(from_m, walked_m);
    const double last_m = std::min(to_m, walked_m + length_m);
    if (length_m > 0.0 && first_m <= last_m) {
      if (part.vertex_count == 0) {
        add(a + (first_m - walked_m) / length_m * (b - a));
      }
      add(a + (last_m - walked_m) / length_m * (b - a));
    }
    walked_m += length_m;
  });
  if (part.vertex_count == 0) {  // a wall without length: a post
    part.vertex_count = wall.vertex_count;
  }
  return part;
}

}  // namespace

TrackOracle::TrackOracle(std::span<const MovingObstacle> world, const TrackOracleOptions& options)
    : world_{world},
      options_{options},
      now_(world.size()),
      known_(world.size()),
      late_(kLatePings) {
  nearest_.reserve(world.size());
  random_.reserve(world.size());
  for (std::size_t i = 0; i < world.size(); ++i) {
    random_.emplace_back("track oracle " + std::to_string(i + 1), options.seed);
  }
}

// How much was known of a wall is not: what is seen of it next stands for all of it.
void TrackOracle::resume(const Tracks& last) noexcept {
  for (std::uint32_t i = 0; i < last.count; ++i) {
    const Track& track = last.tracks[i];
    if (track.id == 0 || track.id > known_.size()) {
      continue;
    }
    Known& known = known_[track.id - 1];
    known.track = track;
    known.first_seen = track.last_seen;
    known.from_m = std::numeric_limits<double>::infinity();
    known.to_m = -known.from_m;
    known.known = true;
  }
}

void TrackOracle::see(const KnownView& view, Tracks& out) noexcept {
  for (std::size_t i = 0; i < world_.size(); ++i) {
    now_[i] = world_[i].at(view.scenario_time_s);
  }
  for (std::size_t i = 0; i < world_.size(); ++i) {
    Known& known = known_[i];
    const bool dropped_out = random_[i].uniform() < options_.dropout;
    const Seen seen = dropped_out ? Seen{} : look_at(i, view);
    if (seen.any) {
      learn(known, i, seen, view);
      continue;
    }
    const Duration unseen = view.captured - known.track.last_seen;
    known.known = known.known && unseen <= options_.memory &&
                  (unseen <= kGoneAfter || !should_be_seen(known, i, view));
  }
  write(view, late_[pings_ % kLatePings]);
  ++pings_;
  for (std::uint64_t back = 1; back <= std::min<std::uint64_t>(pings_, kLatePings); ++back) {
    const Tracks& then = late_[(pings_ - back) % kLatePings];
    if (then.captured <= view.captured - options_.delay || back == kLatePings) {
      out = then;
      return;
    }
  }
  out = Tracks{};  // nothing is old enough yet
  out.frame = view.frame;
  out.captured = view.captured;
}

TrackOracle::Seen TrackOracle::look_at(std::size_t index, const KnownView& view) const noexcept {
  Seen seen;
  if (!world_[index].exists(view.scenario_time_s)) {
    return seen;
  }
  const Obstacle& obstacle = now_[index];
  if (obstacle.shape == ObstacleShape::kEllipse) {
    for_each_edge_point(obstacle, view, [&](const Vec& p) {
      seen.any = in_sight(p, index, view);
      return seen.any;
    });
    return seen;
  }
  for_each_wall_point(obstacle, view, [&](const Vec& p, double along_m) {
    if (in_sight(p, index, view)) {
      seen.from_m = seen.any ? std::min(seen.from_m, along_m) : along_m;
      seen.to_m = seen.any ? std::max(seen.to_m, along_m) : along_m;
      seen.any = true;
    }
  });
  return seen;
}

bool TrackOracle::in_sight(const Vec& p_W, std::size_t index,
                           const KnownView& view) const noexcept {
  const Vec p_V = view.pose.to_vehicle({p_W}).xy_m;
  if (p_V.norm() > view.range_m ||
      std::abs(std::atan2(p_V.x(), p_V.y())) > options_.sector_rad / 2.0) {
    return false;
  }
  const Vec& own = view.pose.p_WV.xy_m;
  for (std::size_t i = 0; i < world_.size(); ++i) {
    if (i != index && world_[i].exists(view.scenario_time_s) && hides(now_[i], own, p_W)) {
      return false;
    }
  }
  return true;
}

// Judged at the middle of what is known, moved on to now.
bool TrackOracle::should_be_seen(const Known& known, std::size_t index,
                                 const KnownView& view) const noexcept {
  const Track& track = known.track;
  const double age_s = to_seconds(view.captured - track.last_seen);
  const Vec moved{track.velocity_x_m_s * age_s, track.velocity_y_m_s * age_s};
  Vec middle{track.shape.centre_x_m, track.shape.centre_y_m};
  if (track.shape.shape != ObstacleShape::kEllipse) {
    middle.setZero();
    for (std::uint32_t i = 0; i < track.shape.vertex_count; ++i) {
      middle +=
          Vec{track.shape.vertices[i].x_m, track.shape.vertices[i].y_m} / track.shape.vertex_count;
    }
  }
  return in_sight(middle + moved, index, view);
}

void TrackOracle::learn(Known& known, std::size_t index, const Seen& seen,
                        const KnownView& view) noexcept {
  const MovingObstacle& truth = world_[index];
  if (!known.known) {
    known = {};
    known.known = true;
    known.first_seen = view.captured;
    known.from_m = seen.from_m;
    known.to_m = seen.to_m;
  }
  known.from_m = std::min(known.from_m, seen.from_m);
  known.to_m = std::max(known.to_m, seen.to_m);
  Track& track = known.track;
  track.id = static_cast<std::uint32_t>(index) + 1;
  track.last_seen = view.captured;
  track.shape = now_[index].shape == ObstacleShape::kPolyline
                    ? part_of(now_[index], known.from_m, known.to_m)
                    : now_[index];
  track.shape.id = track.id;
  RandomStream& random = random_[index];
  const double sigma_m = options_.place_sigma_m;
  track.shape = translated(track.shape, sigma_m * random.gaussian(), sigma_m * random.gaussian());
  track.place_xx_m2 = track.place_yy_m2 = sigma_m * sigma_m;
  const double velocity_sigma_m_s = velocity_sigma(view.captured - known.first_seen);
  const bool moves = view.scenario_time_s < truth.stops_at_s;
  const auto measured = [&](double true_m_s) {
    const double noise_m_s = velocity_sigma_m_s * random.gaussian();
    return velocity_sigma_m_s < kUnknownVelocitySigma_m_s ? (moves ? true_m_s : 0.0) + noise_m_s
                                                          : 0.0;
  };
  track.velocity_x_m_s = measured(truth.velocity_x_m_s);
  track.velocity_y_m_s = measured(truth.velocity_y_m_s);
  track.velocity_xx_m2_s2 = track.velocity_yy_m2_s2 = velocity_sigma_m_s * velocity_sigma_m_s;
}

// A velocity is a difference of two places: unknown at first sight, surer the longer it is watched.
double TrackOracle::velocity_sigma(Duration watched) const noexcept {
  if (watched <= Duration::zero()) {
    return kUnknownVelocitySigma_m_s;
  }
  const double of_places_m_s = std::numbers::sqrt2 * options_.place_sigma_m / to_seconds(watched);
  return std::min(kUnknownVelocitySigma_m_s,
                  std::hypot(options_.velocity_sigma_m_s, of_places_m_s));
}

void TrackOracle::write(const KnownView& view, Tracks& out) noexcept {
  nearest_.clear();
  for (std::uint32_t i = 0; i < known_.size(); ++i) {
    if (known_[i].known) {
      const double distance_m = edge_distance_m(known_[i].track.shape, view.pose.p_WV);
      nearest_.push_back({distance_m, i});
    }
  }
  const std::size_t kept = std::min(nearest_.size(), kMaxObstacles);
  std::sort(nearest_.begin(), nearest_.end());
  std::sort(nearest_.begin(), nearest_.begin() + static_cast<std::ptrdiff_t>(kept),
            [](const Near& a, const Near& b) { return a.index < b.index; });
  out.frame = view.frame;
  out.captured = view.captured;
  out.dropped = static_cast<std::uint32_t>(nearest_.size() - kept);
  out.count = static_cast<std::uint32_t>(kept);
  for (std::size_t i = 0; i < kept; ++i) {
    out.tracks[i] = known_[nearest_[i].index].track;
  }
}

}  // namespace lodesman
