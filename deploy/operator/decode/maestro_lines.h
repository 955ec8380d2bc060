// SPDX-License-Identifier: Apache-2.0
// What was said to a Pololu Maestro, as JSON: one object a packet, in order, for people and for
// other programs. Answers have no frame and are not in such a recording. One thread.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <span>

#include "deploy/operator/decode/decode_counts.h"

namespace lodesman {

// `bytes`: from the host to the box, in any of its three protocols, with or without checks. A byte
// that may be a check is one where it is right, and from the first right one on all have to be: a
// packet whose check is wrong is refused. A packet that another one begins within is refused too.
[[nodiscard]] DecodeCounts maestro_lines(
    std::span<const std::uint8_t> bytes,
    const std::function<void(const nlohmann::ordered_json&)>& line);

}  // namespace lodesman
