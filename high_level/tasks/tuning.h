// SPDX-License-Identifier: Apache-2.0
// What may be tuned under way, by its keys in the configuration. Part of the operator's desk; one
// thread.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "mid_level/blackboard/blackboard.h"
#include "mid_level/messages/mission.h"

namespace lodesman {

// Changes `tunables` as told, or says why not: then they are not to be used. The version is the
// caller's.
[[nodiscard]] std::string tune_by(const std::map<std::string, double>& settings,
                                  double least_margin_m, Tunables& tunables);

[[nodiscard]] nlohmann::ordered_json json_of(const Tunables& tunables);

// What an earlier program left that died with a mission under way or held: that goes on with it.
[[nodiscard]] std::optional<Tunables> tunables_left(const Blackboard& board);

}  // namespace lodesman
