// SPDX-License-Identifier: Apache-2.0
#include "mid_level/config/read_speed_table.h"

namespace lodesman {

SpeedTable read_speed_table(const TomlTable& vehicle) {
  constexpr const char* kKey = "speed_table";
  constexpr double kMaxSpeed_m_s = 10.0;
  std::vector<SpeedPoint> points;
  SpeedPoint before;
  for (const auto& [surge_ref, speed_m_s] :
       vehicle.pairs(kKey, Range::above(0.0, kMaxSurgeRef), 1, SpeedTable::kMaxPoints)) {
    if (speed_m_s > kMaxSpeed_m_s) {
      vehicle.refuse(kKey, "a speed must be at most 10 m/s");
    }
    if (!(surge_ref > before.surge_ref && speed_m_s > before.speed_m_s)) {
      vehicle.refuse(kKey, "each point must have more SurgeRef and more speed than the one before");
    }
    before = {surge_ref, speed_m_s};
    points.push_back(before);
  }
  return SpeedTable{points};
}

}  // namespace lodesman
