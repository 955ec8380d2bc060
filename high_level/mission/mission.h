// SPDX-License-Identifier: Apache-2.0
// The mission: goals in order, and the states that an operator's word and the vehicle's progress
// lead through. One thread.
#pragma once

#include <chrono>
#include <cstdint>
#include <limits>
#include <optional>

#include "high_level/mission/succession.h"
#include "mid_level/base/frames.h"
#include "mid_level/base/speed_table.h"
#include "mid_level/base/time.h"
#include "mid_level/messages/command.h"
#include "mid_level/messages/mission.h"

namespace lodesman {

// An order other than an abort that nobody took up for so long is void, and whoever gave it has
// been told that it is not confirmed.
inline constexpr Duration kOrderPatience = std::chrono::seconds{2};

// What an order comes to in a state: the answer, and the state after it.
struct Ruling {
  OrderAnswer answer = OrderAnswer::kNone;
  MissionState state = MissionState::kIdle;
};
[[nodiscard]] Ruling ruling_on(OperatorOrder order, MissionState state) noexcept;

struct MissionOptions {
  double waypoint_radius_m = 0.0;  // [m] a waypoint counts as visited within this
  SpeedTable speeds = SpeedTable::proportional(0.01);  // of the boat: which SurgeRef holds a speed
};

// What the newest plan says of the goal that is made for.
enum class GoalOutlook : std::uint8_t {
  kOpen,     // there is a way, or nothing is known yet
  kBlocked,  // there is none, and it is on its way to where it can wait
  kAwaited,  // there is none, and it waits there
};

// An order as it was published.
struct GivenOrder {
  OperatorCommand command;
  std::uint64_t sequence = 0;  // from 1 on
  Time given{};                // stamped
};

class Mission {
 public:
  explicit Mission(const MissionOptions& options);

  // What the next start is a start of, unless that names another.
  void set_at_hand(const MissionDefinition& definition) noexcept { at_hand_ = definition; }

  // start: from the first goal on, unless under way on that same mission; under way on another one
  // it takes that one's place. abort: latched until the next start. hold: stays at `position`, the
  // vehicle's own, if under way; resume: goes on from there.
  //
  // An abort is obeyed by its count too, should the order itself be lost. Of the orders taken at
  // one `now` it wins, wherever it stands among them: what stands beside it is refused. A start is
  // obeyed again at a later `now`, if it was ordered after the last abort was.
  void take(const GivenOrder& given, const WorldPoint& position, Time now) noexcept;
  // After a restart: `before` is the last word of the program that was here before, `aborts` what
  // was ordered of it. An abort stands until a new start, obeyed before or not. Gives whether it
  // does.
  bool inherit(const MissionStatus& before, std::uint64_t aborts) noexcept;
  // Where none does: goes on with that mission at the goal it was making for. Holding it holds the
  // place that was held.
  void take_up(const MissionStatus& before, const MissionDefinition& definition,
               const Succession& succession, Time now) noexcept;
  // Stays at `position`, the vehicle's own, until it is told otherwise.
  void hold(const WorldPoint& position, MissionCause cause) noexcept;
  // What the mission says of a link that was open and has been silent for its time; once.
  void watch_link(const CommandLink& link, const WorldPoint& position, Time now) noexcept;
  // Whether the newest plan finds no way to the goal, and waits as near to it as there is room. A
  // waypoint is waited for as long as the mission says, and is then left out or held at; the last
  // goal is waited for until somebody says otherwise.
  void watch_blocked(GoalOutlook outlook, const WorldPoint& position, Time now) noexcept;
  // The thrusters were disarmed, and by nobody's word: as where that is ordered, it is aborted,
  // under way or held. What is sailed without thrust must not go on once there is thrust again, and
  // as long as it asks for thrust nobody can arm.
  void end_disarmed(Time now) noexcept;
  // No mission is sailed faster than this from here on.
  void limit_speed(double speed_m_s) noexcept;
  // Progress by the estimated position, which the mission itself takes for true.
  void advance(const WorldPoint& position, Time now) noexcept;

  [[nodiscard]] const MissionStatus& status() const noexcept { return status_; }
  // The mission that is sailed, or was last.
  [[nodiscard]] const MissionDefinition& definition() const noexcept { return definition_; }
  // Where it set out from.
  [[nodiscard]] WorldPoint home() const noexcept { return {{status_.home_x_m, status_.home_y_m}}; }
  // What is made for now; while holding the place held.
  [[nodiscard]] WorldPoint goal() const noexcept { return {{status_.goal_x_m, status_.goal_y_m}}; }
  // Where the line begins that is kept to on the way to the goal; nothing where any way will do.
  [[nodiscard]] std::optional<WorldPoint> line_begin() const noexcept;
  [[nodiscard]] bool under_way() const noexcept { return status_.state == MissionState::kUnderWay; }
  [[nodiscard]] bool holding() const noexcept { return status_.state == MissionState::kHolding; }

 private:
  void abort(std::uint64_t count, MissionCause cause) noexcept;
  // From the first goal on, whatever it was doing.
  void start(const MissionDefinition& definition, const WorldPoint& position, Time now) noexcept;
  void go_back(const WorldPoint& position, Time now) noexcept;
  void hold_speed() noexcept;
  [[nodiscard]] OrderAnswer obey(const GivenOrder& given, const WorldPoint& position,
                                 Time now) noexcept;
  void make_for(std::uint32_t index) noexcept;
  [[nodiscard]] bool is_last_goal() const noexcept;

  MissionOptions options_;
  double speed_limit_m_s_ = std::numeric_limits<double>::infinity();
  MissionDefinition at_hand_;
  MissionDefinition definition_;
  MissionStatus status_;
  std::optional<Time> aborted_;     // when an order last did
  std::uint64_t link_lost_of_ = 0;  // the session whose loss has been acted on
};

}  // namespace lodesman
