// SPDX-License-Identifier: Apache-2.0
// The mission: goals in order, and the states that an operator's word and the vehicle's progress
// lead through. One thread.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

#include "mid_level/base/frames.h"
#include "mid_level/base/time.h"
#include "mid_level/messages/command.h"

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
  std::vector<WorldPoint> goals;   // waypoints in order, the goal last; at least one
  double waypoint_radius_m = 0.0;  // [m] a waypoint counts as visited within this
  double goal_radius_m = 0.0;      // [m] the goal counts as reached within this
};

// An order as it was published.
struct GivenOrder {
  OperatorCommand command;
  std::uint64_t sequence = 0;  // from 1 on
  Time given{};                // stamped
};

class Mission {
 public:
  explicit Mission(MissionOptions options);

  // start: from the first goal on, unless under way. abort: latched until the next start. hold:
  // stays at `position`, the vehicle's own, if under way; resume: goes on from there.
  //
  // An abort is obeyed by its count too, should the order itself be lost. Of the orders taken at
  // one `now` it wins, wherever it stands among them: what stands beside it is refused. A start is
  // obeyed again at a later `now`, if it was ordered after the last abort was.
  void take(const GivenOrder& given, const WorldPoint& position, Time now) noexcept;
  // After a restart: `before` is the last word of the program that was here before, `aborts` what
  // was ordered of it. An abort stands until a new start, obeyed before or not. Gives whether it
  // does.
  bool inherit(const MissionStatus& before, std::uint64_t aborts) noexcept;
  // From the first goal on, whatever it was doing.
  void start(Time now) noexcept;
  // Stays at `position`, the vehicle's own, until it is told otherwise.
  void hold(const WorldPoint& position) noexcept;
  // Progress by the estimated position, which the mission itself takes for true.
  void advance(const WorldPoint& position, Time now) noexcept;

  [[nodiscard]] const MissionStatus& status() const noexcept { return status_; }
  // What is made for now; while holding the place held.
  [[nodiscard]] WorldPoint goal() const noexcept { return {{status_.goal_x_m, status_.goal_y_m}}; }
  [[nodiscard]] bool under_way() const noexcept { return status_.state == MissionState::kUnderWay; }
  [[nodiscard]] bool holding() const noexcept { return status_.state == MissionState::kHolding; }

 private:
  void abort(std::uint64_t count) noexcept;
  [[nodiscard]] OrderAnswer obey(const GivenOrder& given, const WorldPoint& position,
                                 Time now) noexcept;
  void make_for(std::uint32_t index) noexcept;

  MissionOptions options_;
  MissionStatus status_;
  std::optional<Time> aborted_;  // when an order last did
};

}  // namespace lodesman
