// SPDX-License-Identifier: Apache-2.0
// The walk that calibrates a boat by the stick alone: two pushes that tell how the thrusters are
// connected, then runs there and back, each at another SurgeRef. Bounded in time and in room. One
// thread; what it does is decided by what it is shown, so that a test can sail it in no time.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "deploy/operator/calibrate/speed_runs.h"
#include "deploy/operator/calibrate/wiring.h"

namespace lodesman::cli {

// What is known of the boat at a time.
struct Sighting {
  double time_s = 0.0;
  double heading_rad = 0.0;  // as the sensor says
  double x_m = 0.0;          // of the newest fix, east and north of some place
  double y_m = 0.0;
  double fixed_s = 0.0;  // the time of that fix
};

struct WalkOptions {
  std::vector<int> surge_refs{16, 31, 57, 91};
  double leg_s = 20.0;    // longest run
  double settle_s = 8.0;  // before its speed counts
  double room_m = 25.0;   // from where it begins; half as much again ends the walk
  double time_limit_s = 900.0;
  int push = 40;  // of the stick, to find out about the thrusters
};

struct WalkResult {
  std::string fault;  // why it ended early; empty where it did not
  std::optional<Wiring> wiring;
  Calibration calibration;
};

class Walk {
 public:
  // Puts the stick there and lets a moment pass; nothing: the walk has to end, as `why_ended` says.
  using Steer = std::function<std::optional<Sighting>(Stick)>;
  using Say = std::function<void(const std::string&)>;

  Walk(WalkOptions options, Steer steer, Say say);

  // Ends with the stick at rest, unless it could not be moved any more.
  [[nodiscard]] WalkResult sail();

 private:
  enum class End { kDone, kStopped, kTime, kRoom };

  [[nodiscard]] bool step(Stick wished);
  [[nodiscard]] bool rest(double for_s);
  [[nodiscard]] std::optional<Answer> push(Stick stick);
  [[nodiscard]] bool turn_to(double heading_rad);
  [[nodiscard]] std::optional<StraightRun> run(int surge_ref, double heading_rad);
  [[nodiscard]] bool find_wiring(WalkResult& result);
  [[nodiscard]] bool run_pairs(WalkResult& result);
  [[nodiscard]] int head_to(double heading_rad) const;
  [[nodiscard]] double from_start_m() const;
  [[nodiscard]] std::string reason() const;

  WalkOptions options_;
  Steer steer_;
  Say say_;
  Wiring wiring_;
  Sighting seen_;
  Sighting start_;
  End end_ = End::kDone;
};

}  // namespace lodesman::cli
