// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/emulators/utc.h"

namespace lodesman::emulated {

CivilTime civil_time(Duration since_1970) noexcept {
  using namespace std::chrono;
  const sys_time<nanoseconds> at{since_1970};
  const sys_days day = floor<days>(at);
  const year_month_day date{day};
  const hh_mm_ss<nanoseconds> clock{at - day};
  CivilTime civil;
  civil.year = static_cast<int>(date.year());
  civil.month = static_cast<int>(static_cast<unsigned>(date.month()));
  civil.day = static_cast<int>(static_cast<unsigned>(date.day()));
  civil.hour = static_cast<int>(clock.hours().count());
  civil.minute = static_cast<int>(clock.minutes().count());
  civil.second = static_cast<int>(clock.seconds().count());
  civil.millisecond = static_cast<int>(duration_cast<milliseconds>(clock.subseconds()).count());
  return civil;
}

}  // namespace lodesman::emulated
