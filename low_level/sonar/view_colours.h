// SPDX-License-Identifier: Apache-2.0
// The colours of the sonar view, for what draws it and for tests that look for them. Layers that
// touch differ in brightness too, and blue stands against orange, so that no reader depends on
// telling red from green. Constants; any thread.
#pragma once

#include <cstdint>

namespace lodesman {

struct ViewColour {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;
};

namespace view_colours {

inline constexpr ViewColour kOutside{14, 22, 34};
inline constexpr ViewColour kText{220, 228, 235};
inline constexpr ViewColour kBlack{0, 0, 0};
inline constexpr ViewColour kWhite{255, 255, 255};

// Of one ping and a path.
inline constexpr ViewColour kWater{24, 56, 92};
inline constexpr ViewColour kRing{78, 112, 150};
inline constexpr ViewColour kEcho{255, 240, 170};  // the brightest
inline constexpr ViewColour kZone{178, 238, 168};  // light green: the brightest area
inline constexpr ViewColour kZoneEdge{230, 255, 225};
inline constexpr ViewColour kObstacle{208, 36, 44};  // red: dark inside a white edge
inline constexpr ViewColour kPath{255, 225, 40};     // yellow on a black casing

// Of what is known beyond it.
inline constexpr ViewColour kUnheard{22, 22, 22};  // no beam looks there
inline constexpr ViewColour kGreyRing{84, 84, 84};
inline constexpr ViewColour kFree{40, 120, 255};
inline constexpr ViewColour kOccupied{255, 150, 20};
inline constexpr ViewColour kTrack{255, 110, 220};
inline constexpr double kFreeOpacity = 0.18;
inline constexpr double kOccupiedOpacity = 0.25;

}  // namespace view_colours
}  // namespace lodesman
