// SPDX-License-Identifier: Apache-2.0
// Which water around the boat was seen, and what was there. Plain data for the blackboard; any
// thread.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "mid_level/base/time.h"
#include "mid_level/messages/fields.h"

namespace lodesman {

enum class WaterState : std::uint8_t {
  kUnknown,   // nobody looked, or too long ago
  kFree,      // nothing was there when it was looked at
  kOccupied,  // something was
};

// A square of cells round the sonar's head, edges to the north and east. Written by the DeltaT task
// once a ping, before the tracks of that ping, where obstacles come from echoes: of a known scene
// there is none, since nothing of it is unseen. Read by the planner and displays.
struct Coverage {
  static constexpr std::size_t kSide = 96;  // [-] cells
  static constexpr double kCell_m = 0.5;

  std::uint64_t frame = 0;  // [-] number of the ping
  Time captured{};          // [ns] when it was taken
  double west_x_m = 0.0;    // [m] [world] of the square's south-western corner
  double south_y_m = 0.0;   // [m] [world]
  // Four cells a byte, the lowest two bits first: a WaterState each (3: unknown too). Row after
  // row from the south, in a row from the west.
  std::array<std::uint8_t, kSide * kSide / 4> cells{};  // [-]

  [[nodiscard]] Time measured_at() const noexcept { return captured; }

  // At a place in the world; unknown beyond the square.
  [[nodiscard]] WaterState at(double x_m, double y_m) const noexcept {
    const double column = std::floor((x_m - west_x_m) / kCell_m);
    const double row = std::floor((y_m - south_y_m) / kCell_m);
    constexpr double kEnd = kSide;
    if (!(column >= 0.0 && column < kEnd && row >= 0.0 && row < kEnd)) {
      return WaterState::kUnknown;
    }
    const std::size_t cell =
        static_cast<std::size_t>(row) * kSide + static_cast<std::size_t>(column);
    const unsigned state = (cells[cell / 4] >> (2 * (cell % 4))) & 3U;
    return state > static_cast<unsigned>(WaterState::kOccupied) ? WaterState::kUnknown
                                                                : static_cast<WaterState>(state);
  }
  // Of a cell that was unknown.
  void set(std::size_t column, std::size_t row, WaterState state) noexcept {
    const std::size_t cell = row * kSide + column;
    cells[cell / 4] = static_cast<std::uint8_t>(cells[cell / 4] |
                                                (static_cast<unsigned>(state) << (2 * (cell % 4))));
  }

  static constexpr auto fields() noexcept {
    using C = Coverage;
    return field_list(field("frame", &C::frame), field("captured", &C::captured),
                      field("west_x_m", &C::west_x_m), field("south_y_m", &C::south_y_m),
                      field("cells", &C::cells));
  }
};

}  // namespace lodesman
