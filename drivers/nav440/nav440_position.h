// SPDX-License-Identifier: Apache-2.0
// The position that a NAV440 gives beside its heading: what a Nav440 put into the relay that both
// hold. Polled by one thread, which need not be the Nav440's. As fresh as the Nav440 is polled; one
// that is no more polled falls silent.
#pragma once

#include "drivers/hal/devices.h"
#include "drivers/nav440/fix_relay.h"

namespace lodesman {

class Nav440Position final : public PositionSensor {
 public:
  // The relay must outlive it.
  explicit Nav440Position(Nav440FixRelay& relay) noexcept : relay_{relay} {}

  [[nodiscard]] Reading<PositionFix> poll(Time /*now*/) noexcept override {
    if (const std::optional<PositionFix> fix = relay_.pop()) {
      return {ReadStatus::kFresh, *fix};
    }
    const Nav440FixRelay::State state = relay_.state();
    const bool is_gone = !state.is_connected && state.fault != DeviceFault::kNone;
    return {is_gone ? ReadStatus::kDisconnected : ReadStatus::kNothingNew, {}};
  }
  [[nodiscard]] DeviceFault fault() const noexcept override { return relay_.state().fault; }

 private:
  Nav440FixRelay& relay_;
};

}  // namespace lodesman
