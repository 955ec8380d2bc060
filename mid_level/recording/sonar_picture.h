// SPDX-License-Identifier: Apache-2.0
// A ping as a picture for people: the sonar view at half its size, grey, as a JPEG. One thread; it
// allocates.
#pragma once

#include <memory>
#include <vector>

#include "mid_level/messages/sonar.h"

namespace lodesman {

class SonarPicture {
 public:
  // 120 degrees to the right and left of straight up, its apex in the middle of the lowest row.
  static constexpr int kColumns = 433;  // [px]
  static constexpr int kRows = 250;     // [px] the ping's range

  SonarPicture();
  SonarPicture(const SonarPicture&) = delete;
  SonarPicture& operator=(const SonarPicture&) = delete;
  ~SonarPicture();

  // Empty where the library fails. Of a profile each beam's point is drawn.
  [[nodiscard]] std::vector<unsigned char> jpeg_of(const SonarPing& ping);

 private:
  struct Polar {
    float range = 0.0F;  // [-] of the ping's range
    float bearing_rad = 0.0F;
  };
  struct Encoder;

  [[nodiscard]] static unsigned char grey_of(const SonarPing& ping, const Polar& place) noexcept;

  std::vector<Polar> places_;  // row by row, the farthest first
  std::vector<unsigned char> grey_;
  std::unique_ptr<Encoder> encoder_;
};

}  // namespace lodesman
