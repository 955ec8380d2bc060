// SPDX-License-Identifier: Apache-2.0
// Looks on at a boat that sails one mission after the other: what came of each, whether it ever
// stood still without saying why, and what it ran into; and judges what the program held while it
// did. One thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "mid_level/blackboard/blackboard.h"

namespace lodesman::measure {

// What came of one mission.
struct LegOutcome {
  std::string what;  // "reached", or why not
  double to_go_m = 0.0;
  unsigned stops = 0;     // times that no way was made for half a minute, under way ...
  unsigned unsaid = 0;    // ... and of these, without a reason
  unsigned contacts = 0;  // with obstacles, under way
  unsigned contacts_at_rest = 0;
};

// What the program holds at one time.
struct Held {
  double at_s = 0.0;  // [s] of the boat's time
  double resident_kib = 0.0;
  std::ptrdiff_t descriptors = 0;
};

// Of a whole soak. Contacts are none of it: what moves is not foreseen.
struct SoakFigures {
  unsigned unsaid = 0;                 // stops without a reason
  std::uint64_t highest_sequence = 0;  // that any channel has come to
  Held settled;                        // once all have what they keep
  Held last;
};

// What speaks against it, in words; nothing where it holds.
[[nodiscard]] std::vector<std::string> objections(const SoakFigures& figures);

class SoakJudge {
 public:
  explicit SoakJudge(const Blackboard& board);

  void begin_leg(Time now);
  // To be called fifty times a second.
  void look(Time now);
  // `refusal`: of the start, where it never was taken.
  [[nodiscard]] LegOutcome end_leg(double goal_x_m, double goal_y_m, const std::string& refusal);

 private:
  void note_contact(const WorldTruth& truth);
  void note_stop(Time now);
  [[nodiscard]] std::string reason() const;

  Reader<WorldTruth> truth_;
  Reader<MissionStatus> mission_;
  Reader<Plan> plan_;
  Reader<HelmCommand> helm_;
  Reader<ThrustApplied> thrust_;
  LegOutcome leg_;
  WorldTruth at_;
  MissionStatus status_;
  PlanRung rung_ = PlanRung::kNothing;
  HelmReason helm_reason_ = HelmReason::kNotUnderWay;
  ThrustReason thrust_reason_ = ThrustReason::kNoCommand;
  bool touches_ = false;
  std::string said_;  // the last reason there was ...
  Time said_at_{};    // ... and when
  WorldTruth lay_;    // where it last made way from ...
  Time lay_since_{};  // ... and since when
};

}  // namespace lodesman::measure
