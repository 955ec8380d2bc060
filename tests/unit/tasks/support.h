// SPDX-License-Identifier: Apache-2.0
// Devices that do as a test tells them, and a blackboard to look at.
#pragma once

#include <deque>
#include <limits>
#include <memory>
#include <vector>

#include "drivers/hal/devices.h"
#include "mid_level/blackboard/blackboard.h"

namespace lodesman::testing {

using std::chrono::milliseconds;
using std::chrono::seconds;

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
inline constexpr Time kStart{seconds{100}};

// Gives its readings one a poll, then nothing new.
template <class Contract, class Sample>
class ScriptedSensor final : public Contract {
 public:
  [[nodiscard]] Reading<Sample> poll(Time /*now*/) noexcept override {
    if (readings.empty()) {
      return {};
    }
    const Reading<Sample> reading = readings.front();
    readings.pop_front();
    return reading;
  }
  void give(const Sample& sample) { readings.push_back({ReadStatus::kFresh, sample}); }
  void give(ReadStatus status) { readings.push_back({status, {}}); }

  std::deque<Reading<Sample>> readings;
};

using ScriptedHeading = ScriptedSensor<HeadingSensor, Attitude>;
using ScriptedPosition = ScriptedSensor<PositionSensor, PositionFix>;

// Gives its next ping, or says what is wrong.
class ScriptedSonar final : public ImagingSonar {
 public:
  [[nodiscard]] ReadStatus poll(Time now, SonarPing& out) noexcept override {
    if (status != ReadStatus::kFresh) {
      return status;
    }
    out.number = ++number;
    out.captured = now;
    out.range_m = 30.0;
    out.make_image(2, 2, 2.0);
    if (profile_m > 0.0) {
      out.kind = PingKind::kProfile;
      out.bins = out.echo_count = 0;
      out.point_count = 2;
      out.points[0].range_m = out.points[1].range_m = profile_m;
    }
    return ReadStatus::kFresh;
  }

  ReadStatus status = ReadStatus::kFresh;
  std::uint64_t number = 0;
  double profile_m = 0.0;  // where above zero its pings are profiles, of returns at this range
};

// Notes what it is commanded, and takes it or not.
class ScriptedThrusters final : public ThrusterPair {
 public:
  [[nodiscard]] CommandStatus command(ThrustCommand thrust, Time /*now*/) noexcept override {
    last = thrust;
    return status;
  }

  CommandStatus status = CommandStatus::kTaken;
  ThrustCommand last{1, 1};
};

// A mission of goals, the last one its goal, at 0.22 m/s.
[[nodiscard]] inline MissionDefinition mission_through(std::initializer_list<Goal> goals,
                                                       double goal_radius_m = 0.5,
                                                       std::uint64_t id = 1) {
  MissionDefinition mission;
  mission.id = id;
  mission.speed_m_s = 0.22;
  mission.goal_radius_m = goal_radius_m;
  mission.link_lost_after = seconds{5};
  for (const Goal& goal : goals) {
    mission.goals[mission.goal_count++] = goal;
  }
  return mission;
}

// What has been published on a channel since the last look.
template <class T>
[[nodiscard]] std::vector<T> all_of(Reader<T>& reader) {
  std::vector<T> values;
  while (const auto* published = reader.next()) {
    values.push_back(published->value);
  }
  return values;
}

}  // namespace lodesman::testing
