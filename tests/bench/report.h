// SPDX-License-Identifier: Apache-2.0
// Medians, tails and ratios of what was measured, as JSON and as the tables of docs/performance.md.
// Pure functions; any thread.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "tests/bench/measure.h"

namespace lodesman::bench {

// One line of the tables of growth.
struct Growth {
  std::string name;
  double size = 1.0;  // grid or number of obstacles, relative to the first line
  std::vector<FrameTimes> frames;
};

// How many times as long the reference A* takes as our step, at this share of the frames.
[[nodiscard]] double reference_per_step(std::span<const FrameTimes> frames, double share);

[[nodiscard]] nlohmann::ordered_json to_json(std::span<const FrameTimes> frames);
[[nodiscard]] nlohmann::ordered_json to_json(std::span<const Growth> growth);

// The lines over all frames, and those with a line for each kind besides.
[[nodiscard]] std::string summary_of(std::span<const FrameTimes> frames);
[[nodiscard]] std::string table_of(std::span<const FrameTimes> frames);
[[nodiscard]] std::string table_of(std::span<const Growth> growth);

}  // namespace lodesman::bench
