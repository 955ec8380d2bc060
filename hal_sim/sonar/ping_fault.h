// SPDX-License-Identifier: Apache-2.0
// What goes wrong with the echoes of a sonar before anybody decodes them: an image as it was heard
// is altered in place. Used by the simulated sonar and by what stands in for a real one to the
// byte, on their one thread; allocates when made and never after.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hal_sim/scenario/fault.h"
#include "mid_level/base/random_stream.h"
#include "mid_level/messages/sonar.h"

namespace lodesman {

// An image's echoes, beam by beam, and where its beams lie.
struct EchoImage {
  std::span<std::uint8_t> echo;  // beams x bins
  std::uint32_t beams = 0;
  std::uint32_t bins = 0;
  double range_m = 0.0;
  double first_bearing_rad = 0.0;  // clockwise from ahead
  double beam_step_rad = 0.0;
};

[[nodiscard]] EchoImage image_of(SonarPing& ping) noexcept;

class PingFault {
 public:
  // Each kind has a stream of its own, by the scenario's seed.
  explicit PingFault(std::uint64_t seed);

  // Once an image, whether or not anything is wrong. `thrust_load` is as in the world's sample.
  // Kinds that alter no echoes leave it as it is.
  void alter(const Fault& fault, double thrust_load, const EchoImage& image) noexcept;

 private:
  void saturate(const EchoImage& image) noexcept;
  void freeze(const EchoImage& image) noexcept;
  void cover_with_weed(const EchoImage& image) noexcept;
  void interfere(double strength, const EchoImage& image) noexcept;

  RandomStream saturated_;
  RandomStream haze_;
  RandomStream rays_;
  double weed_begins_;                // [-] [0, 1) of the beams
  std::vector<std::uint8_t> frozen_;  // the image that comes again
  std::size_t frozen_cells_ = 0;      // of it; 0: none yet
};

}  // namespace lodesman
