// SPDX-License-Identifier: Apache-2.0
// Draws the sonar view as the paper's Fig. 4 shows it: the fan, protection zones, obstacles, the
// path. Allocates and may write files: any best-effort thread, never a real-time task.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "mid_level/base/frames.h"
#include "mid_level/geometry/sonar_view.h"
#include "mid_level/messages/path.h"
#include "mid_level/messages/sonar.h"

namespace lodesman {

// What to draw. Everything but the range may be left out. What lies outside the fan is cut off.
struct ViewPicture {
  double range_m = 0.0;             // [m] > 0 range setting: the fan's radius
  const SonarPing* ping = nullptr;  // echoes, as yellow-brown shades
  const SonarObstacles* obstacles = nullptr;
  std::span<const PathPixel> path{};   // start first
  std::optional<VehiclePoint> goal{};  // out of view: marked at the edge, with its distance
  std::string_view caption{};          // time, frame, reason; lines split at '\n', at most two
};

enum class ViewFormat : std::uint8_t { kJpeg, kPng };

// The picture's file as bytes; empty where it cannot be drawn.
[[nodiscard]] std::vector<std::uint8_t> encode_view(const ViewPicture& picture, ViewFormat format);

// Whether the file was written whole.
[[nodiscard]] bool save_jpeg(const std::filesystem::path& file, const ViewPicture& picture);
[[nodiscard]] bool save_png(const std::filesystem::path& file, const ViewPicture& picture);

}  // namespace lodesman
