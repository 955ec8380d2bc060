// SPDX-License-Identifier: Apache-2.0
// Whether the boat makes way over ground while it wants to, and if not, why, as far as that is
// known. It is handed everything it needs; one thread.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "mid_level/base/frames.h"
#include "mid_level/base/time.h"
#include "mid_level/messages/command.h"

namespace lodesman {

struct ProgressWatchOptions {
  Duration patience{};       // without way for so long, it is said
  double least_way_m = 0.0;  // [m] > 0 made good in that time is way
};

// The way that a boat with that speed is sure to make in the time of patience, turning and
// starting included: half a metre, or a quarter of what the speed alone gives.
[[nodiscard]] double least_way_m(const ProgressWatchOptions& options, double speed_m_s) noexcept;

// What the boat does at one moment.
struct ProgressSample {
  bool wanted = false;                 // whether it wants to move on
  std::optional<WorldPoint> position;  // estimated; empty while the estimate is stale
  Eigen::Vector2d course{0.0, 0.0};    // [world] unit vector that it wants to go along; 0: unknown
  double through_water_m_s = 0.0;      // [m/s] estimated speed ahead
  NoWayCause cause = NoWayCause::kUnknown;  // what keeps it, where something else knows
};

class ProgressWatch {
 public:
  explicit ProgressWatch(const ProgressWatchOptions& options) noexcept : options_{options} {}

  void start(Time now) noexcept;
  // At another speed [m/s] through the water from here on.
  void sail_at(double speed_m_s) noexcept {
    options_.least_way_m = least_way_m(options_, speed_m_s);
  }
  // Gives the cause as soon as no way was made for the patience, kNone while some is made.
  NoWayCause update(Time now, const ProgressSample& sample) noexcept;

  // Since when no way has been made; meaningful while the last update gave a cause.
  [[nodiscard]] Time since() const noexcept { return since_; }

 private:
  [[nodiscard]] NoWayCause cause_of(const ProgressSample& sample, Duration time) const noexcept;
  void begin_anew(Time now, const ProgressSample& sample) noexcept;

  ProgressWatchOptions options_;
  Time since_{};              // the last time that way had been made
  double made_good_m_ = 0.0;  // along the courses wanted, since then
  double through_water_m_ = 0.0;
  std::optional<WorldPoint> began_at_;
  std::optional<WorldPoint> last_position_;
  Time last_{};
  bool stands_ = false;  // for it does not see
};

}  // namespace lodesman
