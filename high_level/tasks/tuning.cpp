// SPDX-License-Identifier: Apache-2.0
#include "high_level/tasks/tuning.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "mid_level/base/short_number.h"

namespace lodesman {
namespace {

using nlohmann::ordered_json;

// What may be tuned: its key in the configuration, its member, and what it may be.
struct Tunable {
  const char* key;
  double Tunables::*member;
  double least;
  double most;
};
constexpr std::array<Tunable, 5> kTunables{{
    {"mission.speed_limit_m_s", &Tunables::speed_limit_m_s, 0.01, 10.0},
    {"zones.margin_m", &Tunables::margin_m, 0.0, 20.0},
    {"pilot.side_gain_m", &Tunables::side_gain_m, 0.0, 100.0},
    {"pilot.manoeuvre_gain_s", &Tunables::manoeuvre_gain_s, 0.0, 100.0},
    {"control.heading_gain_per_deg", &Tunables::heading_gain_per_deg, 0.01, 100.0},
}};

}  // namespace

ordered_json json_of(const Tunables& tunables) {
  ordered_json json{{"version", tunables.version}};
  for (const Tunable& tunable : kTunables) {
    json[tunable.key] = tunables.*tunable.member;
  }
  return json;
}

std::string tune_by(const std::map<std::string, double>& settings, double least_margin_m,
                    Tunables& tunables) {
  for (const auto& setting : settings) {
    const std::string& key = setting.first;
    const double value = setting.second;
    const auto* tunable = std::find_if(kTunables.begin(), kTunables.end(),
                                       [&](const Tunable& t) { return t.key == key; });
    if (tunable == kTunables.end()) {
      return key + ": may not be changed under way";
    }
    const double least = tunable->member == &Tunables::margin_m ? least_margin_m : tunable->least;
    if (!(value >= least && value <= tunable->most)) {
      return key + ": must be from " + short_number(least) + " to " + short_number(tunable->most);
    }
    tunables.*tunable->member = value;
  }
  return {};
}

std::optional<Tunables> tunables_left(const Blackboard& board) {
  Reader<MissionStatus> missions{board.mission_status};
  Reader<Tunables> tunables{board.tunables};
  const auto* mission = missions.latest();
  const auto* last = tunables.latest();
  const bool goes_on = mission != nullptr && (mission->value.state == MissionState::kUnderWay ||
                                              mission->value.state == MissionState::kHolding);
  return goes_on && last != nullptr ? std::optional{last->value} : std::nullopt;
}

}  // namespace lodesman
