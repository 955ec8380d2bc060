// SPDX-License-Identifier: Apache-2.0
// Whether the sonar is heard: what is known of the water grows old between two frames, and is
// trusted the less the older it is. Plain values; one thread.
#pragma once

#include <cstdint>

#include "mid_level/base/time.h"

namespace lodesman {

enum class Sight : std::uint8_t {
  kNew,   // frames come as they did
  kLate,  // one is missing: slower, by what is remembered
  kLost,  // none for too long: stops, and makes way for what is remembered
};

class SightWatch {
 public:
  // lost_after: a newest frame that is older is lost, one half as old late in any case.
  explicit SightWatch(Duration lost_after) noexcept : lost_after_{lost_after} {}

  // How often frames came before is forgotten.
  void start() noexcept { frame_ = Time{}; }

  // frame: when the newest one came.
  [[nodiscard]] Sight look(Time now, Time frame) noexcept;

 private:
  Duration lost_after_;
  Duration interval_{};  // of the last two frames
  Time frame_{};
};

}  // namespace lodesman
