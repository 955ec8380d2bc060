// SPDX-License-Identifier: Apache-2.0
// The sentences of NMEA 0183 that a satellite receiver sends, with their sum and their end of line.
// Pure functions; any thread.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "hal_sim/emulators/utc.h"

namespace lodesman::emulated {

// What GGA says of a fix.
enum class NmeaQuality : std::uint8_t { kNone = 0, kOrdinary = 1, kRtkFixed = 4, kRtkFloat = 5 };

struct NmeaFix {
  CivilTime time;
  NmeaQuality quality = NmeaQuality::kOrdinary;  // kNone: no position is said
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
  int satellites = 8;
  double hdop = 0.9;
  double altitude_m = 0.0;              // above mean sea level
  double geoid_m = 0.0;                 // mean sea level above the ellipsoid
  double speed_m_s = 0.0;               // over ground
  std::optional<double> course_deg;     // [0, 360) true; none at rest
  std::optional<double> variation_deg;  // of the compass, east positive
  double heading_deg = 0.0;             // [0, 360) true
};

// How a receiver writes.
struct NmeaManner {
  std::string_view talker = "GP";
  int minute_decimals = 4;
};

[[nodiscard]] std::string gga(const NmeaFix& fix, const NmeaManner& manner);
[[nodiscard]] std::string rmc(const NmeaFix& fix, const NmeaManner& manner);
[[nodiscard]] std::string vtg(const NmeaFix& fix, const NmeaManner& manner);
[[nodiscard]] std::string hdt(const NmeaFix& fix, const NmeaManner& manner);

// Where the sum begins in a sentence: at its asterisk.
[[nodiscard]] std::size_t sum_at(std::string_view sentence) noexcept;

}  // namespace lodesman::emulated
