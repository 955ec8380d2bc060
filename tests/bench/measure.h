// SPDX-License-Identifier: Apache-2.0
// Times planners side by side on the same random frames, with Google Benchmark and all repetitions
// in an order drawn at random. One thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "mid_level/geometry/sonar_view.h"
#include "tests/support/random_frames.h"

namespace lodesman::bench {

// What is timed, in microseconds.
enum class Column : std::uint8_t {
  kStep,       // ours: obstacle list to bitmap to path
  kSearch,     // ours: bitmap to path
  kReference,  // reference_a_star.h: bitmap to path
  kBoost,      // boost_a_star.h: bitmap to path
  kOmpl,       // ompl_rrt_connect.h: bitmap to any path, or its time box; 0 where it is left out
  kCopy,       // copying as many words as the bitmap of rows has, as a measure of the machine
};
inline constexpr std::size_t kColumns = 6;
inline constexpr std::array<std::string_view, kColumns> kColumnNames{
    "step", "search", "reference A*", "Boost A*", "OMPL RRTConnect", "copy"};

// A frame's median times, in processor time of the thread.
struct FrameTimes {
  testing::FrameKind kind = testing::FrameKind::kOpen;
  std::array<double, kColumns> us{};
};

struct Workload {
  std::uint32_t seed = 0;
  FanShape fan{};
  int times = 1;                          // obstacles, as FrameMaker has it
  int frames = 25;                        // of each kind
  std::vector<testing::FrameKind> kinds;  // empty: all
  int repetitions = 5;                    // of each planner on each frame
  bool with_others = true;                // reference, Boost and OMPL
};

// Throws std::runtime_error where two planners disagree on a cost.
[[nodiscard]] std::vector<FrameTimes> measure(const Workload& workload);
// The same on given frames; of the workload only fan, repetitions and with_others are asked.
[[nodiscard]] std::vector<FrameTimes> measure(const Workload& workload,
                                              const std::vector<testing::RandomFrame>& frames);

}  // namespace lodesman::bench
