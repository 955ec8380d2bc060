// SPDX-License-Identifier: Apache-2.0
// A mission as a file has it: goals, speed, and where it may sail. One thread; throws StartupError
// `file:line: key: reason`.
#pragma once

#include "mid_level/base/geodesy.h"
#include "mid_level/config/toml_document.h"
#include "mid_level/messages/mission.h"

namespace lodesman {

// What a mission has that does not say otherwise: the configuration's section [mission].
struct MissionDefaults {
  double goal_radius_m = 0.5;
  double speed_m_s = 0.0;
  LinkLost link_lost = LinkLost::kGoOn;
  Duration link_lost_after = std::chrono::seconds{5};
  OnRestart on_restart = OnRestart::kHold;
  Blocked blocked = Blocked::kHold;
  Duration blocked_patience = std::chrono::seconds{60};
};
[[nodiscard]] MissionDefaults read_mission_defaults(const TomlTable& table);

// The keys of a mission in `table`, where other keys may stand too. Latitude and longitude are
// taken into the world by `frame`; without one they are looked at, and placed nowhere: the boat
// alone knows its origin. The mission's id is left 0.
[[nodiscard]] MissionDefinition read_mission(const TomlTable& table,
                                             const MissionDefaults& defaults,
                                             const LocalFrame* frame);

// The text of a mission file; `name` stands for the file in messages.
[[nodiscard]] MissionDefinition read_mission_text(std::string_view text, const std::string& name,
                                                  const MissionDefaults& defaults,
                                                  const LocalFrame* frame);

}  // namespace lodesman
