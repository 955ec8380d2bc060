// SPDX-License-Identifier: Apache-2.0
#include "low_level/thrust/guard.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "low_level/thrust/obstacle_middle.h"
#include "mid_level/base/heading.h"

namespace lodesman {
namespace {

constexpr Duration kLongestGap = std::chrono::seconds{10};  // of steps that is caught up with
// What is asked for beside something near is judged by where it leads if it goes on.
constexpr Duration kLookOn = std::chrono::seconds{2};
constexpr double kStill_m_s = 0.03;     // slower counts as stopped
constexpr double kUnderWay_m_s = 0.10;  // slower is left to the water where nobody steers
constexpr double kStill_rad_s = 0.02;   // turns by no more than it is wide
constexpr double kClosing_m = 0.002;    // less nearer is not closing in
constexpr int kFull = 100;
// Slower, by its places in the last pings, counts as at rest; faster than anything on the water is
// no speed but another thing, or a place that was corrected.
constexpr double kMoves_m_s = 0.10;
constexpr double kFastest_m_s = 5.0;
constexpr double kHelps_m = 0.05;  // of distance to what moves, by stopping
constexpr Duration kWatchedFor_min = std::chrono::milliseconds{50};
constexpr Duration kWatchedFor_max = std::chrono::seconds{1};

}  // namespace

// A measured heading is the low level's own too, and better than a reckoned one.
void Guard::advance(Time now, const Attitude* attitude) noexcept {
  if (moved_to_ == Time{} || now < moved_to_) {
    moved_to_ = now;
  }
  const double heading_before_rad = motion_.heading_rad;
  Duration left = std::min(now - moved_to_, kLongestGap);
  constexpr Duration kStep = std::chrono::milliseconds{50};
  while (left > Duration::zero()) {
    const Duration step = std::min(left, kStep);
    const bool acts = now - left >= thrust_acts_;
    const SurgeAndHead thrust{acts ? thrust_.surge_ref : 0, thrust_.head_ref};
    motion_ = model_.advanced(motion_, thrust, to_seconds(step));
    left -= step;
  }
  if (attitude != nullptr) {
    if (measured_rad_) {
      motion_.heading_rad = heading_before_rad + wrap_to_pi(attitude->heading_rad - *measured_rad_);
    }
    motion_.yaw_rate_rad_s = attitude->yaw_rate_rad_s;
  }
  measured_rad_ = attitude != nullptr ? std::optional{attitude->heading_rad} : std::nullopt;
  moved_to_ = now;
  past_[past_count_ % kMaxPast] = {now, motion_};
  ++past_count_;
  status_.speed_m_s = motion_.surge_m_s;
}

// Between two steps on a straight line; what is older than all that is remembered counts as the
// oldest, what is later as the newest.
ReckonedMotion Guard::motion_at(Time at) const noexcept {
  const std::size_t kept = std::min(past_count_, kMaxPast);
  ReckonedMotion later = motion_;
  Time later_at = moved_to_;
  for (std::size_t back = 1; back <= kept; ++back) {
    const Past& past = past_[(past_count_ - back) % kMaxPast];
    if (past.at <= at) {
      const double whole_s = to_seconds(later_at - past.at);
      const double share = whole_s > 0.0 ? std::min(1.0, to_seconds(at - past.at) / whole_s) : 1.0;
      ReckonedMotion between = past.motion;
      between.x_m = std::lerp(past.motion.x_m, later.x_m, share);
      between.y_m = std::lerp(past.motion.y_m, later.y_m, share);
      between.heading_rad = std::lerp(past.motion.heading_rad, later.heading_rad, share);
      return between;
    }
    later = past.motion;
    later_at = past.at;
  }
  return later;
}

// Far enough for all that may be asked for while a frame is in use.
double Guard::sight_m() const noexcept {
  const double fastest_m_s =
      std::max(options_.hull.speeds.speed_m_s(kFull), std::abs(motion_.surge_m_s));
  const double stop_s = to_seconds(options_.reaction + options_.brake_delay) +
                        options_.hull.mass_kg / options_.hull.surge_drag_n_s_per_m;
  const double age_s = to_seconds(options_.frame_age_max + kLookOn);
  return std::hypot(options_.hull_half_length_m, options_.hull_half_beam_m) + options_.margin_m +
         options_.release_m + fastest_m_s * (stop_s + age_s);
}

void Guard::see(const SonarObstacles& seen) noexcept {
  edges_.take(seen, sight_m());
  Frame& frame = frames_[frame_count_ % kFrames];
  frame.captured = std::min(seen.captured, moved_to_);  // what claims to be of later is of now
  const ReckonedMotion then = motion_at(frame.captured);
  const double sine = std::sin(then.heading_rad);
  const double cosine = std::cos(then.heading_rad);
  const auto placed = [&](double x_m, double y_m) noexcept {
    return std::pair{then.x_m + x_m * cosine + y_m * sine, then.y_m - x_m * sine + y_m * cosine};
  };
  frame.count = 0;
  for (const EdgePoint& point : edges_.points()) {
    const auto [x_m, y_m] = placed(point.x_m, point.y_m);
    frame.points[frame.count++] = {x_m, y_m, point.obstacle};
  }
  const std::uint32_t count = std::min<std::uint32_t>(seen.count, kMaxObstacles);
  for (std::uint32_t i = 0; i < kMaxObstacles; ++i) {
    frame.things[i] = Thing{};
    if (i < count && seen.obstacles[i].id != 0) {
      const EdgePoint middle = middle_of(seen.obstacles[i]);
      const auto [x_m, y_m] = placed(middle.x_m, middle.y_m);
      frame.things[i] = watched({seen.obstacles[i].id, x_m, y_m}, frame.captured);
    }
  }
  ++frame_count_;
}

// How it has moved since the oldest of the last pings that shows it, as the boat is reckoned to
// have moved: a current, or a slip, is in it.
Guard::Thing Guard::watched(Thing thing, Time captured) const noexcept {
  for (std::size_t back = std::min(frame_count_, kFrames - 1); back > 0; --back) {
    const Frame& before = frames_[(frame_count_ - back) % kFrames];
    const Duration watched = captured - before.captured;
    const auto then = std::find_if(before.things.begin(), before.things.end(),
                                   [&](const Thing& other) { return other.id == thing.id; });
    if (then == before.things.end() || watched < kWatchedFor_min || watched > kWatchedFor_max) {
      continue;
    }
    const double x_m_s = (thing.x_m - then->x_m) / to_seconds(watched);
    const double y_m_s = (thing.y_m - then->y_m) / to_seconds(watched);
    const double speed_m_s = std::hypot(x_m_s, y_m_s);
    thing.moves = speed_m_s > kMoves_m_s && speed_m_s < kFastest_m_s;
    thing.x_m_s = thing.moves ? x_m_s : 0.0;
    thing.y_m_s = thing.moves ? y_m_s : 0.0;
    return thing;
  }
  return thing;
}

void Guard::begin(Way& way, ReckonedMotion& at) const noexcept {
  way.count = 0;
  way.reach_m = std::hypot(options_.hull_half_length_m, options_.hull_half_beam_m);
  at = motion_;
  add(way, at);
}

void Guard::add(Way& way, const ReckonedMotion& at) const noexcept {
  const double after_s =
      way.count == 0 ? 0.0 : way.places[way.count - 1].after_s + ReckoningModel::kStepMax_s;
  way.places[way.count++] = {at.x_m, at.y_m, std::sin(at.heading_rad), std::cos(at.heading_rad),
                             after_s};
  const double off_m = std::hypot(at.x_m - motion_.x_m, at.y_m - motion_.y_m) +
                       std::hypot(options_.hull_half_length_m, options_.hull_half_beam_m);
  way.reach_m = std::max(way.reach_m, off_m);
}

void Guard::sail(Way& way, ReckonedMotion& at, const SurgeAndHead& thrust,
                 double for_s) const noexcept {
  for (double left_s = for_s; left_s > 1e-9 && way.count < kMaxWay;
       left_s -= ReckoningModel::kStepMax_s) {
    at = model_.advanced(at, thrust, ReckoningModel::kStepMax_s);
    add(way, at);
  }
}

// What is asked for a while, then stopped as hard as can be.
void Guard::foresee(const SurgeAndHead& asked, Duration for_so_long, Way& way) const noexcept {
  ReckonedMotion at;
  begin(way, at);
  sail(way, at, asked, to_seconds(for_so_long));
  sail(way, at, {}, to_seconds(options_.brake_delay));
  const double sense = at.surge_m_s > 0.0 ? 1.0 : -1.0;
  const SurgeAndHead brakes{sense > 0.0 ? -kFull : kFull, 0};
  while (sense * at.surge_m_s > kStill_m_s && way.count < kMaxWay) {
    sail(way, at, brakes, ReckoningModel::kStepMax_s);
  }
  at.surge_m_s = 0.0;
  while (std::abs(at.yaw_rate_rad_s) > kStill_rad_s && way.count < kMaxWay) {
    sail(way, at, {}, ReckoningModel::kStepMax_s);
  }
}

// What is asked for, for as long as it would take to stop. What comes after that the boat has no
// part in: stopped, it only turns on the spot.
void Guard::foresee_on(const SurgeAndHead& asked) noexcept {
  std::size_t last = soon_.count - 1;
  const Place& end = soon_.places[last];
  while (last > 0 && std::hypot(soon_.places[last - 1].x_m - end.x_m,
                                soon_.places[last - 1].y_m - end.y_m) <= 0.0) {
    --last;
  }
  ReckonedMotion at;
  begin(on_, at);
  sail(on_, at, asked, soon_.places[last].after_s);
}

double Guard::hull_distance_m(const Place& place, const Spot& spot) const noexcept {
  const double dx_m = spot.x_m - place.x_m;
  const double dy_m = spot.y_m - place.y_m;
  const double across_m =
      std::abs(dx_m * place.cosine - dy_m * place.sine) - options_.hull_half_beam_m;
  const double along_m =
      std::abs(dx_m * place.sine + dy_m * place.cosine) - options_.hull_half_length_m;
  return std::hypot(std::max(across_m, 0.0), std::max(along_m, 0.0)) +
         std::min(std::max(across_m, along_m), 0.0);
}

// Nearer than the margin, and nearer than the hull is to anything now: along a wall, or away from
// it, nothing is in the way. What is within the margin already is looked at for longer.
std::optional<double> Guard::in_the_way_m(const Frame& frame) const noexcept {
  const double margin_m = options_.margin_m + (is_stopping() ? options_.release_m : 0.0);
  const double age_s = to_seconds(moved_to_ - frame.captured);
  const auto points = std::span{frame.points}.first(frame.count);
  double now_m = std::numeric_limits<double>::infinity();
  for (const EdgePoint& point : points) {
    const Thing& thing = frame.things[point.obstacle];
    const Spot spot{point.x_m + age_s * thing.x_m_s, point.y_m + age_s * thing.y_m_s};
    if (is_within(later_.reach_m + margin_m, spot)) {
      now_m = std::min(now_m, hull_distance_m(later_.places[0], spot));
    }
  }
  const double too_near_m = std::min(margin_m, now_m - kClosing_m);
  const Way& way = is_stopping() || now_m < margin_m ? later_ : soon_;
  const bool is_closed_in_on = std::any_of(points.begin(), points.end(), [&](const EdgePoint& p) {
    const Thing& thing = frame.things[p.obstacle];
    const Spot spot{p.x_m + age_s * thing.x_m_s, p.y_m + age_s * thing.y_m_s};
    return thing.moves ? meets(thing, spot, std::min(options_.margin_m, too_near_m))
                       : comes_near(way, thing, spot, too_near_m);
  });
  return is_closed_in_on ? std::optional{now_m} : std::nullopt;
}

// What moves is met by going on, and stopping helps: who flees from it, or is run down, is left to
// who steers.
bool Guard::meets(const Thing& thing, const Spot& spot, double too_near_m) const noexcept {
  if (status_.state == GuardState::kHolding || std::abs(motion_.surge_m_s) <= kUnderWay_m_s ||
      !comes_near(on_, thing, spot, too_near_m)) {
    return false;
  }
  double going_on_m = std::numeric_limits<double>::infinity();
  double stopping_m = going_on_m;
  for (std::size_t i = 0; i < std::min(on_.count, soon_.count); ++i) {
    const double after_s = on_.places[i].after_s;
    const Spot then{spot.x_m + after_s * thing.x_m_s, spot.y_m + after_s * thing.y_m_s};
    going_on_m = std::min(going_on_m, hull_distance_m(on_.places[i], then));
    stopping_m = std::min(stopping_m, hull_distance_m(soon_.places[i], then));
  }
  return stopping_m < too_near_m && stopping_m > going_on_m + kHelps_m;
}

bool Guard::comes_near(const Way& way, const Thing& thing, const Spot& spot,
                       double too_near_m) const noexcept {
  const double its_way_m = std::hypot(thing.x_m_s, thing.y_m_s) * way.places[way.count - 1].after_s;
  if (!is_within(way.reach_m + too_near_m + its_way_m, spot)) {
    return false;
  }
  const auto places = std::span{way.places}.first(way.count);
  return std::any_of(places.begin(), places.end(), [&](const Place& place) {
    const Spot then{spot.x_m + place.after_s * thing.x_m_s, spot.y_m + place.after_s * thing.y_m_s};
    return hull_distance_m(place, then) < too_near_m;
  });
}

bool Guard::is_within(double reach_m, const Spot& spot) const noexcept {
  const double dx_m = spot.x_m - motion_.x_m;
  const double dy_m = spot.y_m - motion_.y_m;
  return reach_m > 0.0 && dx_m * dx_m + dy_m * dy_m <= reach_m * reach_m;
}

std::optional<double> Guard::confirmed_m(bool fresh_only, Time now) const noexcept {
  double nearest_m = std::numeric_limits<double>::infinity();
  int count = 0;
  for (std::size_t back = 1; back <= std::min(frame_count_, kFrames); ++back) {
    const Frame& frame = frames_[(frame_count_ - back) % kFrames];
    if (fresh_only && now - frame.captured > options_.frame_age_max) {
      continue;
    }
    if (const auto found_m = in_the_way_m(frame)) {
      nearest_m = std::min(nearest_m, *found_m);
      ++count;
    }
  }
  return count >= 2 ? std::optional{nearest_m} : std::nullopt;
}

bool Guard::sees(Time now) const noexcept {
  return frame_count_ > 0 &&
         now - frames_[(frame_count_ - 1) % kFrames].captured <= options_.frame_age_max;
}

bool Guard::is_stopping() const noexcept {
  return status_.state == GuardState::kBraking || status_.state == GuardState::kHolding;
}

std::optional<SurgeAndHead> Guard::judge(const SurgeAndHead& asked, const GuardView& view,
                                         Time now) noexcept {
  if (!view.is_silent) {
    silent_since_ = Time{};
  } else if (silent_since_ == Time{}) {
    silent_since_ = now;
  }
  const GuardState next = next_state(asked, view, now);
  if (next != status_.state || status_.since == Time{}) {
    status_.state = next;
    status_.since = now;
  }
  switch (status_.state) {
    case GuardState::kBraking: return brake();
    case GuardState::kHolding: return SurgeAndHead{};
    case GuardState::kOff:
    case GuardState::kOverridden:
    case GuardState::kIdle:
    case GuardState::kBlind:
    case GuardState::kWatching: break;
  }
  return std::nullopt;
}

GuardState Guard::next_state(const SurgeAndHead& asked, const GuardView& view, Time now) noexcept {
  if (!options_.is_on) {
    return GuardState::kOff;
  }
  if (!view.may_turn) {
    return GuardState::kIdle;
  }
  return view.is_overridden ? GuardState::kOverridden : on_guard(asked, view, now);
}

// What stops goes on by the frames it stopped for, however old: a sonar that falls silent before
// a rock does not let the boat go on.
GuardState Guard::on_guard(const SurgeAndHead& asked, const GuardView& view, Time now) noexcept {
  foresee(asked, options_.reaction, soon_);
  foresee(asked, kLookOn, later_);
  foresee_on(asked);
  const auto obstacle_m = confirmed_m(!is_stopping(), now);
  const bool stops_for_silence = is_stopping() && status_.reason == GuardReason::kSilence;
  const bool is_left_alone = view.is_silent && now - silent_since_ >= options_.silence_neutral;
  if (is_stopping()) {
    return go_on_stopping(obstacle_m || (stops_for_silence && is_left_alone), now);
  }
  const int against = motion_.surge_m_s > 0.0 ? -kFull : kFull;
  if (obstacle_m && asked.surge_ref != against) {
    trip(GuardReason::kObstacle, *obstacle_m, now);
    return go_on_stopping(true, now);
  }
  if (is_left_alone && std::abs(motion_.surge_m_s) > kUnderWay_m_s) {
    trip(GuardReason::kSilence, 0.0, now);
    return GuardState::kBraking;
  }
  return sees(now) ? GuardState::kWatching : GuardState::kBlind;
}

GuardState Guard::go_on_stopping(bool is_needed, Time now) const noexcept {
  if (!is_needed) {
    return sees(now) ? GuardState::kWatching : GuardState::kBlind;
  }
  const bool has_taken_long =
      status_.state == GuardState::kBraking && now - status_.since >= options_.brake_max;
  const bool has_stopped = sense() * motion_.surge_m_s <= kStill_m_s;
  const bool holds = status_.state == GuardState::kHolding;
  return holds || has_stopped || has_taken_long ? GuardState::kHolding : GuardState::kBraking;
}

void Guard::trip(GuardReason reason, double distance_m, Time now) noexcept {
  ++status_.trips;
  status_.reason = reason;
  status_.tripped = now;
  status_.distance_m = distance_m;
  status_.trip_speed_m_s = motion_.surge_m_s;
}

// Of the way that was made at the last trip: what stopped it never drives it back.
double Guard::sense() const noexcept { return status_.trip_speed_m_s < 0.0 ? -1.0 : 1.0; }

SurgeAndHead Guard::brake() const noexcept { return {sense() < 0.0 ? kFull : -kFull, 0}; }

// A box that ramps its thrust, or rests between ahead and astern, gives none of it at once.
void Guard::applied(const SurgeAndHead& thrust, Time now) noexcept {
  const bool reverses = thrust.surge_ref != 0 && thrust_.surge_ref != 0 &&
                        (thrust.surge_ref > 0) != (thrust_.surge_ref > 0);
  if (reverses) {
    thrust_acts_ = now + options_.brake_delay;
  }
  thrust_ = thrust;
}

}  // namespace lodesman
