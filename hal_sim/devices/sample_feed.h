// SPDX-License-Identifier: Apache-2.0
// What every simulated sensor is built on: the newest state of the world at the sensor's own rate,
// with the scenario's faults. Owned by the sensor, and so by the one thread that polls it.
#pragma once

#include "drivers/hal/reading.h"
#include "hal_sim/scenario/fault.h"
#include "hal_sim/world/sim_link.h"

namespace lodesman {

class SampleFeed {
 public:
  // Link and due time, which is of the link, must outlive the feed.
  SampleFeed(const SimLink& link, SampleDue& due, Duration period, FaultSchedule faults);

  struct Due {
    ReadStatus status = ReadStatus::kNothingNew;
    WorldSample sample{};  // valid when kFresh; the state that was lost when kCorrupt
    Fault fault{};         // that runs: what is fresh may have to be altered by it
  };
  // kFresh or kCorrupt once a period; otherwise kNothingNew or, at every poll, kDisconnected.
  [[nodiscard]] Due poll(Time now) noexcept;

 private:
  [[nodiscard]] const WorldSample* newest_not_after(Time now) noexcept;

  Reader<WorldSample> world_;
  SampleDue& due_;
  Duration period_;
  FaultSchedule faults_;
  bool any_given_ = false;
  Time last_given_{};
  Time next_due_{};
};

}  // namespace lodesman
