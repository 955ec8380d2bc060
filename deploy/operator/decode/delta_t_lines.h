// SPDX-License-Identifier: Apache-2.0
// What a file of the Delta T's holds, as JSON: one object a record, in order, for people and for
// other programs. Numbers are in the units that their names end in. One thread.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <span>

#include "deploy/operator/decode/decode_counts.h"

namespace lodesman {

// `bytes`: 83B, 83P and .837 records back to back, or datagrams, and what a head said and was told.
// Each object begins with `type` ("83B", "83P", "837", "switch_command", "head_reply", "control")
// and `known`. Echoes are summed up by their greatest. Refused is what has the tag of a record and
// is none; it is looked for anew from its second byte on.
[[nodiscard]] DecodeCounts delta_t_lines(
    std::span<const std::uint8_t> bytes,
    const std::function<void(const nlohmann::ordered_json&)>& line);

}  // namespace lodesman
