// SPDX-License-Identifier: Apache-2.0
// What the sentences RMC, GGA, VTG, HDT and HDG of NMEA 0183 say, in SI units: pure decoding, total
// over any text. A field that is empty is not known; a field that cannot be what it should be makes
// its whole sentence Malformed, for a checksum of eight bits lets one damaged line in 256 pass. The
// talker, of two letters or digits, plays no part; makers' own sentences ($P...) are Unknown. Any
// thread; nothing allocates.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <variant>

#include "mid_level/base/time.h"

namespace lodesman::nmea {

struct Place {
  double latitude_deg = 0.0;   // [-90, 90]
  double longitude_deg = 0.0;  // [-180, 180]
};

struct Unknown {};    // of no type that is decoded here
struct Malformed {};  // of one that is, with a field that cannot be

// Recommended minimum.
struct Rmc {
  std::optional<Duration> time_of_day;  // [0, 24 h] UTC
  bool valid = false;                   // status A; false: V, or none
  std::optional<Place> place;
  std::optional<double> speed_m_s;      // over ground
  std::optional<double> course_rad;     // [-pi, pi] over ground, from true north
  std::optional<std::int64_t> date_ns;  // since 1970, of its midnight; years 1970 to 2069
  std::optional<double> variation_rad;  // magnetic, east positive
  char mode = '\0';                     // A, D, E, F, M, N, P, R, S; none before NMEA 2.3
};

// Global positioning fix data.
struct Gga {
  std::optional<Duration> time_of_day;
  std::optional<Place> place;
  int quality = 0;  // [0, 8] 0 none, 1 single, 2 differential, 3 PPS, 4 RTK, 5 float, 6 reckoned,
                    // 7 entered by hand, 8 simulated
  std::optional<int> satellites;
  std::optional<double> hdop;        // [-]
  std::optional<double> altitude_m;  // above mean sea level
  std::optional<double> geoid_m;     // of mean sea level above the ellipsoid
};

// Course and speed over ground.
struct Vtg {
  std::optional<double> course_rad;           // [-pi, pi] from true north
  std::optional<double> course_magnetic_rad;  // [-pi, pi]
  std::optional<double> speed_m_s;
};

struct Hdt {
  std::optional<double> heading_rad;  // [-pi, pi] from true north
};

struct Hdg {
  std::optional<double> heading_magnetic_rad;  // [-pi, pi]
  std::optional<double> deviation_rad;         // east positive
  std::optional<double> variation_rad;         // east positive
};

using Sentence = std::variant<Unknown, Malformed, Rmc, Gga, Vtg, Hdt, Hdg>;

// `sentence`: as framing gives it, from its '$' up to its '*'.
[[nodiscard]] Sentence decoded(std::string_view sentence) noexcept;

// "RMC" of "$GPRMC,..."; the whole address where it is not of a known form.
[[nodiscard]] std::string_view type_of(std::string_view sentence) noexcept;
// "GP" of "$GPRMC,..."; empty where the address is not of that form.
[[nodiscard]] std::string_view talker_of(std::string_view sentence) noexcept;

}  // namespace lodesman::nmea
