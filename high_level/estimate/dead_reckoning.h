// SPDX-License-Identifier: Apache-2.0
// Dead reckoning from the thrust reference and the measured heading: eqs 15-25 of the paper. Plain
// values; one thread.
#pragma once

#include "mid_level/base/frames.h"
#include "mid_level/base/speed_table.h"
#include "mid_level/base/time.h"

namespace lodesman {

struct DeadReckoningOptions {
  Duration step{};                                    // the paper's time interval: 0.2 s
  SpeedTable speeds = SpeedTable::proportional(1.0);  // the paper: k times SurgeRef
};

class DeadReckoning {
 public:
  DeadReckoning(const DeadReckoningOptions& options, const WorldPoint& start) noexcept
      : options_{options}, position_{start} {}

  // X += k SurgeRef sin(heading) dt, Y += k SurgeRef cos(heading) dt (eqs 24-25), once for every
  // step that has gone by since the last call; at most kMaxSteps, so that a gap cannot stall it.
  // The paper writes HeadRef where a heading must stand; section 6.4 says that it is measured.
  void advance(Time now, int surge_ref, Heading heading) noexcept;

  // Begins there instead, where it was then.
  void resume(Time then, const WorldPoint& position) noexcept {
    position_ = position;
    advanced_to_ = then;
    running_ = true;
  }

  // A fix: the estimate moves towards it by a share in [0, 1].
  void correct(const WorldPoint& fix, double share) noexcept;

  // As of the last whole step.
  [[nodiscard]] const WorldPoint& position() const noexcept { return position_; }
  // Carried on to `now` within the step that has begun, so that a pose belongs to its stamp.
  [[nodiscard]] WorldPoint position_at(Time now, int surge_ref, Heading heading) const noexcept;
  [[nodiscard]] double speed_m_s(int surge_ref) const noexcept {
    return options_.speeds.speed_m_s(surge_ref);
  }

 private:
  [[nodiscard]] Eigen::Vector2d travelled_m(Duration time, int surge_ref,
                                            Heading heading) const noexcept;

  static constexpr int kMaxSteps = 10;
  DeadReckoningOptions options_;
  WorldPoint position_;
  Time advanced_to_{};
  bool running_ = false;
};

}  // namespace lodesman
