// SPDX-License-Identifier: Apache-2.0
#include "deploy/boat/failsafes.h"

#include <fmt/format.h>

#include "drivers/maestro/maestro.h"
#include "low_level/thrust/arming.h"
#include "low_level/thrust/battery.h"
#include "mid_level/base/short_number.h"
#include "mid_level/blackboard/blackboard.h"

namespace lodesman {
namespace {

constexpr Duration kShippedFixGap = std::chrono::seconds{15};  // a test compares it

}  // namespace

std::vector<Failsafe> failsafes() {
  const Duration trial = kArmedMemory + kBoxTrial_max;
  return {
      {"heading (`attitude`)", max_age::kAttitude,
       "the helm is neutral, 0.3 s later the guard takes the way off by thrust, and no estimate is "
       "made; it goes on when the heading is back",
       "helm `stale_attitude`, `no_way` `no_heading`, device `heading`; guard `silence`"},
      {"estimate (`vehicle_state`)", max_age::kVehicleState,
       "the helm is neutral, 0.3 s later the guard takes the way off, nothing is planned",
       "helm `stale_state`, `no_way` `no_position`; guard `silence`"},
      {"believed fix, where fixes are the source (`estimator.fix_gap_max_s`)", kShippedFixGap,
       "no estimate is made, and so the helm is neutral; before that the model bridges the gap",
       "`position_trust`, device `position`"},
      {"sonar frame (`sonar_obstacles`, `tracks`)", max_age::kSonarFrame,
       "it keeps its place, and makes way by what it remembers; it has been slower since a frame "
       "was missed. In profile `paper` nothing new is planned",
       "plan reason `no_frame` and rung, `no_way` `no_sonar`, device `sonar`"},
      {"sonar frame, for the guard", max_age::kSonarFrame,
       "it is blind and cuts nothing; what it has stopped for stays known",
       "guard `blind`, log of lodesman-low"},
      {"mission (`mission_status`)", max_age::kMissionStatus,
       "the helm is neutral, 0.3 s later the guard takes the way off",
       "helm `stale_mission`; guard `silence`"},
      {"high level (`helm_command`)", max_age::kHelmCommand,
       "thrust is neutral; 0.3 s later the guard takes the way off by thrust astern, until stopped",
       "thrust `stale_command`, then `guarded`; guard `silence`"},
      {"stick (`manual_input`), while manual", max_age::kManualInput,
       "thrust is neutral until another word of it, a start or a resume", "thrust `stick_silent`"},
      {"low level (`thrust_applied`)", max_age::kThrustApplied,
       "no start is taken; the estimate goes on with no thrust",
       "`not_ready`, log of lodesman-high"},
      {"commands, as the thruster box sees it", MaestroOptions{}.time_out,
       "the box stops both thrusters by itself (its own setting, which is proved)",
       "device `thrusters`, once it speaks again"},
      {"thruster box, gone", kArmedMemory, "the thrusters are disarmed, and the mission is aborted",
       "thrust `disarmed` by `box_lost`, device `thrusters`; mission `aborted` by `disarmed`"},
      {"thruster box, there and not ready", trial, "the same", "the same"},
      {"lodesman-low, before it is started again", kArmedMemory,
       "it comes back disarmed, and the mission is aborted; before that as it was, with neutral "
       "first",
       "log of lodesman-low; mission `aborted` by `disarmed`"},
      {"battery volts", BatteryMonitor::kSilence_max, "its level is unknown; nothing else",
       "`battery` in `status`"},
  };
}

std::vector<std::string> failsafe_rows() {
  std::vector<std::string> rows{"| what is missing | for | then | who says so |",
                                "|---|---|---|---|"};
  for (const Failsafe& failsafe : failsafes()) {
    rows.push_back(fmt::format("| {} | {} s | {} | {} |", failsafe.what,
                               short_number(to_seconds(failsafe.after)), failsafe.happens,
                               failsafe.told));
  }
  return rows;
}

}  // namespace lodesman
