// SPDX-License-Identifier: Apache-2.0
#include "high_level/guidance/current.h"

#include <algorithm>
#include <cmath>

namespace lodesman {

Eigen::Vector2d velocity_for_course(const Eigen::Vector2d& direction, double speed_m_s,
                                    const Eigen::Vector2d& current_m_s) noexcept {
  const Eigen::Vector2d starboard{direction.y(), -direction.x()};
  const double against_m_s = std::clamp(-current_m_s.dot(starboard), -speed_m_s, speed_m_s);
  const double along_m_s = std::sqrt(speed_m_s * speed_m_s - against_m_s * against_m_s);
  return along_m_s * direction + against_m_s * starboard;
}

}  // namespace lodesman
