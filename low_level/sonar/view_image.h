// SPDX-License-Identifier: Apache-2.0
// Draws the sonar view as the paper's Fig. 4 shows it: the fan, protection zones, obstacles, the
// path; or, where tracks or water are given, what is known beyond one ping: grey echoes, outlines
// of what they show, tracks, water that is free and water that is not. Allocates and may write
// files: any best-effort thread, never a real-time task.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "low_level/sonar/mounting.h"
#include "mid_level/base/frames.h"
#include "mid_level/geometry/sonar_view.h"
#include "mid_level/messages/path.h"
#include "mid_level/messages/sonar.h"
#include "mid_level/messages/tracks.h"

namespace lodesman {

enum class ViewWater : std::uint8_t { kUnknown, kFree, kOccupied };

// What to draw. Everything but the range may be left out. What lies outside the fan is cut off, but
// tracks are not: they are known where nothing is heard too.
struct ViewPicture {
  double range_m = 0.0;                       // [m] > 0 range setting: the fan's radius
  const SonarPing* ping = nullptr;            // in the head's frame
  SonarMounting mounting{};                   // of that head
  double bright_from = 0.0;                   // [-] > 0: only which bins are as bright, of 255
  const SonarObstacles* zones = nullptr;      // whose protection zones
  const SonarObstacles* obstacles = nullptr;  // whose bodies; the same, or what one ping shows
  const Tracks* tracks = nullptr;
  VehiclePose pose{};                                     // in the tracks' frame and at their time
  std::function<ViewWater(const VehiclePoint&)> water{};  // what is known of it
  std::span<const PathPixel> path{};                      // start first
  std::optional<VehiclePoint> goal{};  // out of view: marked at the edge, with its distance
  std::string_view caption{};          // time, frame, reason; lines split at '\n'

  // Whether it shows more than one ping and a path.
  [[nodiscard]] bool shows_the_known() const noexcept { return tracks != nullptr || water; }
};

enum class ViewFormat : std::uint8_t { kJpeg, kPng };

// The picture's file as bytes; empty where it cannot be drawn.
[[nodiscard]] std::vector<std::uint8_t> encode_view(const ViewPicture& picture, ViewFormat format);

// Whether the file was written whole.
[[nodiscard]] bool save_jpeg(const std::filesystem::path& file, const ViewPicture& picture);
[[nodiscard]] bool save_png(const std::filesystem::path& file, const ViewPicture& picture);

}  // namespace lodesman
