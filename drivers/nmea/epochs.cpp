// SPDX-License-Identifier: Apache-2.0
#include "drivers/nmea/epochs.h"

#include <algorithm>
#include <utility>

namespace lodesman::nmea {

void Epochs::restart() noexcept { *this = Epochs{}; }

Epoch& Epochs::epoch_of(Duration time_of_day, Time arrived) noexcept {
  if (open_ && open_->time_of_day == time_of_day) {
    return *open_;
  }
  if (open_) {
    const bool both = open_->rmc && open_->gga;
    lone_ = both ? 0 : std::min(lone_ + 1, kLone);
    if (!is_given_) {
      closed_ = open_;
    }
  }
  is_given_ = false;
  return open_.emplace(Epoch{time_of_day, arrived, {}, {}, {}});
}

bool Epochs::take(const Rmc& rmc, Time arrived) noexcept {
  if (rmc.time_of_day) {
    epoch_of(*rmc.time_of_day, arrived).rmc = rmc;
  }
  return rmc.time_of_day.has_value();
}

bool Epochs::take(const Gga& gga, Time arrived) noexcept {
  if (gga.time_of_day) {
    epoch_of(*gga.time_of_day, arrived).gga = gga;
  }
  return gga.time_of_day.has_value();
}

void Epochs::take(const Vtg& vtg, Time arrived) noexcept {
  vtg_ = vtg;
  vtg_arrived_ = arrived;
}

Epoch Epochs::with_vtg(Epoch epoch) const noexcept {
  if (vtg_ && std::chrono::abs(vtg_arrived_ - epoch.arrived) <= kVtgLasts) {
    epoch.vtg = vtg_;
  }
  return epoch;
}

std::optional<Epoch> Epochs::next(Time now) noexcept {
  if (closed_) {
    return with_vtg(*std::exchange(closed_, std::nullopt));
  }
  if (!open_ || is_given_) {
    return std::nullopt;
  }
  const bool both = open_->rmc && open_->gga;
  if (!both && lone_ < kLone && now - open_->arrived < kHold) {
    return std::nullopt;
  }
  is_given_ = true;
  return with_vtg(*open_);
}

}  // namespace lodesman::nmea
