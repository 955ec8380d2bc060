// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/emulators/utc.h"

namespace lodesman::emulated {

CivilTime civil_time(Duration since_1970) noexcept {
  const std::chrono::sys_time<std::chrono::nanoseconds> at{since_1970};
  const std::chrono::sys_days day = std::chrono::floor<std::chrono::days>(at);
  const std::chrono::year_month_day date{day};
  const std::chrono::hh_mm_ss<std::chrono::nanoseconds> clock{at - day};
  CivilTime civil;
  civil.year = static_cast<int>(date.year());
  civil.month = static_cast<int>(static_cast<unsigned>(date.month()));
  civil.day = static_cast<int>(static_cast<unsigned>(date.day()));
  civil.hour = static_cast<int>(clock.hours().count());
  civil.minute = static_cast<int>(clock.minutes().count());
  civil.second = static_cast<int>(clock.seconds().count());
  civil.millisecond = static_cast<int>(
      std::chrono::duration_cast<std::chrono::milliseconds>(clock.subseconds()).count());
  return civil;
}

}  // namespace lodesman::emulated
