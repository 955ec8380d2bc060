// SPDX-License-Identifier: Apache-2.0
#include "drivers/hal/fix_outlet.h"

#include <utility>

namespace lodesman {

void FixOutlet::restart() noexcept {
  ready_.reset();
  is_corrupt_ = false;
  ails_ = DeviceFault::kNone;
}

void FixOutlet::offer(PositionFix fix, std::optional<std::int64_t> utc_ns) noexcept {
  const bool wrong_date = utc_ns && !is_plausible_utc(*utc_ns);
  counts_.wrong_dates += wrong_date ? 1U : 0U;
  fix.utc_ns = utc_ns && !wrong_date ? *utc_ns : 0;
  if (frozen_.frozen(fix)) {
    refuse(counts_.frozen, DeviceFault::kFrozen);
    return;
  }
  ails_ = wrong_date ? DeviceFault::kWrongDate : DeviceFault::kNone;
  ready_ = fix;
}

void FixOutlet::refuse(std::uint64_t& count, DeviceFault why) noexcept {
  ++count;
  is_corrupt_ = true;
  ails_ = why;
}

Reading<PositionFix> FixOutlet::take() noexcept {
  if (std::exchange(is_corrupt_, false)) {
    return {ReadStatus::kCorrupt, {}};
  }
  if (!ready_) {
    return {ReadStatus::kNothingNew, {}};
  }
  ++counts_.fixes;
  return {ReadStatus::kFresh, *std::exchange(ready_, std::nullopt)};
}

}  // namespace lodesman
