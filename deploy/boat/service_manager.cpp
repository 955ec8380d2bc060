// SPDX-License-Identifier: Apache-2.0
#include "deploy/boat/service_manager.h"

#include <systemd/sd-daemon.h>

#include <cstdint>

#include "mid_level/runtime/health_watch.h"

namespace lodesman {
namespace {

constexpr Duration kStatusPeriod = std::chrono::seconds{1};
// sd_watchdog_enabled(3) asks for two; two more may be late.
constexpr int kLivesAPeriod = 4;

// What cannot be told is not told: there is nobody to say it to.
void notify(const std::string& text) { static_cast<void>(sd_notify(0, text.c_str())); }

}  // namespace

ServiceManager::ServiceManager() {
  std::uint64_t watchdog_us = 0;
  if (sd_watchdog_enabled(0, &watchdog_us) > 0) {
    life_period_ = std::chrono::microseconds{watchdog_us} / kLivesAPeriod;
  }
}

void ServiceManager::look(HealthWatch& health, Time now,
                          const std::function<std::string()>& status) {
  if (phase_ == Phase::kStarting && health.all_step(now)) {
    phase_ = Phase::kReady;
    notify("READY=1");
  }
  if (phase_ == Phase::kReady && health.silent(now).empty()) {
    tell_life(now);
  }
  if (now >= status_due_) {
    status_due_ = now + kStatusPeriod;
    tell_status(status());
  }
}

void ServiceManager::wait(Time now, const std::string& status) {
  tell_life(now);
  tell_status(status);
}

void ServiceManager::stopping() {
  phase_ = Phase::kStopping;
  notify("STOPPING=1");
}

void ServiceManager::tell_life(Time now) {
  if (life_period_ > Duration::zero() && now >= life_due_) {
    life_due_ = now + life_period_;
    notify("WATCHDOG=1");
  }
}

void ServiceManager::tell_status(const std::string& status) {
  if (status != told_) {
    told_ = status;
    notify("STATUS=" + status);
  }
}

}  // namespace lodesman
