// SPDX-License-Identifier: Apache-2.0
#include "high_level/guidance/foresight.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace lodesman {
namespace {

using Vec = Eigen::Vector2d;

// How far it looks ahead, and how finely.
constexpr double kHorizon_m = 20.0;
constexpr double kHorizonMin_s = 25.0;
constexpr double kHorizonMax_s = 90.0;
constexpr double kStep_m = 0.25;  // of the fastest approach
constexpr int kSteps_max = 240;

constexpr double kStraight = 0.01;   // slower [m/s] sideways and [rad/s] in turning is straight on
constexpr double kWayPoint_m = 0.5;  // between points of the way that is shown
constexpr double kTouch_m = 0.05;    // what is foreseen is no better known than this
constexpr double kDeeper_m = 0.02;  // where it overlaps something already, nearer than this touches

// Costs, as seconds of delay.
constexpr double kNoLimit_s = std::numeric_limits<double>::infinity();
constexpr double kCore_s = 2000.0;      // a metre nearer than the core
constexpr double kCloseness_s = 15.0;   // a second at no clearance at all
constexpr double kFading_s = 40.0;      // what is far ahead may turn out otherwise
constexpr double kAhead_s = 6.0;        // a second close ahead of something that moves
constexpr double kBlind_s = 10.0;       // a metre astern, where no sonar looks
constexpr double kToPort_s = 0.5;       // to starboard where nothing else decides
constexpr double kRunsDown_m_s = 0.05;  // slower runs nobody down
constexpr double kBelieved = 0.2;       // what touches with less probability only costs
constexpr double kGentlest_m_s = 0.05;  // the least harm of a touch ...
constexpr double kRespite_s = 8.0;      // ... which may be averted yet, if there is time
constexpr double kDeep_m = 0.5;         // a touch that would go so deep is met in full
constexpr int kDepthSteps = 40;         // are looked at, from the touch on
constexpr double kGraze = 0.02;         // of the harm of that, what may yet miss

// One manoeuvre on its way through the future: where the vehicle is, and what it has cost.
struct Voyage {
  Rollout sailed;
  double cost_s = 0.0;      // beside the time
  std::size_t touched = 0;  // of the hazards touched the one with the most harm ...
  double worst = 0.0;       // ... and that
  // Of each hazard: the nearest yet below the core, and what is touched. What it overlaps already,
  // it may leave.
  std::array<double, 2 * kMaxObstacles> least_m{};
  std::array<double, 2 * kMaxObstacles> touch_m{};
  Foresight seen{};
};

[[nodiscard]] HullDiscs hull_of(const Outlook& outlook) noexcept {
  return HullDiscs::of(outlook.response->hull_half_length_m, outlook.response->hull_half_beam_m);
}

[[nodiscard]] Voyage set_out(const Outlook& outlook, const Manoeuvre& manoeuvre) noexcept {
  Voyage voyage{.sailed = {*outlook.response, *outlook.route, outlook.own, manoeuvre,
                           outlook.speed_share_max, outlook.stay_at_end}};
  voyage.cost_s = manoeuvre.offset_rad < 0.0 ? kToPort_s : 0.0;
  voyage.seen.least_clearance_m = std::numeric_limits<double>::infinity();
  const HullDiscs hull = hull_of(outlook);
  for (std::size_t i = 0; i < outlook.hazards.count; ++i) {
    const Hazard& hazard = outlook.hazards.list[i];
    const double core_m = outlook.options->core_m;
    const double off_m = clearance_m(hazard, hazard.age_s, voyage.sailed.motion(), hull, core_m);
    voyage.least_m[i] = std::min(core_m, off_m);
    const double touch_m = hazard.velocity_m_s.norm() > kRunsDown_m_s ? kTouch_m : 0.0;
    voyage.touch_m[i] = std::min(touch_m, off_m - kDeeper_m);
  }
  return voyage;
}

// One step of the vehicle: in parts while it turns or slips.
void sail_on(const Outlook& outlook, Voyage& voyage) noexcept {
  Rollout& sailed = voyage.sailed;
  const BodyVelocity& velocity = sailed.motion().velocity;
  const bool straight = std::max(std::abs(velocity[1]), std::abs(velocity[2])) < kStraight;
  // A place that it keeps it may go back to stern first.
  const bool keeps_place =
      outlook.stay_at_end && !sailed.is_aside() &&
      (outlook.route->end() - sailed.p_W()).norm() < outlook.response->look_ahead_m;
  const int parts = straight ? 1 : outlook.parts;
  const double part_s = outlook.step_s / parts;
  for (int i = 0; i < parts; ++i) {
    sailed.sail(part_s);
    voyage.cost_s += keeps_place ? 0.0 : kBlind_s * std::max(0.0, -velocity[0]) * part_s;
  }
}

[[nodiscard]] Vec over_ground(const Outlook& outlook, const VehicleMotion& motion) noexcept {
  return velocity_over_ground(motion.heading_rad, motion.velocity, outlook.own.current_m_s);
}

// What one obstacle costs where the vehicle is now, wherever it is by then.
void meet(const Outlook& outlook, std::size_t which, Voyage& voyage) noexcept {
  const Hazard& hazard = outlook.hazards.list[which];
  double& least_m = voyage.least_m[which];
  const ManoeuvreOptions& options = *outlook.options;
  const VehicleMotion& motion = voyage.sailed.motion();
  const double fading = hazard.probability * std::exp(-voyage.sailed.after_s() / kFading_s);
  const double after_s = voyage.sailed.after_s() + hazard.age_s;
  const double doubt_m =
      std::min(options.doubt_max_m,
               options.doubt_sigmas * (hazard.place_sigma_m + hazard.velocity_sigma_m_s * after_s));
  const double wanted_m = options.clearance_m + doubt_m;
  const double off_m = clearance_m(hazard, after_s, motion, hull_of(outlook), wanted_m);
  if (off_m < voyage.seen.least_clearance_m) {
    voyage.seen.least_clearance_m = off_m;
    voyage.seen.least_after_s = voyage.sailed.after_s();
    voyage.seen.least_track = hazard.track->id;
  }
  if (off_m < wanted_m) {
    const double lack = (wanted_m - off_m) / wanted_m;
    voyage.cost_s += kCloseness_s * lack * lack * fading * outlook.step_s;
  }
  if (off_m < voyage.touch_m[which] && hazard.probability > kBelieved) {
    const double closing_m_s = (over_ground(outlook, motion) - hazard.velocity_m_s).norm();
    const double harm = hazard.probability * (kGentlest_m_s + closing_m_s) *
                        std::exp(-voyage.sailed.after_s() / kRespite_s);
    voyage.touched = harm > voyage.worst ? which : voyage.touched;
    voyage.worst = std::max(voyage.worst, harm);
    voyage.seen.touches = true;
    voyage.seen.harm += harm;
  }
  if (off_m < least_m) {
    voyage.cost_s += kCore_s * (least_m - off_m) * fading;
    least_m = off_m;
    voyage.seen.is_run_down |=
        hazard.velocity_m_s.norm() > kRunsDown_m_s && hazard.probability > kBelieved;
  }
  voyage.cost_s += kAhead_s * closeness_ahead(hazard, after_s, motion) * fading * outlook.step_s;
}

// How deep a touch would go, did nothing give way: where it only grazes it may yet miss.
void judge_depth(const Outlook& outlook, Voyage& voyage) noexcept {
  const Hazard& hazard = outlook.hazards.list[voyage.touched];
  const HullDiscs hull = hull_of(outlook);
  double off_m = std::numeric_limits<double>::infinity();
  double depth_m = 0.0;
  Rollout on = voyage.sailed;
  for (int step = 0; step < kDepthSteps; ++step) {
    const double last_m = off_m;
    off_m = clearance_m(hazard, on.after_s() + hazard.age_s, on.motion(), hull, 0.0);
    depth_m = std::max(depth_m, voyage.touch_m[voyage.touched] - off_m);
    if (!(off_m < last_m) || depth_m >= kDeep_m || on.has_arrived()) {
      break;
    }
    on.sail(std::min(outlook.step_s, Rollout::kPartMax_s));
  }
  voyage.seen.harm *= kGraze + (1.0 - kGraze) * std::min(1.0, depth_m / kDeep_m);
}

// Until the horizon, or until `ends` says so; false: given up.
template <class Ends>
bool sail_until(const Outlook& outlook, double limit_s, Voyage& voyage, Ends ends) noexcept {
  const double fastest_m_s = outlook.response->cruise.speed_m_s + outlook.own.current_m_s.norm();
  while (voyage.sailed.after_s() < outlook.horizon_s && !ends(voyage)) {
    sail_on(outlook, voyage);
    if (voyage.sailed.has_arrived()) {
      return true;
    }
    for (std::size_t i = 0; i < outlook.hazards.count; ++i) {
      meet(outlook, i, voyage);
    }
    if (voyage.seen.touches) {
      judge_depth(outlook, voyage);
      return true;
    }
    const double least_left_m = (outlook.route->end() - voyage.sailed.p_W()).norm();
    if (voyage.cost_s + voyage.sailed.after_s() + least_left_m / fastest_m_s > limit_s) {
      return false;
    }
  }
  return true;
}

[[nodiscard]] bool is_over(const Voyage& voyage) noexcept {
  return voyage.seen.touches || voyage.sailed.has_arrived();
}

[[nodiscard]] Foresight given_up(Voyage& voyage) noexcept {
  voyage.seen.cost_s = kNoLimit_s;
  return voyage.seen;
}

// What is left of the way is sailed as if nothing were there.
[[nodiscard]] Foresight judged(const Outlook& outlook, const Voyage& voyage) noexcept {
  Foresight seen = voyage.seen;
  const double cruise_m_s = outlook.response->cruise.speed_m_s;
  const Vec back = point_at(*outlook.route, voyage.sailed.place());
  const double left_m = voyage.sailed.has_arrived()
                            ? 0.0
                            : (back - voyage.sailed.p_W()).norm() +
                                  remaining_m(*outlook.route, voyage.sailed.place());
  seen.circles = !voyage.sailed.has_arrived() && !outlook.stay_at_end && !seen.touches &&
                 2.0 * outlook.route->length_m() < voyage.sailed.after_s() * cruise_m_s;
  seen.delay_s = voyage.cost_s;
  seen.cost_s = voyage.cost_s + voyage.sailed.after_s() + left_m / cruise_m_s;
  return seen;
}

}  // namespace

bool is_better(const Foresight& a, const Foresight& b) noexcept {
  if (a.touches != b.touches) {
    return b.touches;
  }
  return a.touches ? a.harm < b.harm : a.cost_s < b.cost_s;
}

void look_as_far_as_needed(Outlook& outlook) noexcept {
  const double cruise_m_s = outlook.response->cruise.speed_m_s;
  outlook.horizon_s = std::clamp(kHorizon_m / cruise_m_s, kHorizonMin_s, kHorizonMax_s);
  outlook.step_s = std::max(kStep_m / (cruise_m_s + outlook.hazards.fastest_m_s),
                            outlook.horizon_s / kSteps_max);
  outlook.parts = static_cast<int>(std::ceil(outlook.step_s / Rollout::kPartMax_s));
}

Foresight foresee(const Outlook& outlook, const Manoeuvre& manoeuvre,
                  const Foresight* to_beat) noexcept {
  const double limit_s = to_beat != nullptr && !to_beat->touches ? to_beat->cost_s : kNoLimit_s;
  Voyage voyage = set_out(outlook, manoeuvre);
  if (!sail_until(outlook, limit_s, voyage, [](const Voyage& v) { return !v.sailed.is_aside(); })) {
    return given_up(voyage);
  }
  if (is_over(voyage)) {
    return judged(outlook, voyage);
  }
  const auto never = [](const Voyage&) { return false; };
  Voyage stopping = voyage;
  // What is given up for its cost may be worth it with a stop where it would have come near.
  const bool counts = sail_until(outlook, limit_s, voyage, never);
  const Foresight back = counts ? judged(outlook, voyage) : given_up(voyage);
  if ((counts && !back.touches) || manoeuvre.for_s <= 0.0) {
    return back;
  }
  stopping.sailed.stop();
  stopping.seen.stops = true;
  if (!sail_until(outlook, limit_s, stopping, never)) {
    return back;
  }
  const Foresight stopped = judged(outlook, stopping);
  return is_better(stopped, back) ? stopped : back;
}

void show_way(const Outlook& outlook, const Manoeuvre& manoeuvre, const Foresight& foreseen,
              Route& way) noexcept {
  way.clear();
  Voyage voyage = set_out(outlook, manoeuvre);
  (void)way.add(voyage.sailed.p_W());
  double since_m = 0.0;
  while (voyage.sailed.after_s() < outlook.horizon_s && !voyage.sailed.has_arrived()) {
    if (!voyage.sailed.is_aside()) {
      if (!foreseen.stops) {
        break;
      }
      voyage.sailed.stop();
    }
    sail_on(outlook, voyage);
    since_m += std::abs(voyage.sailed.motion().velocity[0]) * outlook.step_s;
    if (since_m >= kWayPoint_m) {
      since_m = 0.0;
      (void)way.add(voyage.sailed.p_W());
    }
  }
  if (foreseen.stops) {
    return;
  }
  const RoutePlace back =
      nearest_place(*outlook.route, way.end(), {}, std::numeric_limits<double>::infinity());
  for (std::uint32_t leg = back.leg; leg + 1 < outlook.route->count; ++leg) {
    (void)way.add(outlook.route->points[leg + 1]);
  }
}

}  // namespace lodesman
