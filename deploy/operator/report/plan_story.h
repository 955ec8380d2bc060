// SPDX-License-Identifier: Apache-2.0
// What a run's plans have to tell: one readable line whenever what is done, or about what, changes.
// One thread.
#pragma once

#include <string>

#include "deploy/operator/report/run_record.h"
#include "mid_level/messages/command.h"

namespace lodesman::cli {

// "12.3 s: steers 48 deg, at full speed; on the path obstacle 2, 0.31 m clear in 8 s (plan 0.15 s
// old)": of a manoeuvre, what following the path would have come to.
[[nodiscard]] std::string describe(const PlanRecord& plan);

// "no way made for 15 s: the thruster box takes no commands". for_s: [s] since when none was.
[[nodiscard]] std::string describe(NoWayCause cause, double for_s);

// What became of a mission by nobody's word since `before`; empty: nothing.
[[nodiscard]] std::string mission_news(const MissionStatus& before, const MissionStatus& now);

class PlanStory {
 public:
  // The line for this plan; empty when it does the same about the same as the one before, or when
  // that changed less than a second ago.
  [[nodiscard]] std::string news(const PlanRecord& plan);

 private:
  static constexpr double kSilence_s = 1.0;
  std::string rung_;
  std::uint32_t cause_ = 0;
  double told_s_ = -kSilence_s;
};

}  // namespace lodesman::cli
