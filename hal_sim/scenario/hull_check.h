// SPDX-License-Identifier: Apache-2.0
// Whether a hull's values can be those of a boat at all: units and signs that were mistaken, a mass
// matrix that is not positive definite, a straight course that is not held. Pure functions.
#pragma once

#include <optional>

#include "hal_sim/scenario/vessel_parameters.h"

namespace lodesman {

// Sway and yaw about a straight course at a surge speed ahead, linearised:
// M d/dt (v, r) + D (v, r) = 0 (Fossen, 2nd ed., ch. 7, with the Munk moment and lift).
struct SwayYaw {
  double mass_kg = 0.0;             // M11
  double coupling_kg_m = 0.0;       // M12 = M21
  double inertia_kg_m2 = 0.0;       // M22
  double sway_by_sway_kg_s = 0.0;   // D11
  double sway_by_yaw_kg_m_s = 0.0;  // D12
  double yaw_by_sway_kg_m_s = 0.0;  // D21
  double yaw_by_yaw_kg_m2_s = 0.0;  // D22

  // Both roots decay.
  [[nodiscard]] bool is_stable() const noexcept;
};

[[nodiscard]] SwayYaw linearised(const VesselParameters& hull, double surge_m_s,
                                 bool lift) noexcept;

// The least speed ahead, up to that of SurgeRef 100, at which the hull does not hold a straight
// course.
[[nodiscard]] std::optional<double> unstable_from_m_s(const VesselParameters& hull,
                                                      bool lift) noexcept;

// Refuses by key what cannot be. `vessel`: where the values were read. Throws StartupError.
void require_sound_hull(const TomlTable& vessel, const VesselParameters& hull);

}  // namespace lodesman
