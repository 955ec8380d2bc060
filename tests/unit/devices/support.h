// SPDX-License-Identifier: Apache-2.0
// A link into which a test writes the world's samples itself. One thread.
#pragma once

#include <memory>

#include "hal_sim/scenario/scenario.h"
#include "hal_sim/world/sim_link.h"

namespace lodesman::testing {

class HandWorld {
 public:
  [[nodiscard]] SimLink& link() noexcept { return *link_; }
  [[nodiscard]] Time now() const noexcept { return now_; }

  WorldSample state;  // what the next step publishes; it keeps time by itself

  // Moves on and publishes.
  void step(Duration dt = std::chrono::milliseconds{20}) {
    now_ += dt;
    state.stamp = now_;
    state.started = 1;
    state.scenario_time_s += to_seconds(dt);
    out_.publish(state, now_);
  }

 private:
  std::unique_ptr<SimLink> link_ = std::make_unique<SimLink>();
  Writer<WorldSample> out_{link_->world, Role::kLow, "world sample"};
  Time now_{std::chrono::seconds{50}};
};

}  // namespace lodesman::testing
