// SPDX-License-Identifier: Apache-2.0
// The frame by which the maker's program for the Delta T takes settings: 256 bytes to where its
// datagrams come from, "after each of them"; it is never acknowledged. Pure; any thread.
//
// Source: the maker's sample program "DeltaT External Control UDP" and one driver.
#pragma once

#include <array>
#include <optional>

#include "drivers/delta_t/record.h"

namespace lodesman::delta_t {

inline constexpr std::size_t kControlBytes = 256;
// [m] of its codes 2, 3, ...
inline constexpr std::array<int, 13> kRanges_m{5,  10,  20,  30,  40,  50, 60,
                                               80, 100, 150, 200, 250, 300};
inline constexpr std::array<int, 4> kSectors_deg{30, 60, 90, 120};  // codes 0, 1, ...
inline constexpr std::array<int, 3> kBeams{480, 240, 120};          // codes 0, 1, 2

// What is asked for. What is not named here is off: averaging, which smears what moves, and
// persistence; equalisation, roll compensation, records on the other computer's disk.
struct Control {
  RecordKind output = RecordKind::kImage;
  int range_m = 30;                 // [m] one of kRanges_m
  int gain_db = 10;                 // [dB] [0, 20]
  int display_gain_percent = 50;    // [%] [1, 100]
  int sector_deg = 120;             // [deg] one of kSectors_deg
  int beams = 120;                  // [-] one of kBeams
  double sound_speed_m_s = 1500.0;  // [m/s] [1400, 1600]
  int least_level_percent = 30;     // [%] [10, 90] of a profile's returns
  int least_range_m = 0;            // [m] [0, 100] of a profile's returns
  bool transducer_up = false;

  friend bool operator==(const Control&, const Control&) = default;
};

[[nodiscard]] std::array<std::uint8_t, kControlBytes> control_frame(
    const Control& control) noexcept;

// What such a frame asks for; nothing where it is none, or has a code that there is not.
[[nodiscard]] std::optional<Control> control_in(Bytes bytes) noexcept;

// Whether a record is as asked for, as far as its header tells: its gain does not show there.
[[nodiscard]] bool echoes(const Header& header, const Control& control) noexcept;

}  // namespace lodesman::delta_t
