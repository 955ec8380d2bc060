// SPDX-License-Identifier: Apache-2.0
// The boat itself, as the page shows it ten times a second: where it is, what its helm and
// thrusters do, how old each thing is that this rests on. Pure functions; any thread.
#pragma once

#include <optional>
#include <string>

#include "deploy/operator/console/board_picture.h"
#include "mid_level/recording/viewer_json.h"

namespace lodesman::console {

// [m] From the boat's middle to the edge of the nearest obstacle that is tracked, or, where nothing
// is tracked, that the newest sonar frame shows; negative inside. Empty where there is none.
[[nodiscard]] std::optional<double> nearest_edge_m(const BoardPicture& picture);

// [-] [-1, 1] of a thruster's byte: 0-126 astern, 127 and 128 neutral, 129-255 ahead.
[[nodiscard]] double thrust_share(std::uint8_t byte) noexcept;

// `utc`: the time of day, as ISO 8601; empty where the machine does not know it.
[[nodiscard]] viewer::Json boat_json(const BoardPicture& picture, const std::string& utc);
[[nodiscard]] viewer::Shape boat_shape();

}  // namespace lodesman::console
