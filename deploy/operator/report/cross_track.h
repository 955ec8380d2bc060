// SPDX-License-Identifier: Apache-2.0
// How well a vehicle kept to the lines that its mission asked for. Plain values; one thread.
#pragma once

#include <cstdint>
#include <optional>

#include "mid_level/messages/command.h"
#include "mid_level/messages/vehicle.h"

namespace lodesman::cli {

// Off the line, root mean square and worst: everywhere, and where it had sailed so far along it
// that the turn into it is over.
struct CrossTrack {
  double rms_m = 0.0;
  double worst_m = 0.0;
  double settled_rms_m = 0.0;
  double settled_worst_m = 0.0;
};

class CrossTrackMeter {
 public:
  static constexpr double kSettled_m = 10.0;  // along the line

  // To be called at even intervals of time. Nothing is counted where no line is kept.
  void add(const MissionStatus& status, const WorldTruth& truth) noexcept;
  // Nothing where no line was kept.
  [[nodiscard]] std::optional<CrossTrack> seen() const noexcept;

 private:
  struct Sum {
    std::uint64_t count = 0;
    double squared_m2 = 0.0;
    double worst_m = 0.0;
    void add(double off_m) noexcept;
    [[nodiscard]] double rms_m() const noexcept;
  };
  Sum all_;
  Sum settled_;
};

}  // namespace lodesman::cli
