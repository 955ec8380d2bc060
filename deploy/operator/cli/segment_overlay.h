// SPDX-License-Identifier: Apache-2.0
// The pictures that `lodesman segment --overlay` leaves: what was found in a frame, and with
// --track what is known by then. The main thread.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "low_level/tracking/tracker.h"
#include "mid_level/base/frames.h"
#include "mid_level/messages/path.h"
#include "mid_level/messages/sonar.h"
#include "mid_level/messages/tracks.h"

namespace lodesman::cli {

// What --layers takes.
inline const std::vector<std::string> kOverlayLayers{"echoes", "bright", "obstacles",
                                                     "zones",  "water",  "tracks"};

// One frame, as far as it was made something of.
struct OverlayFrame {
  std::filesystem::path file{};
  const SonarPing* ping = nullptr;
  const SonarObstacles* seen = nullptr;  // in this ping alone
  const SonarObstacles* planned =
      nullptr;                       // what zones were made round; the same without a tracker
  const Tracker* tracker = nullptr;  // of a head at rest
  const Tracks* tracks = nullptr;    // its
  const SonarPath* path = nullptr;   // to the goal, if there is one
  std::optional<VehiclePoint> goal{};
};

class SegmentOverlay {
 public:
  // Makes the directory. `layers`: a few of those above, joined by commas; empty: what there is,
  // but zones only where something was planned. `bright_from`: the threshold; 0: none.
  // Throws StartupError.
  SegmentOverlay(std::filesystem::path directory, const std::string& layers, double bright_from);

  // <directory>/<the file's stem>.png, or with a number where that is taken. Throws StartupError.
  void save(const OverlayFrame& frame);

 private:
  [[nodiscard]] bool draws(const char* layer, bool unasked) const;

  std::filesystem::path directory_;
  std::vector<std::string> layers_;
  double bright_from_;
  std::map<std::string, int> names_;  // how often each has been used
};

}  // namespace lodesman::cli
