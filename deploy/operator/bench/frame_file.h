// SPDX-License-Identifier: Apache-2.0
// Queries in the sonar view: a JSON object a line, obstacles as ellipses in pixels. One thread,
// before anything runs; everything that is wrong throws StartupError.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "low_level/path/zone.h"
#include "mid_level/messages/path.h"

namespace lodesman::cli {

struct FrameQuery {
  nlohmann::ordered_json id;  // a whole number or a text
  PathPixel start;
  PathPixel goal;
  std::vector<EllipsePx> obstacles;

  // What the file says is right, where it says so.
  bool knows_cost = false;
  std::optional<std::int32_t> known_cost_10_14;  // nothing: there is no path
  std::optional<std::uint32_t> known_free_px;
};

inline constexpr std::size_t kMaxFrameFileBytes = std::size_t{64} << 20U;
inline constexpr std::size_t kMaxFrameObstacles = 4096;

// Keys that are not known are let be: such files carry notes of their own.
[[nodiscard]] std::vector<FrameQuery> read_frames(const std::filesystem::path& file);

}  // namespace lodesman::cli
