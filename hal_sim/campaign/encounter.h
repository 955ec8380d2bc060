// SPDX-License-Identifier: Apache-2.0
// Random encounters: scenarios made from a number, so that a campaign can sail through thousands
// and any one of them can be sailed again by its name, encounter:NUMBER. Pure; any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace lodesman {

// The text of a scenario file: 1 to 8 circles and ellipses on the way to a goal about 20 m ahead,
// about half of them moving so that they come near when the vehicle does, at one of four vehicle
// speeds. Nothing lies closer to the start than 4 m at first, or rests closer to the goal than 3 m.
[[nodiscard]] std::string encounter_scenario(std::uint64_t number);

// The number in "encounter:NUMBER"; empty for any other name.
[[nodiscard]] std::optional<std::uint64_t> encounter_number(std::string_view name) noexcept;

}  // namespace lodesman
