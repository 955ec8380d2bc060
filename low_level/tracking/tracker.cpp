// SPDX-License-Identifier: Apache-2.0
#include "low_level/tracking/tracker.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "low_level/sonar/known_obstacles.h"
#include "low_level/sonar/segmentation_options.h"
#include "low_level/tracking/sightings.h"
#include "mid_level/base/time.h"

namespace lodesman {
namespace {

// Chi squared of two degrees of freedom: once in a thousand it lies farther off by chance.
constexpr double kGate = 13.8;
constexpr double kKnownStill = 0.5;         // of its cells occupied: what rests, seen again
constexpr double kPublished = 0.5;          // [-] probability that it is there
constexpr double kGone = 0.1;               // [-]
constexpr double kRestsUnseen_s = 2.0;      // what rests is in the grid, and need not be followed
constexpr double kLostSigma_m = 6.0;        // what moves and may be anywhere by now
constexpr double kLongestSilence_s = 60.0;  // after which nothing is gone on with
constexpr double kFastest_m_s = 50.0;       // of anything on the water
constexpr double kGridReach_m = 38.0;    // of the grid to each side, less what rolling may cut off
constexpr std::size_t kRoomForFar = 12;  // of the list, at most, if there are so many
constexpr std::uint32_t kFirstFarId = 0xfffff000U;  // of what lies beyond it: its ids do not last
constexpr double kMostWakeSteps = 64.0;
constexpr double kLongestGap_s = 1.0;  // between pings, that a filter is moved on by at once
constexpr double kStillSigma_m = 0.1;  // of a polygon's edge: less than half a cell

[[nodiscard]] double place_sigma_m(const Followed& one) noexcept {
  return std::sqrt(0.5 * one.covariance.topLeftCorner<2, 2>().trace());
}

[[nodiscard]] Obstacle shape_at(const Followed& one, const Eigen::Vector2d& place) noexcept {
  Obstacle shape = one.shape;
  shape.id = one.id;
  shape.centre_x_m = place.x();
  shape.centre_y_m = place.y();
  return shape;
}

[[nodiscard]] Obstacle shape_of(const Followed& one) noexcept { return shape_at(one, one.place()); }

[[nodiscard]] bool is_covariance(double xx, double xy, double yy) noexcept {
  return xx > 0.0 && yy > 0.0 && xy * xy < xx * yy;
}

// Of a track of before: whether a filter can go on with it.
[[nodiscard]] bool may_move(const Track& track) noexcept {
  return track.shape.shape == ObstacleShape::kEllipse && track.id != 0 &&
         track.id < StillShapes::kIdBit &&
         is_covariance(track.place_xx_m2, track.place_xy_m2, track.place_yy_m2) &&
         is_covariance(track.velocity_xx_m2_s2, track.velocity_xy_m2_s2, track.velocity_yy_m2_s2) &&
         EvidenceGrid::is_place(track.shape.centre_x_m, track.shape.centre_y_m) &&
         std::hypot(track.velocity_x_m_s, track.velocity_y_m_s) < kFastest_m_s;
}

[[nodiscard]] Track track_of(const Followed& one, Time at) noexcept {
  Track track;
  track.id = one.id;
  track.last_seen = at;
  track.shape = shape_of(one);
  track.velocity_x_m_s = one.state[2];
  track.velocity_y_m_s = one.state[3];
  track.place_xx_m2 = one.covariance(0, 0);
  track.place_xy_m2 = one.covariance(0, 1);
  track.place_yy_m2 = one.covariance(1, 1);
  track.velocity_xx_m2_s2 = one.covariance(2, 2);
  track.velocity_xy_m2_s2 = one.covariance(2, 3);
  track.velocity_yy_m2_s2 = one.covariance(3, 3);
  return track;
}

[[nodiscard]] Track track_of(const Obstacle& still, Time at) noexcept {
  Track track;
  track.id = still.id;
  track.last_seen = at;
  track.shape = still;
  track.place_xx_m2 = track.place_yy_m2 = kStillSigma_m * kStillSigma_m;
  return track;
}

}  // namespace

Tracker::Tracker(double nearest_m)
    : nearest_m_{nearest_m},
      water_{std::make_unique<EvidenceGrid>()},
      still_{std::make_unique<StillShapes>()} {}

void Tracker::resume(const Tracks& last, const VehiclePose& head, Time now) noexcept {
  now_s_ = to_seconds(now.time_since_epoch());
  last_s_ = std::min(now_s_, to_seconds(last.captured.time_since_epoch()));
  water_->look({.pose = head, .at_s = last_s_, .clear_m = {}});  // to where it is, seeing nothing
  const auto count = std::min<std::size_t>(last.count, kMaxObstacles);
  for (const Track& track : std::span{last.tracks}.first(count)) {
    if (!may_move(track)) {
      water_->add(track.shape, last_s_);
    } else if (count_ < kMostFollowed) {
      followed_[count_++] = go_on_following(track, now_s_);
      next_id_ = std::max(next_id_, track.id % kMostIds + 1);
    }
  }
}

void Tracker::see(const SonarPing& ping, const SonarObstacles& seen, const VehiclePose& head,
                  Tracks& out, std::span<const std::uint8_t> blind) noexcept {
  now_s_ = to_seconds(ping.captured.time_since_epoch());
  const double dt_s = last_s_ < 0.0 ? 0.0 : std::max(0.0, now_s_ - last_s_);
  last_s_ = now_s_;
  if (dt_s > kLongestSilence_s) {
    count_ = 0;  // what moved may be anywhere
  }
  fan_.set(ping, seen, heard_from_m(nearest_m_, ping.range_m), blind);
  place(ping, seen, head);
  for (Followed& one : std::span{followed_}.first(count_)) {
    for (double left_s = dt_s; left_s > 0.0; left_s -= kLongestGap_s) {
      predict(one, std::min(left_s, kLongestGap_s));
    }
  }
  associate();
  update_followed(head, dt_s);
  water_->look({.pose = head,
                .at_s = now_s_,
                .first_bearing_rad = fan_.sure_first_bearing_rad(),
                .beam_step_rad = fan_.beam_step_rad(),
                .nearest_m = fan_.nearest_m(),
                .farthest_m = fan_.farthest_m(),
                .clear_m = fan_.sure_clear_m()});
  begin_new();
  pick_shown(head);
  feed_grid();
  write(ping, head, out);
  forget_gone();
}

void Tracker::place(const SonarPing& ping, const SonarObstacles& seen,
                    const VehiclePose& head) noexcept {
  seen_count_ = std::min<std::size_t>(seen.count, kMaxObstacles);
  for (std::size_t i = 0; i < seen_count_; ++i) {
    seen_[i] = {};
    seen_[i].compact = is_compact(seen.obstacles[i]);
    seen_[i].outline = seen_[i].shape = to_world(head, seen.obstacles[i]);
    if (seen_[i].compact) {
      seen_[i].sighting = sighting_of(seen.obstacles[i], head, ping.beam_step_rad,
                                      fan_.cut_ends(seen.obstacles[i]));
      seen_[i].shape = is_front(seen.obstacles[i]) ? seen_[i].sighting.shape : seen_[i].outline;
    }
  }
}

// Each is given to the one that expected it nearest, the best pair first.
void Tracker::associate() noexcept {
  pair_count_ = 0;
  for (std::size_t f = 0; f < count_; ++f) {
    sighting_of_[f] = kNone;
    if (place_sigma_m(followed_[f]) >= kLostSigma_m) {
      continue;
    }
    for (std::size_t s = 0; s < seen_count_; ++s) {
      if (seen_[s].compact) {
        const double squared = squared_distance(followed_[f], seen_[s].sighting);
        if (squared < kGate) {
          pairs_[pair_count_++] = {squared + log_spread(followed_[f], seen_[s].sighting), f, s};
        }
      }
    }
  }
  const auto end = pairs_.begin() + static_cast<std::ptrdiff_t>(pair_count_);
  std::sort(pairs_.begin(), end, [](const Pair& a, const Pair& b) {
    return std::tie(a.squared, a.follower, a.seen) < std::tie(b.squared, b.follower, b.seen);
  });
  for (const Pair& pair : std::span{pairs_}.first(pair_count_)) {
    if (sighting_of_[pair.follower] == kNone && seen_[pair.seen].follower == kNone) {
      sighting_of_[pair.follower] = pair.seen;
      seen_[pair.seen].follower = pair.follower;
    }
  }
}

void Tracker::update_followed(const VehiclePose& head, double dt_s) noexcept {
  for (std::size_t f = 0; f < count_; ++f) {
    Followed& one = followed_[f];
    const Motion before = one.motion;
    if (sighting_of_[f] != kNone) {
      const Seen& seen = seen_[sighting_of_[f]];
      update(one, seen.sighting, now_s_);
      one.still_share = water_->shares_under(seen.outline).occupied;
    } else {
      miss(one, fan_.visible_share(to_vehicle(head, shape_of(one))));
    }
    decide_motion(one, in_open_water(one), now_s_, dt_s);
    if (one.motion == Motion::kMoving && before == Motion::kResting) {
      clear_wake(one);
    }
  }
}

bool Tracker::in_open_water(const Followed& one) const noexcept {
  const Eigen::Vector2d ahead = to_its_bow(one);
  return water_->state(one.place() + ahead) == WaterState::kFree ||
         water_->state(one.place() - ahead) == WaterState::kFree;
}

// It was never part of what rests, nor was anything between here and where it was thought to.
void Tracker::clear_wake(const Followed& one) noexcept {
  const Eigen::Vector2d way = one.anchor - one.place();
  const double size_m = std::max(one.shape.semi_axis_second_m, EvidenceGrid::kCell_m);
  const double steps = std::clamp(std::ceil(way.norm() / size_m), 1.0, kMostWakeSteps);
  for (double step = 0.0; step <= steps; step += 1.0) {
    Obstacle shape = shape_of(one);
    shape.centre_x_m += step / steps * way.x();
    shape.centre_y_m += step / steps * way.y();
    water_->clear(shape);
  }
}

// What lies where something rests is that, as long as it does not leave; all else that is compact
// may move.
void Tracker::begin_new() noexcept {
  for (std::size_t s = 0; s < seen_count_; ++s) {
    Seen& seen = seen_[s];
    if (seen.compact && seen.follower == kNone && count_ < kMostFollowed) {
      seen.follower = count_;
      sighting_of_[count_] = s;
      Followed& one = followed_[count_++];
      one = begin_following(seen.sighting, next_id_, now_s_);
      next_id_ = next_id_ % kMostIds + 1;
      one.still_share = water_->shares_under(seen.outline).occupied;
      if (one.still_share >= kKnownStill) {
        come_to_rest(one);
      }
    }
  }
}

// Whether it is a track of its own: what rests is, until the grid has it.
bool Tracker::is_shown(const Followed& one) const noexcept {
  const bool is_there = one.existence >= kPublished || one.last_seen_s >= now_s_;
  return is_there && (one.motion != Motion::kResting || one.still_share < kKnownStill);
}

void Tracker::pick_shown(const VehiclePose& head) noexcept {
  shown_count_ = 0;
  for (std::size_t f = 0; f < count_; ++f) {
    if (is_shown(followed_[f])) {
      shown_[shown_count_++] = f;
    }
  }
  const auto away_m = [&](std::size_t f) {
    return (followed_[f].place() - head.p_WV.xy_m).squaredNorm();
  };
  std::sort(shown_.begin(), shown_.begin() + static_cast<std::ptrdiff_t>(shown_count_),
            [&](std::size_t a, std::size_t b) {
              return std::pair{away_m(a), a} < std::pair{away_m(b), b};
            });
  shown_count_ = std::min<std::size_t>(shown_count_, kMostMovers);
}

// All that is not going to be a track of its own.
void Tracker::feed_grid() noexcept {
  for (const Seen& seen : std::span{seen_}.first(seen_count_)) {
    const auto shown = std::span{shown_}.first(shown_count_);
    if (seen.follower == kNone || followed_[seen.follower].motion == Motion::kResting ||
        std::find(shown.begin(), shown.end(), seen.follower) == shown.end()) {
      water_->add(seen.shape, now_s_);
    }
  }
}

void Tracker::forget_gone() noexcept {
  std::size_t kept = 0;
  for (std::size_t f = 0; f < count_; ++f) {
    const Followed& one = followed_[f];
    const bool rests_unseen =
        one.motion == Motion::kResting && now_s_ - one.last_seen_s > kRestsUnseen_s;
    const bool is_lost = place_sigma_m(one) >= kLostSigma_m;
    if (is_lost && one.motion == Motion::kUndecided && one.existence >= kPublished) {
      water_->add(shape_at(one, one.last_sight), now_s_);  // most things rest
    }
    if (one.existence >= kGone && !rests_unseen && !is_lost) {
      followed_[kept++] = one;
    }
  }
  count_ = kept;
}

// What this ping shows beyond the grid, and is followed by nobody.
bool Tracker::is_far(const Seen& seen, const VehiclePose& head) const noexcept {
  const Eigen::Vector2d at{seen.shape.centre_x_m, seen.shape.centre_y_m};
  return seen.follower == kNone && (at - head.p_WV.xy_m).lpNorm<Eigen::Infinity>() > kGridReach_m;
}

void Tracker::write_far(const SonarPing& ping, const VehiclePose& head,
                        Tracks& out) const noexcept {
  for (const Seen& seen : std::span{seen_}.first(seen_count_)) {
    if (!is_far(seen, head)) {
      continue;
    }
    if (out.count == kMaxObstacles) {
      out.dropped += 1;
      continue;
    }
    Track& track = out.tracks[out.count];
    track = track_of(seen.shape, ping.captured);
    track.id = track.shape.id = kFirstFarId + out.count++;
  }
}

void Tracker::write(const SonarPing& ping, const VehiclePose& head, Tracks& out) noexcept {
  out.frame = ping.number;
  out.captured = ping.captured;
  out.dropped = 0;
  out.count = 0;
  for (const std::size_t f : std::span{shown_}.first(shown_count_)) {
    out.tracks[out.count++] = track_of(followed_[f], ping.captured);
  }
  const auto seen = std::span{seen_}.first(seen_count_);
  const auto far =
      std::count_if(seen.begin(), seen.end(), [&](const Seen& one) { return is_far(one, head); });
  const auto room =
      static_cast<std::uint32_t>(kMaxObstacles - out.count -
                                 std::min<std::size_t>(static_cast<std::size_t>(far), kRoomForFar));
  for (const Obstacle& still : still_->trace(*water_, head.p_WV.xy_m, room)) {
    out.tracks[out.count++] = track_of(still, ping.captured);
  }
  write_far(ping, head, out);
}

}  // namespace lodesman
