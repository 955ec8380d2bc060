// SPDX-License-Identifier: Apache-2.0
// What a receiver said by NMEA 0183, as JSON: one object a sentence whose checksum holds, in order,
// for people and for other programs. Numbers are in the units that their names end in. One thread.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <span>

#include "deploy/operator/decode/decode_counts.h"

namespace lodesman {

// `bytes`: as they were on the line, from anywhere on. Each object begins with `type`, the three
// letters behind the talker or the whole address, and `known`; a sentence of a known type with a
// field that cannot be is not known, and has its text. What is empty is left out. Refused are lines
// whose checksum fails or is missing, and those that another one cut off.
[[nodiscard]] DecodeCounts nmea_lines(
    std::span<const std::uint8_t> bytes,
    const std::function<void(const nlohmann::ordered_json&)>& line);

}  // namespace lodesman
