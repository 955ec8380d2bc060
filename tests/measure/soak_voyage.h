// SPDX-License-Identifier: Apache-2.0
// A voyage without end, made from a seed: one mission after the other, obstacles that come and go,
// and now and then a fault of a device, of every kind that there is. Pure.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hal_sim/scenario/scenario.h"

namespace lodesman::measure {

// [s] scenario time that each mission has; then comes the next one, reached or not.
inline constexpr double kLeg_s = 150.0;

struct SoakLeg {
  Goal goal;
  double speed_m_s = 0.0;
  std::optional<Fault> fault;
};

struct SoakVoyage {
  Scenario scenario;  // its own mission is the first leg
  std::vector<SoakLeg> legs;
};

[[nodiscard]] SoakVoyage make_soak_voyage(std::uint64_t seed, std::size_t legs,
                                          const SpeedTable& speeds);

// As the text of a mission file.
[[nodiscard]] std::string mission_text(const SoakLeg& leg);

}  // namespace lodesman::measure
