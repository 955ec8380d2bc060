// SPDX-License-Identifier: Apache-2.0
// What becomes of a mission whose program died under way, once another is there: sailed on with,
// held, or over. Pure; any thread.
#pragma once

#include "mid_level/base/time.h"
#include "mid_level/messages/command.h"
#include "mid_level/messages/mission.h"

namespace lodesman {

// After a longer absence nothing sails by itself, whatever its mission says: whoever stood by has
// long given it up.
inline constexpr Duration kLongestAbsence = std::chrono::seconds{5};

// What is found of the program that was here before.
struct Legacy {
  MissionStatus said{};            // its last word ...
  Duration silence{};              // ... so long ago
  OnRestart policy{};              // of that mission
  bool mission_is_known = false;   // its definition is still there
  bool order_unanswered = false;   // somebody had ordered something else than an abort
  bool thrusters_are_off = false;  // disarmed or stopped by emergency
};

struct Succession {
  MissionState state = MissionState::kIdle;
  MissionCause cause = MissionCause::kOrder;
};
[[nodiscard]] Succession succession_of(const Legacy& legacy) noexcept;

}  // namespace lodesman
