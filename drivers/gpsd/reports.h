// SPDX-License-Identifier: Apache-2.0
// What gpsd says, a line a report (gpsd_json(5), protocol 3): pure decoding, total over any text.
// What is not given is not known; what cannot be is as if it had not been given, but for a report
// that is no whole object, which is Broken. Texts are views of the line. Any thread; nothing
// allocates.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <variant>

namespace lodesman::gpsd {

struct Broken {};  // no whole object, or without a class
struct Other {};   // of a class that is not decoded here

// Time, position, velocity.
struct Tpv {
  std::string_view device;
  int mode = 0;                         // 0 not known, 1 no fix, 2 flat, 3 with height
  int status = 0;                       // 0 not known, 1 single, 2 differential, 3 RTK fixed,
                                        // 4 RTK float, 5 reckoned, 6 reckoned too, 7 time alone,
                                        // 8 simulated, 9 P(Y)
  std::optional<std::int64_t> utc_ns;   // since 1970
  std::optional<double> latitude_deg;   // [-90, 90]
  std::optional<double> longitude_deg;  // [-180, 180]
  std::optional<double> eph_m;          // its estimate of the error; knows no RTK
  std::optional<double> speed_m_s;      // over ground
  std::optional<double> course_rad;     // [-pi, pi] over ground, from true north
};

// The satellites.
struct Sky {
  std::string_view device;
  std::optional<double> hdop;  // [-]
  std::optional<int> used;     // satellites
};

// Heading, of a receiver that measures one.
struct Att {
  std::string_view device;
  std::optional<double> heading_rad;  // [-pi, pi] true
};

// Its receivers.
struct Devices {
  bool any = false;
};
struct Device {
  std::string_view path;
  bool active = false;
};

struct Version {
  std::string_view release;
  int protocol_major = 0;
  int protocol_minor = 0;
};

using Report = std::variant<Broken, Other, Tpv, Sky, Att, Devices, Device, Version>;

[[nodiscard]] Report decoded(std::string_view line) noexcept;

// [ns] since 1970 of "2026-11-21T12:35:00.000Z".
[[nodiscard]] std::optional<std::int64_t> utc_of(std::string_view text) noexcept;

}  // namespace lodesman::gpsd
