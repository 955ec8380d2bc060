// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/console/utc_text.h"

#include <array>
#include <cstdint>
#include <cstdio>
#include <ctime>

#include "mid_level/base/utc.h"

namespace lodesman::console {

std::string utc_text() {
  std::timespec now{};
  std::timespec_get(&now, TIME_UTC);
  if (!is_plausible_utc(std::int64_t{now.tv_sec} * 1'000'000'000)) {
    return {};
  }
  std::tm parts{};
  gmtime_r(&now.tv_sec, &parts);
  std::array<char, 32> text{};
  const std::size_t length = std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%S", &parts);
  std::array<char, 32> thousandths{};
  constexpr long kMillisecond_ns = 1'000'000;
  static_cast<void>(std::snprintf(thousandths.data(), thousandths.size(), ".%03ldZ",
                                  now.tv_nsec / kMillisecond_ns));
  return std::string{text.data(), length} + thousandths.data();
}

}  // namespace lodesman::console
