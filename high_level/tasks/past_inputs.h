// SPDX-License-Identifier: Apache-2.0
// What was applied and measured in a time that nobody stepped through, because the program was
// frozen or another one was here: as far as the blackboard still has it, in order. Owned by one
// thread; allocates when made and never after.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "mid_level/blackboard/blackboard.h"

namespace lodesman {

class PastInputs {
 public:
  explicit PastInputs(const Blackboard& board)
      : thrust_{board.thrust_applied}, attitude_{board.attitude} {}

  // Its readers.
  [[nodiscard]] ChannelLook<>& thrust_input() noexcept { return thrust_; }
  [[nodiscard]] ChannelLook<>& attitude_input() noexcept { return attitude_; }

  struct Moment {
    Time at{};
    ThrustApplied applied{};  // up to then; neutral where nothing tells
    bool thrust_is_known = false;
    const Attitude* attitude = nullptr;  // the newest measured by then; nullptr: none is known
  };
  // At most so far apart.
  static constexpr Duration kStep = std::chrono::milliseconds{100};

  // Calls visit(moment) for moments between `from` and `to`, neither included, in order.
  template <class Visit>
  void replay(Time from, Time to, Visit visit) noexcept {
    collect();
    std::size_t thrust = 0;
    std::size_t attitude = 0;
    for (Time at = from; at < to;) {
      while (thrust < thrusts_ && applied_[thrust].stamp <= at) {
        ++thrust;
      }
      while (attitude < attitudes_ && measured_[attitude].measured <= at) {
        ++attitude;
      }
      Time next = std::min(at + kStep, to);
      next = thrust < thrusts_ ? std::min(next, applied_[thrust].stamp) : next;
      next = attitude < attitudes_ ? std::min(next, measured_[attitude].measured) : next;
      if (next >= to) {
        return;
      }
      Moment moment;
      moment.at = next;
      moment.thrust_is_known =
          thrust > 0 && next - applied_[thrust - 1].stamp <= max_age::kThrustApplied;
      if (moment.thrust_is_known) {
        moment.applied = applied_[thrust - 1].value;
      }
      const bool comes_now = attitude < attitudes_ && measured_[attitude].measured == next;
      const std::size_t seen = attitude + (comes_now ? 1 : 0);
      moment.attitude = seen > 0 ? &measured_[seen - 1] : nullptr;
      visit(moment);
      at = next;
    }
  }

 private:
  static constexpr std::size_t kRing = 64;  // of both channels
  static_assert(decltype(Blackboard::thrust_applied)::kSlots == kRing &&
                decltype(Blackboard::attitude)::kSlots == kRing);

  // Calls take(published) for all that the ring has, the oldest first.
  template <class T, class Take>
  static void for_each_kept(Reader<T>& reader, Take take) noexcept {
    const std::uint64_t newest = reader.newest_sequence();
    // The oldest is about to be written over.
    for (std::uint64_t i = newest >= kRing ? newest - kRing + 2 : 1; i <= newest; ++i) {
      if (const auto* published = reader.at(i); published != nullptr) {
        take(*published);
      }
    }
  }
  void collect() noexcept {
    thrusts_ = attitudes_ = 0;
    for_each_kept(thrust_, [this](const Stamped<ThrustApplied>& one) noexcept {
      if (thrusts_ == 0 || one.stamp > applied_[thrusts_ - 1].stamp) {
        applied_[thrusts_++] = one;
      }
    });
    for_each_kept(attitude_, [this](const Stamped<Attitude>& one) noexcept {
      if (attitudes_ == 0 || one.value.measured > measured_[attitudes_ - 1].measured) {
        measured_[attitudes_++] = one.value;
      }
    });
  }

  Reader<ThrustApplied> thrust_;
  Reader<Attitude> attitude_;
  std::array<Stamped<ThrustApplied>, kRing> applied_{};
  std::array<Attitude, kRing> measured_{};
  std::size_t thrusts_ = 0;
  std::size_t attitudes_ = 0;
};

}  // namespace lodesman
