// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/cli/segment_overlay.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <sstream>

#include "low_level/sonar/view_image.h"
#include "mid_level/base/startup_error.h"

namespace lodesman::cli {
namespace {

namespace fs = std::filesystem;

// In short lines: the fan is wider the farther down.
[[nodiscard]] std::string caption_of(const OverlayFrame& frame, const std::string& stem) {
  std::string caption = fmt::format("{}\n{} {}", stem, frame.seen->count,
                                    frame.seen->count == 1 ? "obstacle" : "obstacles");
  if (frame.tracks != nullptr) {
    const auto tracks = std::span{frame.tracks->tracks}.first(frame.tracks->count);
    const auto movers = std::count_if(tracks.begin(), tracks.end(), [](const Track& track) {
      return track.velocity_xx_m2_s2 > 0.0;
    });
    const auto surely = std::count_if(tracks.begin(), tracks.end(),
                                      [](const Track& track) { return track.surely_moves(); });
    caption += fmt::format("\n{} may move, {} surely", movers, surely);
  }
  if (frame.path != nullptr) {
    caption += fmt::format("\npath: {}", to_string(frame.path->reason));
  }
  return caption;
}

[[nodiscard]] std::vector<std::string> layers_of(const std::string& text) {
  std::vector<std::string> layers;
  std::istringstream words{text};
  for (std::string word; std::getline(words, word, ',');) {
    if (std::find(kOverlayLayers.begin(), kOverlayLayers.end(), word) == kOverlayLayers.end()) {
      throw StartupError{"--layers: no layer is called '" + word + "'"};
    }
    layers.push_back(word);
  }
  return layers;
}

}  // namespace

SegmentOverlay::SegmentOverlay(fs::path directory, const std::string& layers, double bright_from)
    : directory_{std::move(directory)}, layers_{layers_of(layers)}, bright_from_{bright_from} {
  if (draws("bright", false) && bright_from <= 0.0) {
    throw StartupError{
        "--layers: what is bright is told by --threshold, or by segmentation.method"};
  }
  std::error_code error;
  fs::create_directories(directory_, error);
  if (error) {
    throw StartupError{directory_.string(), 1, "--overlay", error.message()};
  }
}

bool SegmentOverlay::draws(const char* layer, bool unasked) const {
  return layers_.empty() ? unasked
                         : std::find(layers_.begin(), layers_.end(), layer) != layers_.end();
}

void SegmentOverlay::save(const OverlayFrame& frame) {
  const std::string stem = frame.file.stem().string();
  const int used = ++names_[stem];
  const fs::path overlay =
      directory_ / (stem + (used > 1 ? "-" + std::to_string(used) : "") + ".png");
  const bool tracked = frame.tracker != nullptr;
  const bool bright = draws("bright", false);
  const std::string caption = caption_of(frame, stem);
  ViewPicture picture;
  picture.range_m = frame.ping->range_m;
  picture.look = ViewLook::kChart;
  picture.ping = bright || draws("echoes", true) ? frame.ping : nullptr;
  picture.bright_from = bright ? bright_from_ : 0.0;
  picture.obstacles = draws("obstacles", true) ? frame.seen : nullptr;
  picture.zones = draws("zones", frame.path != nullptr) ? frame.planned : nullptr;
  picture.tracks = draws("tracks", true) ? frame.tracks : nullptr;
  if (tracked && draws("water", true)) {
    // The head is at rest, so that its frame is the one that the water is known in.
    picture.water = [&water = frame.tracker->water()](const VehiclePoint& p) {
      return water.state(p.xy_m);
    };
  }
  if (frame.path != nullptr) {
    picture.path = {frame.path->pixels.data(), frame.path->pixel_count};
  }
  picture.goal = frame.goal;
  picture.caption = caption;
  if (!save_png(overlay, picture)) {
    throw StartupError{overlay.string(), 1, "--overlay", "cannot be written"};
  }
}

}  // namespace lodesman::cli
