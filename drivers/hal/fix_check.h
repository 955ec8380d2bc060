// SPDX-License-Identifier: Apache-2.0
// What every driver of a receiver asks of a fix before it gives it: how accurate it is, whether it
// is a place at all, whether the date can be (utc.h), and whether it stands still while the boat
// moves. Pure functions, and one object a driver on its thread; nothing allocates.
#pragma once

#include <cstdint>
#include <optional>

#include "mid_level/base/time.h"
#include "mid_level/base/utc.h"
#include "mid_level/messages/vehicle.h"

namespace lodesman {

// [m] One standard deviation, horizontal, from what the receiver says of itself. Where it does not
// say how it came by the fix, as of a single one; where it does not say how its satellites stand
// (HDOP, [-]), as if they stood badly. The figures are ours (see docs/hardware.md): a receiver's
// own estimate is not used, for gpsd's knows no RTK.
[[nodiscard]] double fix_sigma_m(FixQuality quality, std::optional<double> hdop) noexcept;

// Latitude and longitude of 0 are what receivers say that have never had a fix.
[[nodiscard]] bool is_nowhere(double latitude_deg, double longitude_deg) noexcept;

// Whether a position repeats itself to the last digit while its times go on and the boat moves: by
// the receiver's own speed where it gives one, else where nearly every fix differed before. At rest
// nothing is called frozen, for many receivers hold their position there.
class FrozenPosition {
 public:
  static constexpr Duration kFrozenFor = std::chrono::seconds{10};
  static constexpr double kUnderWay_m_s = 0.3;

  // Takes the next fix; whether it is one of a frozen receiver.
  [[nodiscard]] bool frozen(const PositionFix& fix) noexcept;

 private:
  bool any_ = false;
  double latitude_deg_ = 0.0;
  double longitude_deg_ = 0.0;
  Time moving_since_{};     // [ns] of the fixes at this place in a row that say it moves, the first
  std::uint32_t past_ = 0;  // a bit a fix, the newest lowest: whether it differed
  bool was_lively_ = false;
};

}  // namespace lodesman
