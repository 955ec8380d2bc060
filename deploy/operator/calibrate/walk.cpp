// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/calibrate/walk.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "mid_level/base/heading.h"

namespace lodesman::cli {
namespace {

constexpr double kTurned_rad = 0.7;      // a push that turns the boat so far turns it
constexpr double kMoved_m = 3.0;         // one that moves it so far moves it
constexpr double kPushMax_s = 20.0;      //
constexpr double kRest_s = 6.0;          // until it lies still
constexpr double kOnCourse_rad = 0.1;    //
constexpr double kTurnMax_s = 60.0;      //
constexpr double kHeadPerRadian = 60.0;  // of the stick: about 1 a degree
constexpr int kHeadMax = 60;             //
constexpr double kLeastRun_s = 4.0;      // that counts, of a run that the room cuts short

}  // namespace

Walk::Walk(WalkOptions options, Steer steer, Say say)
    : options_{std::move(options)}, steer_{std::move(steer)}, say_{std::move(say)} {}

WalkResult Walk::sail() {
  WalkResult result;
  const auto first = steer_({});
  if (!first) {
    end_ = End::kStopped;
  } else {
    start_ = seen_ = *first;
  }
  if (end_ != End::kDone || !find_wiring(result) || !run_pairs(result)) {
    result.fault = result.fault.empty() ? reason() : result.fault;
  }
  if (end_ != End::kStopped) {
    static_cast<void>(steer_({}));
  }
  return result;
}

std::string Walk::reason() const {
  switch (end_) {
    case End::kStopped: return "stopped";
    case End::kTime: return fmt::format("not done within {:.0f} s", options_.time_limit_s);
    case End::kRoom: return fmt::format("{:.0f} m from where it began", from_start_m());
    case End::kDone: break;
  }
  return "too little was seen";
}

bool Walk::step(Stick wished) {
  const auto seen = steer_(through(wiring_, wished));
  if (!seen) {
    end_ = End::kStopped;
    return false;
  }
  seen_ = *seen;
  if (seen_.time_s - start_.time_s > options_.time_limit_s) {
    end_ = End::kTime;
  } else if (from_start_m() > 1.5 * options_.room_m) {
    end_ = End::kRoom;  // it drifts, or does not obey
  }
  return end_ == End::kDone;
}

bool Walk::rest(double for_s) {
  const double until_s = seen_.time_s + for_s;
  while (seen_.time_s < until_s) {
    if (!step({})) {
      return false;
    }
  }
  return true;
}

double Walk::from_start_m() const {
  return std::hypot(seen_.x_m - start_.x_m, seen_.y_m - start_.y_m);
}

std::optional<Answer> Walk::push(Stick stick) {
  const Sighting from = seen_;
  double turned_rad = 0.0;
  while (seen_.time_s < from.time_s + kPushMax_s) {
    const double heading_rad = seen_.heading_rad;
    if (!step(stick)) {
      return std::nullopt;
    }
    turned_rad += wrap_to_pi(seen_.heading_rad - heading_rad);
    if (std::abs(turned_rad) > kTurned_rad) {
      return turned_rad > 0.0 ? Answer::kStarboard : Answer::kPort;
    }
    const double east_m = seen_.x_m - from.x_m;
    const double north_m = seen_.y_m - from.y_m;
    if (std::hypot(east_m, north_m) > kMoved_m) {
      const double ahead_m =
          east_m * std::sin(from.heading_rad) + north_m * std::cos(from.heading_rad);
      return ahead_m > 0.0 ? Answer::kAhead : Answer::kAstern;
    }
  }
  return std::nullopt;
}

bool Walk::find_wiring(WalkResult& result) {
  say_("a push ahead");
  const auto to_ahead = push({options_.push, 0});
  if (!rest(kRest_s)) {
    return false;
  }
  say_("a push to starboard");
  const auto to_starboard = to_ahead ? push({0, options_.push}) : std::nullopt;
  if (end_ != End::kDone || !rest(kRest_s)) {
    return false;
  }
  result.wiring = to_starboard ? wiring_of(*to_ahead, *to_starboard) : std::nullopt;
  if (!result.wiring) {
    result.fault =
        to_ahead && to_starboard
            ? "ahead and to starboard have answers that no wiring has: is it in a strong "
              "current, or does one thruster not turn?"
            : fmt::format("nothing moved or turned within {:.0f} s of a push", kPushMax_s);
    return false;
  }
  say_(described(*result.wiring));
  wiring_ = *result.wiring;
  return true;
}

int Walk::head_to(double heading_rad) const {
  const double wanted = kHeadPerRadian * wrap_to_pi(heading_rad - seen_.heading_rad);
  return std::clamp(static_cast<int>(std::lround(wanted)), -kHeadMax, kHeadMax);
}

bool Walk::turn_to(double heading_rad) {
  const double until_s = seen_.time_s + kTurnMax_s;
  while (std::abs(wrap_to_pi(heading_rad - seen_.heading_rad)) > kOnCourse_rad &&
         seen_.time_s < until_s) {
    if (!step({0, head_to(heading_rad)})) {
      return false;
    }
  }
  return true;
}

std::optional<StraightRun> Walk::run(int surge_ref, double heading_rad) {
  if (!turn_to(heading_rad)) {
    return std::nullopt;
  }
  const Sighting from = seen_;
  StraightRun run;
  double fixed_s = seen_.fixed_s;
  while (seen_.time_s < from.time_s + options_.leg_s) {
    if (!step({surge_ref, head_to(heading_rad)})) {
      return std::nullopt;
    }
    if (seen_.fixed_s > fixed_s && seen_.time_s >= from.time_s + options_.settle_s) {
      run.add(seen_.fixed_s, seen_.x_m, seen_.y_m, seen_.heading_rad);
    }
    fixed_s = seen_.fixed_s;
    const double made_m = std::hypot(seen_.x_m - from.x_m, seen_.y_m - from.y_m);
    if (made_m > options_.room_m && from_start_m() > options_.room_m) {
      break;
    }
  }
  const bool enough = seen_.time_s >= from.time_s + options_.settle_s + kLeastRun_s;
  return enough ? std::optional{run} : std::optional{StraightRun{}};
}

bool Walk::run_pairs(WalkResult& result) {
  const double there_rad = start_.heading_rad;
  std::vector<PairOfRuns> pairs;
  for (const int surge_ref : options_.surge_refs) {
    say_(fmt::format("SurgeRef {}, there and back", surge_ref));
    const auto there = run(surge_ref, there_rad);
    const auto back = there ? run(surge_ref, wrap_to_pi(there_rad + to_rad(180.0))) : std::nullopt;
    if (!back) {
      break;
    }
    if (const auto pair = compare(surge_ref, *there, *back)) {
      say_(fmt::format("SurgeRef {}: {:.3f} m/s, current {:.2f} m/s", surge_ref, pair->speed_m_s,
                       std::hypot(pair->current_x_m_s, pair->current_y_m_s)));
      pairs.push_back(*pair);
    } else {
      say_(fmt::format("SurgeRef {}: too short a run, left out", surge_ref));
    }
  }
  result.calibration = calibration_of(pairs);
  return end_ == End::kDone && !pairs.empty();
}

}  // namespace lodesman::cli
