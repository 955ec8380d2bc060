// SPDX-License-Identifier: Apache-2.0
// The colours of the sonar view, for what draws it and for tests that look for them. Layers that
// touch differ in brightness and in the style of their lines too, and blue stands against orange,
// so that no reader depends on telling red from green. Constants; any thread.
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
inline constexpr ViewColour kPath{255, 225, 40};  // yellow on a black casing

// The paper's look.
inline constexpr ViewColour kWater{24, 56, 92};
inline constexpr ViewColour kRing{78, 112, 150};
inline constexpr ViewColour kEcho{255, 240, 170};  // the brightest
inline constexpr ViewColour kZone{178, 238, 168};  // light green: the brightest area
inline constexpr ViewColour kZoneEdge{230, 255, 225};
inline constexpr ViewColour kObstacle{208, 36, 44};  // red: dark inside a white edge

// The chart's.
inline constexpr ViewColour kUnheard{16, 22, 32};       // no beam looks there
inline constexpr ViewColour kFaintest{18, 36, 58};      // of the echoes
inline constexpr ViewColour kBrightest{224, 228, 230};  // which leaves white to outlines
inline constexpr ViewColour kChartRing{86, 102, 122};
inline constexpr ViewColour kHatch{104, 116, 134};  // over water that nobody has seen
inline constexpr ViewColour kRests{255, 150, 20};
inline constexpr ViewColour kTrack{90, 200, 255};
inline constexpr double kUnseenLight = 0.55;  // of what lies between the hatching's lines
inline constexpr double kRestsOpacity = 0.28;
inline constexpr double kDoubtOpacity = 0.16;

}  // namespace view_colours
}  // namespace lodesman
