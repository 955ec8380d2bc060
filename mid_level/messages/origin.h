// SPDX-License-Identifier: Apache-2.0
// Where on the earth the world frame has its origin. Plain data for the blackboard; any thread.
#pragma once

#include <cstdint>

#include "mid_level/base/time.h"
#include "mid_level/messages/fields.h"

namespace lodesman {

// What fixed it.
enum class OriginSource : std::uint8_t {
  kConfiguration,  // or the scenario
  kFirstFix,       // the first fixes that were believed
};
[[nodiscard]] constexpr auto enumerators(OriginSource) noexcept {
  return enumerators_to<OriginSource::kFirstFix>("configuration", "first_fix");
}

// Written by the estimator, once, when it is known; read by whatever turns places of the earth into
// places of the world, by displays, and by an estimator that is started again, which keeps it.
struct WorldOrigin {
  double latitude_deg = 0.0;   // [deg] [-90, 90] WGS-84
  double longitude_deg = 0.0;  // [deg] [-180, 180]
  OriginSource source = OriginSource::kConfiguration;
  double sigma_m = 0.0;     // [m] [0, 1e5] of the fix by its receiver; 0: configured, or unknown
  Time fixed{};             // [ns] when that fix was measured; 0: configured
  std::int64_t utc_ns = 0;  // [ns] since 1970, the same by the receiver; 0: not known

  static constexpr auto fields() noexcept {
    using W = WorldOrigin;
    return field_list(field("latitude_deg", &W::latitude_deg).within(-90.0, 90.0),
                      field("longitude_deg", &W::longitude_deg).within(-180.0, 180.0),
                      field("source", &W::source), field("sigma_m", &W::sigma_m).within(0.0, 1e5),
                      field("fixed", &W::fixed), field("utc_ns", &W::utc_ns).within(0.0, 4e18));
  }
};

}  // namespace lodesman
