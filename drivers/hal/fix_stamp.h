// SPDX-License-Identifier: Apache-2.0
// When a receiver's fix was made, by our clock: what every driver of a receiver asks for each fix.
// Fixes carry the receiver's UTC, lines and adapters hold them back for a time that varies; so the
// stamp is the arrival that came earliest, carried on by the receiver's time of day. The date plays
// no part: a receiver whose week number rolls over moves nothing. A fix is new where its time is
// later than the last one's; a receiver whose time goes back, as one that has learnt its leap
// seconds does, is believed again when three fixes in a row follow from each other. Owned by one
// driver, on its thread; nothing allocates.
#pragma once

#include <cstdint>

#include "mid_level/base/time.h"

namespace lodesman {

class FixStamp {
 public:
  enum class Verdict : std::uint8_t {
    kNew,
    kSame,  // the time of the one before, or no later stamp
    kOld,   // before it
  };
  struct Judged {
    Verdict verdict = Verdict::kSame;
    Time measured{};  // [ns] of a new one; never later than `arrived`, and rising
  };

  // So many in a row that follow from each other are believed, whatever was before.
  static constexpr int kConsistent = 3;
  // A receiver whose fixes have all come later than this for kLateFor has another time by now.
  static constexpr Duration kLate = std::chrono::milliseconds{500};
  static constexpr Duration kLateFor = std::chrono::seconds{5};

  // time_of_day: [0, 24 h] by the receiver. arrived: of the first byte that tells of the fix.
  [[nodiscard]] Judged judge(Duration time_of_day, Time arrived) noexcept;

  // [ns] from one time of day to another, the short way round midnight.
  [[nodiscard]] static Duration step_between(Duration from, Duration to) noexcept;

 private:
  [[nodiscard]] Judged begin(Duration time_of_day, Time arrived) noexcept;
  [[nodiscard]] Judged go_back(Duration time_of_day, Time arrived) noexcept;
  [[nodiscard]] Time carried_on(Duration step, Time arrived) noexcept;

  bool has_begun_ = false;
  Duration time_of_day_{};  // of the last new one
  Time measured_{};
  Time late_since_{};      // the arrival of the first of those that were late; 0: the last was not
  Duration least_late_{};  // of these
  Duration candidate_{};   // the last one that was old
  int consistent_ = 0;     // old ones that follow from each other
};

}  // namespace lodesman
