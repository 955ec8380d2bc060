// SPDX-License-Identifier: Apache-2.0
// What stands on a blackboard now, for whoever makes something to look at of it: the newest of each
// channel, and the plan before the newest. One thread; it writes nothing there.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "mid_level/blackboard/blackboard.h"

namespace lodesman::console {

// Each is null where nothing has come, or there is no boat. Good until the next look.
struct BoardPicture {
  Time now{};
  const Stamped<Attitude>* attitude = nullptr;
  const Stamped<PositionFix>* fix = nullptr;
  const Stamped<VehicleState>* state = nullptr;
  const Stamped<SonarPing>* ping = nullptr;
  const Stamped<SonarObstacles>* obstacles = nullptr;
  const Stamped<Coverage>* coverage = nullptr;
  const Stamped<Tracks>* tracks = nullptr;
  const Stamped<PathRequest>* request = nullptr;
  const Stamped<SonarPath>* path = nullptr;
  const Stamped<Plan>* plan = nullptr;
  const Stamped<Plan>* previous_plan = nullptr;  // with other waypoints than the newest
  const Stamped<MissionDefinition>* definition = nullptr;
  const Stamped<MissionStatus>* mission = nullptr;
  const Stamped<HelmCommand>* helm = nullptr;
  const Stamped<Tunables>* tunables = nullptr;
  const Stamped<ThrustStatus>* thrust_status = nullptr;
  const Stamped<ThrustApplied>* thrust = nullptr;
  const Stamped<GuardStatus>* guard = nullptr;
  const Stamped<BatteryStatus>* battery = nullptr;
  std::array<const Stamped<DeviceHealth>*, kDeviceCount> devices{};
  bool low_alive = false;
  bool high_alive = false;
};

// Since when it was measured or published; empty where nothing has come.
template <class T>
[[nodiscard]] std::optional<Duration> age_of(const Stamped<T>* value, Time now) noexcept {
  if (value == nullptr) {
    return std::nullopt;
  }
  Time measured = value->stamp;
  if constexpr (HasMeasuredAt<T>) {
    measured = value->value.measured_at();
  }
  return now > measured ? now - measured : Duration{};
}

// Whether it is there, and no older than that.
template <class T>
[[nodiscard]] bool is_fresh(const Stamped<T>* value, Time now, Duration max_age) noexcept {
  const auto age = age_of(value, now);
  return age && *age <= max_age;
}

class BoardReaders {
 public:
  // `board` must outlive it.
  explicit BoardReaders(const Blackboard& board);
  BoardReaders(const BoardReaders&) = delete;
  BoardReaders& operator=(const BoardReaders&) = delete;
  ~BoardReaders();

  // All but who is alive.
  [[nodiscard]] BoardPicture look(Time now);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lodesman::console
