// SPDX-License-Identifier: Apache-2.0
// The estimator task: where the vehicle is, from what its source of position gives and the AHRS's
// heading. It publishes nothing while its inputs are stale, and begins anew where what comes out is
// no estimate.
#pragma once

#include <cstdint>

#include "high_level/estimate/dead_reckoning.h"
#include "high_level/estimate/drift.h"
#include "high_level/estimate/lag.h"
#include "mid_level/base/geodesy.h"
#include "mid_level/runtime/task.h"

namespace lodesman {

struct EstimatorOptions {
  PositionSource source = PositionSource::kDeadReckoning;
  DeadReckoningOptions dead_reckoning;
  Duration surge_lag{};         // [0, 100 s] of the speed behind SurgeRef; the paper knows none
  Duration current_time{};      // [0, 1000 s] in which a current is learnt; 0: none is looked for
  double gps_correction = 0.0;  // [-] (0, 1] share of the way to each fix
  WorldPoint start;             // where dead reckoning starts
  GeoPoint origin;              // of the world frame
  VehiclePoint antenna;         // of the receiver
};

class EstimatorTask final : public Task {
 public:
  EstimatorTask(Blackboard& board, Role role, const EstimatorOptions& options);
  void step(Time now) noexcept override;
  [[nodiscard]] std::uint64_t refused() const noexcept override {
    return refused_by(attitude_, position_fix_, world_truth_, thrust_applied_);
  }

 private:
  // What is reckoned with, at its beginning.
  void begin_anew() noexcept;
  // False when the source is silent.
  [[nodiscard]] bool update_position(Time now, Heading heading, int surge_ref) noexcept;

  EstimatorOptions options_;
  LocalFrame local_frame_;
  DeadReckoning dead_reckoning_;
  Lag surge_;
  DriftEstimate drift_;
  Reader<Attitude> attitude_;
  Reader<PositionFix> position_fix_;
  Reader<WorldTruth> world_truth_;
  Reader<ThrustApplied> thrust_applied_;
  Writer<VehicleState> states_;
  std::uint64_t used_fix_ = 0;
  bool has_fix_ = false;
};

}  // namespace lodesman
