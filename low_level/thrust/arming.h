// SPDX-License-Identifier: Apache-2.0
// Whether the thrusters may turn, and by whose hand: disarmed, armed, manual, or stopped by
// emergency. From the strongest: the emergency stop, the mission's abort, the stick, the mission.
// Pure; part of the thruster task and so of its thread. It is handed the time.
#pragma once

#include <cstdint>

#include "mid_level/base/time.h"
#include "mid_level/messages/arming.h"

namespace lodesman {

// How long armed thrusters stay so though nobody is there to turn them: a box that was pulled out
// and put back, or a low level that was started anew, goes on; what takes longer has to be armed by
// somebody who looks.
inline constexpr Duration kArmedMemory = std::chrono::seconds{5};
// So much longer where the box is there again and is being tried anew.
inline constexpr Duration kBoxTrial_max = std::chrono::seconds{5};
// An order that was not taken in time is void.
inline constexpr Duration kThrustOrderPatience = std::chrono::seconds{2};

// What there is to see at a step.
struct ArmingView {
  enum class Box : std::uint8_t { kAbsent, kGone, kNotReady, kReady };

  Box box = Box::kAbsent;
  bool high_is_heard = false;
  bool stick_is_at_rest = true;  // or not heard
  bool battery_is_critical = false;
  Time helm_asks{};  // [ns] since when the helm asks for thrust; 0: it does not
  Time stick{};      // [ns] when the stick last spoke; 0: never
  Time aborted{};    // [ns] when the mission was aborted, as long as it stands; 0: it is not
};

class Arming {
 public:
  // `before`: what a low level that was here before has left, at most `age` ago.
  void remember(const ThrustStatus& before, std::uint64_t stops_ordered, Duration age,
                Time now) noexcept;
  // A stop from before the power was off.
  void latch(Time now) noexcept;

  // Once a step, before the orders.
  void look(const ArmingView& view, Time now) noexcept;
  // The newest order last. `sequence`, `given`: of its publication.
  void obey(const ThrustOrder& order, std::uint64_t sequence, Time given, Time now) noexcept;

  [[nodiscard]] const ThrustStatus& status() const noexcept { return status_; }

 private:
  enum class Event : std::uint8_t {
    kArm,
    kDisarm,
    kStop,
    kRelease,
    kStick,
    kToMission,
    kAbort,
    kBoxLost
  };
  struct Row {
    ThrustState from;
    Event event;
    ThrustState to;
  };
  static const Row kTransitions[];

  // False where the state knows no such event.
  bool happen(Event event, ThrustCause cause, Time now) noexcept;
  [[nodiscard]] ThrustAnswer answer_to(ThrustOrderKind order, Time given, Time now) noexcept;
  // To an order given then. A helm that began to ask later does so because of it.
  [[nodiscard]] std::uint32_t objections(Time given) const noexcept;

  ThrustStatus status_;
  ArmingView view_;
  Time box_was_ready_{};  // or it was armed then
};

}  // namespace lodesman
