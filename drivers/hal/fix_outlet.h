// SPDX-License-Identifier: Apache-2.0
// Where a receiver's driver leaves what its next poll gives: a fix, or that what came was corrupt,
// and what ails the receiver. It asks of each fix what every driver has to: whether its date can
// be, and whether its place is frozen. One object a driver, on its thread; nothing allocates.
#pragma once

#include <cstdint>
#include <optional>

#include "drivers/hal/fix_check.h"
#include "drivers/hal/reading.h"
#include "mid_level/messages/health.h"
#include "mid_level/messages/vehicle.h"

namespace lodesman {

struct FixOutletCounts {
  std::uint64_t fixes = 0;        // [-] given
  std::uint64_t frozen = 0;       // [-] refused
  std::uint64_t wrong_dates = 0;  // [-] fixes whose date cannot be; given, without UTC
};

class FixOutlet {
 public:
  // Nothing of one connection is given on the next.
  void restart() noexcept;

  // utc_ns: [ns] since 1970 by the receiver, empty where it does not say.
  void offer(PositionFix fix, std::optional<std::int64_t> utc_ns) noexcept;
  // What came is whole and cannot be: counted there.
  void refuse(std::uint64_t& count, DeviceFault why) noexcept;
  // What came fails its check.
  void damaged() noexcept { is_corrupt_ = true; }
  void ails(DeviceFault fault) noexcept { ails_ = fault; }

  [[nodiscard]] bool has_fix() const noexcept { return ready_.has_value(); }
  // Once: corrupt before a fix, so that neither is lost.
  [[nodiscard]] Reading<PositionFix> take() noexcept;
  [[nodiscard]] DeviceFault fault() const noexcept { return ails_; }
  [[nodiscard]] const FixOutletCounts& counts() const noexcept { return counts_; }

 private:
  FrozenPosition frozen_;
  std::optional<PositionFix> ready_;
  bool is_corrupt_ = false;
  DeviceFault ails_ = DeviceFault::kNone;
  FixOutletCounts counts_;
};

}  // namespace lodesman
