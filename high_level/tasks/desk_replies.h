// SPDX-License-Identifier: Apache-2.0
// What the operator's desk replies to an order, as lines of JSON. Part of the operator's desk; pure
// functions, any thread.
#pragma once

#include <string>
#include <vector>

#include "mid_level/messages/command.h"

namespace lodesman {

// `warnings`: what whoever gave the order is told though it is obeyed.
[[nodiscard]] std::string done(MissionState state, const std::vector<std::string>& warnings = {});
[[nodiscard]] std::string not_confirmed(const std::string& reason);
[[nodiscard]] std::string reply_of(OrderAnswer answer, MissionState state,
                                   const std::vector<std::string>& warnings = {});

}  // namespace lodesman
