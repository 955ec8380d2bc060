// SPDX-License-Identifier: Apache-2.0
// Obstacles from a ping of any kind, by the method that is set. One thread owns a Detector: the
// DeltaT task calls it once a ping. It allocates when made and never after.
#pragma once

#include "low_level/sonar/contrast.h"
#include "low_level/sonar/profile.h"
#include "low_level/sonar/segmentation.h"

namespace lodesman {

class Detector {
 public:
  explicit Detector(const SegmentationOptions& options);

  // In the head's frame, nearest first. A ping that breaks its own ranges gives none.
  void detect(const SonarPing& ping, SonarObstacles& out) noexcept;

 private:
  DetectionMethod method_;
  ContrastDetector contrast_;
  Segmenter threshold_;
  ProfileDetector profile_;
};

}  // namespace lodesman
