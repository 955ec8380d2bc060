// SPDX-License-Identifier: Apache-2.0
// Draws the sonar view: as the paper's Fig. 4 shows it, or as a chart of what was heard and of what
// is made of it. The one way of drawing that `lodesman segment`, `sim` and `plot` have. Allocates
// and may write files: any best-effort thread, never a real-time task.
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
#include "mid_level/messages/coverage.h"
#include "mid_level/messages/path.h"
#include "mid_level/messages/sonar.h"
#include "mid_level/messages/tracks.h"

namespace lodesman {

enum class ViewLook : std::uint8_t {
  kPaper,  // its Fig. 4: filled zones and obstacles, over echoes as over glass; neither tracks nor
           // water
  kChart,  // grey echoes whose contrast is stretched; all that is made of them as lines
};

// What to draw. Everything but the range may be left out. What lies outside the fan is cut off, but
// tracks are not: they are known where nothing is heard too.
struct ViewPicture {
  double range_m = 0.0;  // [m] > 0 range setting: the fan's radius
  ViewLook look = ViewLook::kPaper;
  const SonarPing* ping = nullptr;            // in the head's frame
  SonarMounting mounting{};                   // of that head
  double bright_from = 0.0;                   // [-] > 0: only which bins are as bright, of 255
  const SonarObstacles* zones = nullptr;      // whose protection zones
  const SonarObstacles* obstacles = nullptr;  // whose bodies; the same, or what one ping shows
  const Tracks* tracks = nullptr;
  VehiclePose pose{};  // in the tracks' frame and at their time
  // What is known of the water at a place in the vehicle frame; empty: nobody says.
  std::function<WaterState(const VehiclePoint&)> water{};
  std::span<const PathPixel> path{};   // start first
  std::optional<VehiclePoint> goal{};  // out of view: marked at the edge, with its distance
  std::string_view caption{};          // time, frame, reason; lines split at '\n'

  [[nodiscard]] bool is_chart() const noexcept { return look == ViewLook::kChart; }
};

enum class ViewFormat : std::uint8_t { kJpeg, kPng };

// The picture's file as bytes; empty where it cannot be drawn: the range must be a sonar's.
[[nodiscard]] std::vector<std::uint8_t> encode_view(const ViewPicture& picture, ViewFormat format);

// Whether the file was written whole.
[[nodiscard]] bool save_jpeg(const std::filesystem::path& file, const ViewPicture& picture);
[[nodiscard]] bool save_png(const std::filesystem::path& file, const ViewPicture& picture);

}  // namespace lodesman
