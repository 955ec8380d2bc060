// SPDX-License-Identifier: Apache-2.0
// The estimator task: where the vehicle is, from what its source of position gives, the AHRS's
// heading and the thrust that was applied. Source `gps` is the pose filter; `dead_reckoning` is eqs
// 15-25 of the paper, and `truth` the simulated world's word. It publishes nothing while its inputs
// are stale, and begins anew where what comes out is no estimate. It also fixes the origin of the
// world, once: as it is set, or at the first fixes that are believed (source `gps`). One that
// stands on the blackboard from such fixes is kept: this program may have been started again.
//
// A time that it did not step through, frozen or dead, it makes up for by what was applied and
// measured meanwhile; one that died leaves estimator_memory, and the next one goes on from there.
// The filter coasts on while the heading is stale. What is longer than kLongestGap is not bridged.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "high_level/estimate/dead_reckoning.h"
#include "high_level/estimate/drift.h"
#include "high_level/estimate/origin_search.h"
#include "high_level/estimate/pose_filter.h"
#include "high_level/estimate/surge.h"
#include "high_level/tasks/past_inputs.h"
#include "mid_level/base/geodesy.h"
#include "mid_level/runtime/task.h"

namespace lodesman {

struct EstimatorOptions {
  PositionSource source = PositionSource::kDeadReckoning;
  DeadReckoningOptions dead_reckoning;
  // Eqs 24-25: the speed is what SurgeRef holds at once. False: it follows as the filter's vehicle.
  bool surge_at_once = false;
  Duration current_time{};   // [0, 1000 s] in which a current is learnt; 0: none is looked for
  PoseFilterOptions filter;  // of source `gps`
  WorldPoint start;          // where dead reckoning starts
  VehiclePoint antenna;      // of the receiver
  std::optional<GeoPoint> origin{};  // of the world frame; empty: by the first fixes, as the search
                                     // finds them
  OriginSearchOptions origin_search;
};

class EstimatorTask final : public Task {
 public:
  static constexpr Duration kLongestGap = std::chrono::seconds{10};

  EstimatorTask(Blackboard& board, Role role, const EstimatorOptions& options);
  void step(Time now) noexcept override;
  [[nodiscard]] std::uint64_t refused() const noexcept override {
    return refused_by(attitude_, position_fix_, world_truth_, thrust_applied_);
  }
  [[nodiscard]] std::span<ChannelLook<>* const> inputs() noexcept override { return inputs_; }

 private:
  // What is reckoned with, at its beginning.
  void begin_anew() noexcept;
  // Publishes the origin that was known before any fix, and was not told yet.
  void tell_origin(Time now) noexcept;
  // Whether the world has its origin, with this fix.
  [[nodiscard]] bool has_origin(const PositionFix& fix, Heading heading, Time now) noexcept;
  // Goes on where one that was here before has left off, if that is not too long ago.
  void take_up(Time now) noexcept;
  // Through the time since the last step, where that is more than a period or two.
  void catch_up(Time now) noexcept;
  // Source `gps`.
  void step_filter(Time now, const Attitude& attitude, const ThrustApplied& applied) noexcept;
  void coast(Time now, const Stamped<ThrustApplied>* thrust) noexcept;
  void take_fixes(Time now, Heading heading) noexcept;
  // The others.
  void step_reckoning(Time now, const Attitude& attitude, int surge_ref) noexcept;
  void remember(const VehicleState& state, Time now) noexcept;
  // False when the source is silent.
  [[nodiscard]] bool update_position(Time now, Heading heading, int surge_ref) noexcept;
  void publish(const VehicleState& state, Time now) noexcept;

  EstimatorOptions options_;
  LocalFrame local_frame_;
  OriginSearch origin_search_;
  bool origin_is_told_ = false;
  DeadReckoning dead_reckoning_;
  Surge surge_;
  DriftEstimate drift_;
  PoseFilter filter_;
  Reader<Attitude> attitude_;
  Reader<PositionFix> position_fix_;
  Reader<WorldTruth> world_truth_;
  Reader<ThrustApplied> thrust_applied_;
  Writer<VehicleState> states_;
  Writer<WorldOrigin> origins_;
  Writer<EstimatorMemory> memories_;
  PastInputs past_;
  std::array<ChannelLook<>*, 6> inputs_{
      &past_.thrust_input(), &past_.attitude_input(), &world_truth_, &thrust_applied_, &attitude_,
      &position_fix_};
  // What one that was here before remembered; empty once it was taken up, or too old.
  std::optional<EstimatorMemory> legacy_;
  Time reckoned_to_{};  // by the other sources; 0: not yet
};

}  // namespace lodesman
