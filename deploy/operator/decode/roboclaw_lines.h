// SPDX-License-Identifier: Apache-2.0
// What was said to a RoboClaw, as JSON: one object a packet, in order, for people and for other
// programs. Replies to questions are not in such a recording; acknowledges may be. One thread.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <span>

#include "deploy/operator/decode/decode_counts.h"

namespace lodesman {

// `bytes`: from the host to the box, in packet serial mode. A write whose CRC is wrong is refused
// and looked for anew from its second byte on, as is a command that is not known, since its length
// is not.
[[nodiscard]] DecodeCounts roboclaw_lines(
    std::span<const std::uint8_t> bytes,
    const std::function<void(const nlohmann::ordered_json&)>& line);

}  // namespace lodesman
