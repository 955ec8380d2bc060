// SPDX-License-Identifier: Apache-2.0
// A mission's fence and keep-out areas as what the pilot keeps clear of: walls. Pure functions; any
// thread.
#pragma once

#include <span>

#include "mid_level/base/frames.h"
#include "mid_level/messages/mission.h"
#include "mid_level/messages/tracks.h"
#include "mid_level/messages/vehicle.h"

namespace lodesman {

// Ids of areas begin here: no tracker counts so far.
inline constexpr std::uint32_t kFirstAreaId = 1'000'000'000;

// Those of a mission.
[[nodiscard]] inline std::span<const MissionArea> areas_of(
    const MissionDefinition& mission) noexcept {
  return {mission.areas.data(), mission.area_count};
}

// Adds them to what is known of the water, as seen at `now` and at rest; places in the world, which
// are as doubtful from the vehicle as its own. Where there is not room
// for all, the tracks that stand last give way, and are counted as dropped.
void add_areas(std::span<const MissionArea> areas, Time now, const VehicleState& own,
               Tracks& water) noexcept;

// Whether a place may be sailed to: inside the fence, outside every keep-out area.
[[nodiscard]] bool allows(const MissionArea& area, const WorldPoint& place) noexcept;

}  // namespace lodesman
