// SPDX-License-Identifier: Apache-2.0
// The second gate, behind the CRC: of 16 bits, one damaged frame in some hundred thousand passes,
// so that a packet is believed only where it follows from one that was: a whole number of periods
// later by the device's own time, turned by as much as its own rates say. What does not follow may
// be a step of the unit, as after a restart: where three packets in a row follow from each other,
// they are believed instead. It also says when a packet was measured. Nothing allocates; one
// thread.
#pragma once

#include <algorithm>
#include <cstdint>

#include "drivers/nav440/packets.h"
#include "mid_level/base/time.h"

namespace lodesman::nav440 {

class Plausibility {
 public:
  // So many packets that follow from each other are believed, whatever was before.
  static constexpr int kConsistent = 3;
  // A reference that is older says nothing of what comes, as it says nothing to a helmsman; of slow
  // packets, one that is three periods old.
  static constexpr Duration kLongestStep = std::chrono::milliseconds{300};

  enum class Verdict : std::uint8_t {
    kBelieved,
    kNotYet,   // nothing was believed lately, and this is too little to begin with
    kRefused,  // it follows from nothing
  };
  struct Judged {
    Verdict verdict = Verdict::kNotYet;
    Time measured{};  // [ns] where it is believed; never later than it arrived
  };

  explicit Plausibility(int rate_hz) noexcept
      : period_{Duration{std::chrono::seconds{1}} / rate_hz},
        longest_step_{std::max(kLongestStep, 3 * period_)},
        still_needed_{rate_hz < kStill ? 3 : kStill} {}

  // `arrived`: less what the line is known to take.
  [[nodiscard]] Judged judge(const HeadingPacket& packet, Time arrived) noexcept;
  void restart() noexcept;

  // Sister units have a time that stands still: then packets are taken by their arrival.
  [[nodiscard]] bool time_stands() const noexcept { return stands_; }

  // [rad] by how much a turn may differ from what the rates say, after so long: noise of the rate
  // and corrections of the filter, and a rate that changes between two packets. No less than a
  // hundred times the packet's resolution.
  [[nodiscard]] static double yaw_bound_rad(double step_s) noexcept;
  // [rad/s] by how much the rate may change.
  [[nodiscard]] static double rate_bound_rad_s(double step_s) noexcept;

 private:
  static constexpr int kStill = 8;

  // Packets that follow from each other, up to the last one. Its time of measurement is the least
  // that arrivals allow, carried on by the device's own time.
  struct Chain {
    int length = 0;  // 0: there is none
    HeadingPacket last{};
    Time arrived{};
    Time measured{};
  };

  [[nodiscard]] bool follow(Chain& chain, const HeadingPacket& packet, Time arrived) noexcept;
  // Zero: no step that a sound packet could have made.
  [[nodiscard]] Duration step_by_time(const Chain& chain, const HeadingPacket& packet,
                                      Time arrived) const noexcept;
  [[nodiscard]] Duration step_by_arrival(const Chain& chain, Time arrived) const noexcept;
  [[nodiscard]] Duration step_of_time(const HeadingPacket& from,
                                      const HeadingPacket& to) const noexcept;
  void watch_time(const HeadingPacket& packet) noexcept;

  Duration period_;
  Duration longest_step_;
  int still_needed_;
  Chain believed_;
  Chain candidate_;
  HeadingPacket seen_{};  // the last one, believed or not
  bool any_seen_ = false;
  bool stands_ = false;
  int still_ = 0;    // packets in a row with the same time
  int running_ = 0;  // that are whole periods apart
};

}  // namespace lodesman::nav440
