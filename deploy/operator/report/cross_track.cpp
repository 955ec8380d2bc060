// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/report/cross_track.h"

#include <algorithm>
#include <cmath>

#include "mid_level/geometry/leg.h"

namespace lodesman::cli {

void CrossTrackMeter::Sum::add(double off_m) noexcept {
  ++count;
  squared_m2 += off_m * off_m;
  worst_m = std::max(worst_m, off_m);
}

double CrossTrackMeter::Sum::rms_m() const noexcept {
  return count > 0 ? std::sqrt(squared_m2 / static_cast<double>(count)) : 0.0;
}

void CrossTrackMeter::add(const MissionStatus& status, const WorldTruth& truth) noexcept {
  if (!status.keeps_line) {
    return;
  }
  const Leg leg{{status.line_begin_x_m, status.line_begin_y_m}, {status.goal_x_m, status.goal_y_m}};
  const Eigen::Vector2d place{truth.x_m, truth.y_m};
  const double off_m = std::abs(leg.cross_track_m(place));
  all_.add(off_m);
  if (leg.along_m(place) >= kSettled_m) {
    settled_.add(off_m);
  }
}

std::optional<CrossTrack> CrossTrackMeter::seen() const noexcept {
  if (all_.count == 0) {
    return std::nullopt;
  }
  return CrossTrack{all_.rms_m(), all_.worst_m, settled_.rms_m(), settled_.worst_m};
}

}  // namespace lodesman::cli
