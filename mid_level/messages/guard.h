// SPDX-License-Identifier: Apache-2.0
// What the guard of the thruster task does: the last resort below all that plans. Plain data for
// the blackboard; any thread.
#pragma once

#include <cstdint>

#include "mid_level/base/time.h"
#include "mid_level/messages/fields.h"

namespace lodesman {

enum class GuardState : std::uint8_t {
  kOff,         // by configuration
  kOverridden,  // by the word of a stick
  kIdle,        // nothing may turn in any case: not armed, or the mission is aborted
  kBlind,       // no sonar frame that is new enough: nothing is known, nothing is cut
  kWatching,    // thrust is as it is asked for
  kBraking,     // thrust against the way that is made, until it is none
  kHolding,     // stopped: neutral as long as what is asked for would close in
};
[[nodiscard]] constexpr auto enumerators(GuardState) noexcept {
  return enumerators_to<GuardState::kHolding>("off", "overridden", "idle", "blind", "watching",
                                              "braking", "holding");
}

// What it tripped for.
enum class GuardReason : std::uint8_t {
  kNone,
  kObstacle,  // something lies in the way, no farther off than it takes to stop
  kSilence,   // nobody steered for too long, or knew how to, and there was way on the boat
};
[[nodiscard]] constexpr auto enumerators(GuardReason) noexcept {
  return enumerators_to<GuardReason::kSilence>("none", "obstacle", "silence");
}

// Written by the thruster task at every step; read by the command socket and displays.
struct GuardStatus {
  GuardState state = GuardState::kOff;
  GuardReason reason = GuardReason::kNone;  // of the last trip
  Time since{};                             // [ns] when it came into that state
  Time tripped{};                           // [ns] the last trip; 0: never
  std::uint64_t trips = 0;                  // [-] so far
  double distance_m = 0.0;      // [m] of the last trip: from the hull to what lay in the way
  double trip_speed_m_s = 0.0;  // [m/s] of the last trip: ahead through the water
  double speed_m_s = 0.0;       // [m/s] now, as thrust and hull have it

  static constexpr auto fields() noexcept {
    using G = GuardStatus;
    return field_list(field("state", &G::state), field("reason", &G::reason),
                      field("since", &G::since), field("tripped", &G::tripped),
                      field("trips", &G::trips), field("distance_m", &G::distance_m),
                      field("trip_speed_m_s", &G::trip_speed_m_s).within(-100.0, 100.0),
                      field("speed_m_s", &G::speed_m_s).within(-100.0, 100.0));
  }
};

}  // namespace lodesman
