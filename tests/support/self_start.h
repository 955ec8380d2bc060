// SPDX-License-Identifier: Apache-2.0
// Starts the mission of a scenario through the operator's desk, as every simulation does. One
// thread.
#pragma once

#include "deploy/boat/voyage.h"
#include "mid_level/base/clock.h"

namespace lodesman::testing {

class SelfStart {
 public:
  SelfStart(Blackboard& board, const BoatConfig& config, const Scenario& scenario,
            OperatorDesk::Now now)
      : desk_{board, Role::kHigh, starting(desk_options(config, voyage_of(config, &scenario))),
              std::move(now)} {}
  void look() { desk_.look(); }

 private:
  [[nodiscard]] static DeskOptions starting(DeskOptions options) {
    options.starts_by_itself = true;
    return options;
  }

  OperatorDesk desk_;
};

}  // namespace lodesman::testing
