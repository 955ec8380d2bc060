// SPDX-License-Identifier: Apache-2.0
#include "low_level/sonar/detector.h"

namespace lodesman {

Detector::Detector(const SegmentationOptions& options)
    : method_{options.method}, contrast_{options}, threshold_{options}, profile_{options} {}

void Detector::detect(const SonarPing& ping, SonarObstacles& out) noexcept {
  if (ping.kind == PingKind::kProfile) {
    profile_.detect(ping, out);
  } else if (method_ == DetectionMethod::kContrast) {
    contrast_.detect(ping, out);
  } else {
    threshold_.segment(ping, out);
  }
}

}  // namespace lodesman
