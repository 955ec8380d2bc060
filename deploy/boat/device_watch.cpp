// SPDX-License-Identifier: Apache-2.0
#include "deploy/boat/device_watch.h"

#include <fmt/chrono.h>
#include <spdlog/spdlog.h>

#include <cmath>
#include <ctime>

#include "deploy/boat/log.h"

namespace lodesman {
namespace {

// What is ill for less than this is counted and not told.
constexpr Duration kPatience = std::chrono::milliseconds{400};

constexpr std::int64_t kSecond_ns = 1'000'000'000;
// What a receiver, a line and a loaded machine may come to.
constexpr double kClockTolerance_s = 2.0;

[[nodiscard]] bool is_well(DeviceStatus status) noexcept {
  return status == DeviceStatus::kWorking || status == DeviceStatus::kAbsent;
}

}  // namespace

DeviceWatch::DeviceWatch(const Blackboard& board, const DeviceAddresses& addresses)
    : addresses_{addresses.heading, addresses.sonar, addresses.position, addresses.thrusters},
      devices_{Reader<DeviceHealth>{board.device_health[0]},
               Reader<DeviceHealth>{board.device_health[1]},
               Reader<DeviceHealth>{board.device_health[2]},
               Reader<DeviceHealth>{board.device_health[3]}},
      arming_{board.thrust_status},
      battery_{board.battery_status},
      guard_{board.guard_status},
      fixes_{board.position_fix} {}

void DeviceWatch::say_news(Time now) {
  for (std::size_t i = 0; i < kDeviceCount; ++i) {
    look_at(static_cast<DeviceId>(i), now);
  }
  look_at_arming();
  look_at_guard();
  look_at_clock();
}

void DeviceWatch::look_at(DeviceId id, Time now) {
  const auto i = static_cast<std::size_t>(id);
  const auto* newest = devices_[i].latest();
  if (newest == nullptr) {
    return;
  }
  const DeviceHealth& health = newest->value;
  Told& told = told_[i];
  const bool is_news = health.status != told.status || health.fault != told.fault;
  const bool lasts = now - health.since >= kPatience || is_well(health.status);
  if (!is_news || !lasts) {
    return;
  }
  const bool was_ill = !is_well(told.status) || told.fault != DeviceFault::kNone;
  const bool is_ill = !is_well(health.status) || health.fault != DeviceFault::kNone;
  if (is_ill || was_ill) {
    const char* why = describe(health.fault);
    const std::array fields{JournalField{"LODESMAN_DEVICE", to_string(id)},
                            JournalField{"LODESMAN_ADDRESS", addresses_[i]},
                            JournalField{"LODESMAN_STATUS", to_string(health.status)},
                            JournalField{"LODESMAN_FAULT", to_string(health.fault)}};
    log_with_fields(is_ill ? LineLevel::kWarning : LineLevel::kInfo,
                    fmt::format("{} ({}): {}{}{}", to_string(id), addresses_[i],
                                to_string(health.status), why[0] != '\0' ? ": " : "", why),
                    fields);
  }
  told = {health.status, health.fault};
}

// The boat's own times are of no date; this line is what joins them to one.
void DeviceWatch::look_at_clock() {
  const auto* fix = fixes_.latest();
  if (has_told_utc_ || fix == nullptr || fix->value.utc_ns == 0) {
    return;
  }
  has_told_utc_ = true;
  timespec machine{};
  clock_gettime(CLOCK_REALTIME, &machine);
  const std::int64_t machine_ns = machine.tv_sec * kSecond_ns + machine.tv_nsec;
  const double ahead_s = to_seconds(Duration{machine_ns - fix->value.utc_ns});
  const auto utc_s = static_cast<std::time_t>(fix->value.utc_ns / kSecond_ns);
  const double boat_s = to_seconds(fix->value.measured - Time{});
  const std::string told = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(utc_s));
  if (std::abs(ahead_s) <= kClockTolerance_s) {
    spdlog::info("{} by the receiver at {:.3f} s of the boat's clock", told, boat_s);
  } else {
    spdlog::warn("{} by the receiver at {:.3f} s of the boat's clock; this machine is {:.0f} s {}",
                 told, boat_s, std::abs(ahead_s), ahead_s > 0.0 ? "ahead" : "behind");
  }
}

// A trip is told once, however short it was, and so is that it sees nothing.
void DeviceWatch::look_at_guard() {
  const auto* newest = guard_.latest();
  if (newest == nullptr) {
    return;
  }
  const GuardStatus& guard = newest->value;
  if (guard.trips > told_trips_) {
    spdlog::warn(
        "guard: stopped at {:.2f} m/s ({}{})", guard.trip_speed_m_s, to_string(guard.reason),
        guard.reason == GuardReason::kObstacle ? fmt::format(", {:.2f} m off", guard.distance_m)
                                               : "");
  }
  told_trips_ = guard.trips;
  const bool is_blind = guard.state == GuardState::kBlind;
  if (is_blind != (told_guard_ == GuardState::kBlind)) {
    spdlog::warn("guard: {}", is_blind ? "blind, there is no sonar frame" : "sees again");
  }
  told_guard_ = guard.state;
}

void DeviceWatch::look_at_arming() {
  if (const auto* status = arming_.latest();
      status != nullptr && status->value.state != told_state_) {
    told_state_ = status->value.state;
    spdlog::warn("thrusters: {} ({})", to_string(told_state_), to_string(status->value.cause));
  }
  if (const auto* battery = battery_.latest();
      battery != nullptr && battery->value.level != told_level_) {
    told_level_ = battery->value.level;
    spdlog::warn("battery: {}, {:.1f} V", to_string(told_level_), battery->value.volts);
  }
}

}  // namespace lodesman
