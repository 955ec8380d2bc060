// SPDX-License-Identifier: Apache-2.0
// What is made of a thruster's command for the motor, propeller and speed controller that this boat
// has: a curve, a deadband that is jumped over, a slew limit, and a pause at zero before a
// reversal. Neutral is never delayed: a share of 0 gives 0 at once, and a smaller share of the same
// sign is given at once too. One object a thruster; one thread.
#pragma once

#include <array>
#include <cstddef>

#include "mid_level/base/time.h"

namespace lodesman {

struct ThrustCurvePoint {
  double in = 0.0;   // [-] [-1, 1] share of full thrust that is commanded
  double out = 0.0;  // [-] [-1, 1] share that is given to the box
};

// As it stands it changes nothing.
struct ThrustShapeOptions {
  static constexpr std::size_t kMaxCurvePoints = 8;

  // Straight lines through these and through 0, 0; beyond the outermost it stays as it is there. A
  // side without a point is as commanded. `in` rises from point to point, `out` does not fall, and
  // astern stays astern.
  std::array<ThrustCurvePoint, kMaxCurvePoints> curve{};
  std::size_t curve_points = 0;  // [-] of them in use
  // [-] [0, 0.9] The least share that turns the propeller: what is not 0 is at least that, and the
  // rest of the range is shared out evenly above it.
  double deadband = 0.0;
  double slew_per_s = 0.0;  // [1/s] how fast a share may grow; 0: at once
  Duration zero_pause{};    // [ns] [0, 10 s] at zero between ahead and astern
};

class ThrustShape {
 public:
  // Throws StartupError where the options say what cannot be.
  explicit ThrustShape(const ThrustShapeOptions& options);

  // The share to give to the box now; `share` outside [-1, 1] is clamped, and what is no number is
  // 0. Called at each step of the task: time that lies between two calls counts for the slew limit
  // as kLongestStep at most.
  [[nodiscard]] double shape(double share, Time now) noexcept;

  // The thruster stands still since `now`, whatever was asked for before.
  void stopped(Time now) noexcept { static_cast<void>(shape(0.0, now)); }

  static constexpr Duration kLongestStep = std::chrono::milliseconds{200};

 private:
  [[nodiscard]] double curved(double share) const noexcept;
  [[nodiscard]] double beyond_deadband(double share) const noexcept;
  [[nodiscard]] double slewed(double share, Duration step) const noexcept;
  [[nodiscard]] bool must_pause(double share, Time now) const noexcept;

  ThrustShapeOptions options_;
  double given_ = 0.0;      // by the last call
  double direction_ = 0.0;  // sign of what was last given that is not 0; 0: nothing yet
  Time stopped_at_{};       // when `given_` became 0
  Time called_at_{};
};

}  // namespace lodesman
