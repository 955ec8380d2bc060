// SPDX-License-Identifier: Apache-2.0
// What a Crossbow NAV440 said, or was told, as JSON: one object a packet whose check holds, in
// order, for people and for other programs. Numbers are in the units that their names end in. One
// thread.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <span>

#include "deploy/operator/decode/decode_counts.h"

namespace lodesman {

// `bytes`: as they were on the line, from anywhere on. Each object begins with `type`, two letters
// or 0x and four digits, and `known`. Refused are candidates whose check fails, and packets of a
// known type with a length that it cannot have; their bytes are among those skipped, as is what is
// left at the end.
[[nodiscard]] DecodeCounts nav440_lines(
    std::span<const std::uint8_t> bytes,
    const std::function<void(const nlohmann::ordered_json&)>& line);

}  // namespace lodesman
