// SPDX-License-Identifier: Apache-2.0
// What the boat does and why, in a sentence or two, and what is not as its present mode needs it.
// Pure functions; any thread.
#pragma once

#include <string>
#include <vector>

#include "deploy/operator/console/board_picture.h"
#include "mid_level/recording/viewer_json.h"

namespace lodesman::console {

enum class Severity : std::uint8_t { kInfo, kWarning, kCritical };
[[nodiscard]] const char* to_string(Severity severity) noexcept;

struct Alarm {
  Severity severity = Severity::kInfo;
  std::string text;
};

// `absence`: why there is no blackboard; empty where there is one.
[[nodiscard]] std::string what_it_does(const BoardPicture& picture, const std::string& absence);
// The gravest first.
[[nodiscard]] std::vector<Alarm> alarms_of(const BoardPicture& picture, const std::string& absence);

[[nodiscard]] viewer::Json story_json(const BoardPicture& picture, const std::string& absence);
[[nodiscard]] viewer::Shape story_shape();

}  // namespace lodesman::console
