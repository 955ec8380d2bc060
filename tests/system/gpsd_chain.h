// SPDX-License-Identifier: Apache-2.0
// What a boat makes of a gpsd: driver, position task, estimator and operator's desk on one
// blackboard, in one thread.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "deploy/boat/configuration.h"
#include "drivers/gpsd/gpsd_receiver.h"
#include "drivers/stream/make_line.h"
#include "high_level/tasks/estimator.h"
#include "high_level/tasks/operator_desk.h"
#include "low_level/tasks/sensors.h"
#include "mid_level/base/clock.h"
#include "tests/support/catch.h"

namespace lodesman::testing {

inline constexpr double kPerSurgeRef_m_s = 0.03;  // recorded boats are faster than ours

[[nodiscard]] inline EstimatorOptions estimator_options() {
  const BoatConfig config = load_configuration("default", {});
  EstimatorOptions options = config.high.estimator;
  options.source = PositionSource::kGps;
  options.filter.speeds = SpeedTable::proportional(kPerSurgeRef_m_s);
  return options;
}

// The receiver's course stands for the AHRS, and its speed for the thrust that holds it.
class Chain {
 public:
  explicit Chain(const std::string& port) : line_{make_tcp_line("127.0.0.1:" + port)} {}

  void step() {
    const Time now = SteadyClock{}.now();
    position_.step(now);
    while (const auto* fix = fixes_.next()) {
      CHECK(fix->value.measured > last.measured);
      last = fix->value;
      given.push_back(last);
    }
    if (last.measured == Time{} || now - stepped_ < std::chrono::milliseconds{50}) {
      return;
    }
    stepped_ = now;
    attitudes_.publish({now, last.course_rad, 0.0}, now);
    ThrustApplied applied;
    applied.reason = ThrustReason::kCommanded;
    applied.surge_ref =
        std::min(100, static_cast<int>(std::lround(last.speed_m_s / kPerSurgeRef_m_s)));
    thrusts_.publish(applied, now);
    estimator_.step(now);
    while (const auto* state = states_.next()) {
      estimate = state->value;
    }
  }
  // What `lodesman status` says.
  [[nodiscard]] nlohmann::json status() {
    CommandRequest request;
    request.command = "status";
    request.scope = Scope::kCommand;
    return nlohmann::json::parse(desk_.answer(request)().value());
  }
  [[nodiscard]] nlohmann::json receiver() { return status()["devices"]["position"]; }
  [[nodiscard]] std::optional<WorldOrigin> origin() {
    const auto* told = origins_.latest();
    return told != nullptr ? std::optional{told->value} : std::nullopt;
  }
  [[nodiscard]] bool estimates() const {
    return SteadyClock{}.now() - estimate.valid_at < std::chrono::milliseconds{500};
  }

  PositionFix last;
  std::vector<PositionFix> given;
  VehicleState estimate;

 private:
  std::unique_ptr<Blackboard> board_ = std::make_unique<Blackboard>();
  std::unique_ptr<ByteStream> line_;
  GpsdReceiver driver_{*line_, GpsdOptions{}};
  PositionTask position_{*board_, Role::kLow, &driver_};
  EstimatorTask estimator_{*board_, Role::kHigh, estimator_options()};
  OperatorDesk desk_{*board_, Role::kHigh, DeskOptions{}, [] { return SteadyClock{}.now(); }};
  Writer<Attitude> attitudes_{board_->attitude, Role::kLow, "attitude"};
  Writer<ThrustApplied> thrusts_{board_->thrust_applied, Role::kLow, "thrust_applied"};
  Reader<PositionFix> fixes_{board_->position_fix};
  Reader<VehicleState> states_{board_->vehicle_state};
  Reader<WorldOrigin> origins_{board_->world_origin};
  Time stepped_{};
};

}  // namespace lodesman::testing
