// SPDX-License-Identifier: Apache-2.0
#include "low_level/thrust/guard.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

}  // namespace

void Guard::advance(Time now) noexcept {
  if (moved_to_ == Time{} || now < moved_to_) {
    moved_to_ = now;
  }
  Duration left = std::min(now - moved_to_, kLongestGap);
  constexpr Duration kStep = std::chrono::milliseconds{50};
  while (left > Duration::zero()) {
    const Duration step = std::min(left, kStep);
    const bool acts = now - left >= thrust_acts_;
    const SurgeAndHead thrust{acts ? thrust_.surge_ref : 0, thrust_.head_ref};
    motion_ = model_.advanced(motion_, thrust, to_seconds(step));
    left -= step;
  }
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
  ++frame_count_;
  frame.captured = std::min(seen.captured, moved_to_);  // what claims to be of later is of now
  const ReckonedMotion then = motion_at(frame.captured);
  const double sine = std::sin(then.heading_rad);
  const double cosine = std::cos(then.heading_rad);
  frame.count = 0;
  for (const EdgePoint& point : edges_.points()) {
    frame.points[frame.count++] = {then.x_m + point.x_m * cosine + point.y_m * sine,
                                   then.y_m - point.x_m * sine + point.y_m * cosine};
  }
}

void Guard::foresee(const SurgeAndHead& asked, Duration for_so_long, Way& way) const noexcept {
  way.count = 0;
  way.reach_m = 0.0;
  ReckonedMotion at = motion_;
  const auto add = [&]() noexcept {
    way.places[way.count++] = {at.x_m, at.y_m, std::sin(at.heading_rad), std::cos(at.heading_rad)};
    way.reach_m = std::max(way.reach_m, std::hypot(at.x_m - motion_.x_m, at.y_m - motion_.y_m));
  };
  const auto sail = [&](const SurgeAndHead& thrust, double for_s) noexcept {
    for (double left_s = for_s; left_s > 1e-9 && way.count < kMaxWay;) {
      const double step_s = std::min(left_s, ReckoningModel::kStepMax_s);
      at = model_.advanced(at, thrust, step_s);
      left_s -= step_s;
      add();
    }
  };
  add();
  sail(asked, to_seconds(for_so_long));
  sail({}, to_seconds(options_.brake_delay));
  const double sense = at.surge_m_s > 0.0 ? 1.0 : -1.0;
  const SurgeAndHead brakes{sense > 0.0 ? -kFull : kFull, 0};
  while (sense * at.surge_m_s > kStill_m_s && way.count < kMaxWay) {
    sail(brakes, ReckoningModel::kStepMax_s);
  }
  at.surge_m_s = 0.0;
  while (std::abs(at.yaw_rate_rad_s) > kStill_rad_s && way.count < kMaxWay) {
    sail({}, ReckoningModel::kStepMax_s);
  }
  way.reach_m += std::hypot(options_.hull_half_length_m, options_.hull_half_beam_m);
}

double Guard::hull_distance_m(const Place& place, const EdgePoint& point) const noexcept {
  const double dx_m = point.x_m - place.x_m;
  const double dy_m = point.y_m - place.y_m;
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
  const double sight_m = later_.reach_m + margin_m;
  const auto points = std::span{frame.points}.first(frame.count);
  double now_m = sight_m;
  for (const EdgePoint& point : points) {
    now_m = is_within(sight_m, point) ? std::min(now_m, hull_distance_m(later_.places[0], point))
                                      : now_m;
  }
  const double too_near_m = std::min(margin_m, now_m - kClosing_m);
  const Way& way = now_m < margin_m ? later_ : soon_;
  const auto places = std::span{way.places}.first(way.count);
  const bool is_closed_in_on = std::any_of(points.begin(), points.end(), [&](const EdgePoint& p) {
    return is_within(sight_m, p) &&
           std::any_of(places.begin(), places.end(),
                       [&](const Place& place) { return hull_distance_m(place, p) < too_near_m; });
  });
  return is_closed_in_on ? std::optional{now_m} : std::nullopt;
}

bool Guard::is_within(double reach_m, const EdgePoint& point) const noexcept {
  const double dx_m = point.x_m - motion_.x_m;
  const double dy_m = point.y_m - motion_.y_m;
  return dx_m * dx_m + dy_m * dy_m <= reach_m * reach_m;
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
  foresee(asked, is_stopping() ? kLookOn : options_.reaction, soon_);
  foresee(asked, kLookOn, later_);
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
