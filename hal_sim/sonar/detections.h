// SPDX-License-Identifier: Apache-2.0
// The profile of a scene, as a sonar's own detection would give it: a range a beam, to the nearest
// surface, with errors by rate. What goes wrong with one obstacle is drawn from a stream of its
// own, and always the same number of times, so that neither another error nor another obstacle
// moves it. One thread; nothing here allocates once it is made, or throws.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hal_sim/scenario/detection_errors.h"
#include "hal_sim/sonar/heard_scene.h"
#include "mid_level/base/random_stream.h"
#include "mid_level/messages/sonar.h"

namespace lodesman {

class Detections {
 public:
  // `obstacles`: so many are in the scenes to come.
  Detections(std::size_t obstacles, const DetectionErrors& errors, std::uint64_t seed);

  // The next ping's: points for the beams that it has, which are a profile's.
  void detect(const HeardScene& scene, SonarPing& ping) noexcept;

 private:
  // What befalls one obstacle in this ping.
  struct Lot {
    std::uint32_t missed_pings = 0;  // [-] for which it is absent, this one included
    bool is_split = false;
    std::uint32_t hole = 0;    // [-] beams
    double hole_place = 0.0;   // [-] (0, 1) of where that may begin
    double off_m = 0.0;        // [m] of all its ranges
    std::uint32_t beams = 0;   // [-] of it that had a return so far ...
    std::uint32_t passed = 0;  // ... and that were looked at again
  };
  // Returns of nothing, side by side.
  struct Cluster {
    double range_m = 0.0;
    std::uint32_t first_beam = 0;
    std::uint32_t beams = 0;
    std::uint32_t pings_left = 0;
  };

  void draw_lots(double beam_step_rad) noexcept;
  void hear(const HeardScene& scene, SonarPing& ping) noexcept;
  void cut_holes(SonarPing& ping) noexcept;
  void renew_clusters(const SonarPing& ping) noexcept;
  void add_clusters(SonarPing& ping) noexcept;
  [[nodiscard]] Cluster draw_cluster(const SonarPing& ping) noexcept;

  DetectionErrors errors_;
  std::vector<RandomStream> random_;  // one an obstacle
  std::vector<Lot> lots_;
  std::vector<double> turned_rad_;  // of each obstacle in this ping
  RandomStream noise_;
  RandomStream false_;
  std::vector<Cluster> clusters_;
  std::array<double, kMaxBeams> noise_m_{};     // of each beam in this ping
  std::array<std::size_t, kMaxBeams> heard_{};  // whose return each beam has
};

}  // namespace lodesman
