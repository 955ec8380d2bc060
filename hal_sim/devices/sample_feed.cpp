// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/devices/sample_feed.h"

#include <utility>

namespace lodesman {
namespace {

// How many of the world's newest samples may be later than the poller's own `now`: the world's
// thread runs beside the poller's and may have woken just after it.
constexpr std::uint64_t kSamplesAhead_max = 4;

}  // namespace

SampleFeed::SampleFeed(const SimLink& link, SampleDue& due, Duration period, FaultSchedule faults)
    : world_{link.world}, due_{due}, period_{period}, faults_{std::move(faults)} {}

const WorldSample* SampleFeed::newest_not_after(Time now) noexcept {
  const std::uint64_t newest = world_.newest_sequence();
  for (std::uint64_t back = 0; back < kSamplesAhead_max && back < newest; ++back) {
    const Stamped<WorldSample>* sample = world_.at(newest - back);
    if (sample != nullptr && sample->value.stamp <= now) {
      return &sample->value;
    }
  }
  return nullptr;
}

SampleFeed::Due SampleFeed::poll(Time now) noexcept {
  const WorldSample* sample = newest_not_after(now);
  if (sample == nullptr) {
    return {};
  }
  const Fault fault = sample->started != 0 ? faults_.running(sample->scenario_time_s) : Fault{};
  if (fault.kind == FaultKind::kDisconnect) {
    return {ReadStatus::kDisconnected};
  }
  const bool due = !any_given_ || (sample->stamp > last_given_ &&
                                   sample->stamp + SampleDue::kEarly_max >= next_due_);
  if (!due || fault.kind == FaultKind::kStall) {
    return {};
  }
  // The sensor keeps its phase, unless it fell behind by more than a period.
  const bool behind = !any_given_ || sample->stamp >= next_due_ + period_;
  next_due_ = (behind ? sample->stamp : next_due_) + period_;
  due_.next_at(next_due_);
  last_given_ = sample->stamp;
  any_given_ = true;
  return {fault.kind == FaultKind::kCorrupt ? ReadStatus::kCorrupt : ReadStatus::kFresh, *sample,
          fault};
}

}  // namespace lodesman
