// SPDX-License-Identifier: Apache-2.0
#include "high_level/guidance/manoeuvre.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lodesman {
namespace {

// The manoeuvres: the route at less speed; and courses off it, each held for a length of way, at a
// speed.
constexpr std::array kRouteShares{0.6, 0.35};
constexpr std::array kOffsets_deg{15.0,  -15.0, 30.0,  -30.0, 45.0,   -45.0, 65.0,
                                  -65.0, 90.0,  -90.0, 130.0, -130.0, 180.0};
constexpr std::array kLengths_m{2.0, 5.0, 12.0};
constexpr std::array kSpeedShares{1.0, 0.5};
constexpr std::array kStraightShares{1.0, 0.6, 0.3, 0.0, -0.4};
constexpr std::array kFlightLengths_m{2.0, 5.0, 12.0, 24.0};
constexpr double kKeptHarmShare = 0.8;  // of a touch, for the manoeuvre under way
constexpr double kFullRef = 100.0;      // the most that SurgeRef can be

[[nodiscard]] bool is_flight(const Manoeuvre& manoeuvre) noexcept {
  return manoeuvre.speed_share > 1.0 || manoeuvre.speed_share < kStraightShares.back();
}

}  // namespace

void ManoeuvreChooser::set(const VehicleResponse& response,
                           const ManoeuvreOptions& options) noexcept {
  response_ = response;
  options_ = options;
  // What the vessel can do, up to what is stated; never less than the mission asks for.
  const Cruise& cruise = response.cruise;
  const double stated = options.flight_speed_m_s / cruise.speed_m_s;
  const double can = cruise.surge_ref > 0 ? kFullRef / cruise.surge_ref : 1.0;
  response_.most_share = std::max(1.0, std::min(stated, can));
}

const ManoeuvreChooser::Choice& ManoeuvreChooser::choose(Time now, const OwnMotion& own,
                                                         const Route& route, const Tracks& tracks,
                                                         double speed_share_max,
                                                         bool stay_at_end) noexcept {
  outlook_.response = &response_;
  outlook_.options = &options_;
  outlook_.route = &route;
  outlook_.own = own;
  outlook_.speed_share_max = speed_share_max;
  outlook_.stay_at_end = stay_at_end;
  foresee_hazards(now, tracks, own.place_sigma_m, outlook_.hazards);
  look_as_far_as_needed(outlook_);
  choice_.manoeuvre = {0.0, 0.0, speed_share_max};
  choice_.of_route = foresee(outlook_, choice_.manoeuvre);
  choice_.foresight = choice_.of_route;
  // With nothing in the way no other manoeuvre is there sooner, but where it cannot turn to it.
  if (choice_.of_route.touches || choice_.of_route.delay_s > 0.0 || choice_.of_route.circles) {
    consider_all();
    if (choice_.foresight.touches || choice_.foresight.is_run_down) {
      consider_flight();
    }
    stay_with_last();
  }
  choice_.changed = !(choice_.manoeuvre == kept_);
  kept_ = choice_.manoeuvre;
  show_way(outlook_, choice_.manoeuvre, choice_.foresight, choice_.way);
  return choice_;
}

double ManoeuvreChooser::for_s(double length_m) const noexcept {
  return length_m / response_.cruise.speed_m_s;
}

void ManoeuvreChooser::consider_all() noexcept {
  const double most = outlook_.speed_share_max;
  for (const double share : kRouteShares) {
    consider({0.0, 0.0, std::min(share, most)});
  }
  for (const double share : kStraightShares) {
    for (const double length_m : kLengths_m) {
      consider({0.0, for_s(length_m), std::min(share, most)});
    }
  }
  for (const double offset_deg : kOffsets_deg) {
    for (const double length_m : kLengths_m) {
      for (const double share : kSpeedShares) {
        consider({to_rad(offset_deg), for_s(length_m), std::min(share, most)});
      }
    }
  }
}

// What the vessel can do, ahead or astern, whatever speed the mission has.
void ManoeuvreChooser::consider_flight() noexcept {
  const double share = response_.most_share;
  const bool flees = options_.flight_speed_m_s > 0.0;
  for (const double length_m : kFlightLengths_m) {
    const double flight_s = for_s(length_m) / share;
    consider({0.0, flight_s, -share});  // which is braking first of all
    if (!flees) {
      continue;
    }
    consider({0.0, flight_s, share});
    for (const double offset_deg : kOffsets_deg) {
      consider({to_rad(offset_deg), flight_s, share});
      consider({to_rad(offset_deg), flight_s, -share});
    }
  }
}

// The manoeuvre under way is left only for one that is better by the stated gain; a flight as soon
// as anything calmer keeps clear.
void ManoeuvreChooser::stay_with_last() noexcept {
  Manoeuvre kept = kept_;
  if (!is_flight(kept)) {
    kept.speed_share = std::min(kept.speed_share, outlook_.speed_share_max);
  } else if (!is_flight(choice_.manoeuvre) && !choice_.foresight.touches &&
             !choice_.foresight.is_run_down) {
    return;
  }
  const Foresight of_kept = foresee(outlook_, kept);
  Foresight favoured = of_kept;
  favoured.cost_s -= options_.switch_gain_s;
  favoured.harm *= kKeptHarmShare;
  if (!is_better(choice_.foresight, favoured)) {
    choice_.manoeuvre = kept;
    choice_.foresight = of_kept;
  }
}

void ManoeuvreChooser::consider(const Manoeuvre& manoeuvre) noexcept {
  const Foresight foresight = foresee(outlook_, manoeuvre, &choice_.foresight);
  if (is_better(foresight, choice_.foresight)) {
    choice_.foresight = foresight;
    choice_.manoeuvre = manoeuvre;
  }
}

}  // namespace lodesman
