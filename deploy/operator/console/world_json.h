// SPDX-License-Identifier: Apache-2.0
// What lies round the boat, as the page's map shows it: mission, areas, plan, obstacles with their
// zones and where they will be. Pure functions; any thread.
#pragma once

#include "deploy/operator/console/board_picture.h"
#include "mid_level/recording/viewer_json.h"

namespace lodesman::console {

struct Hull {
  double length_m = 0.0;
  double beam_m = 0.0;
};

[[nodiscard]] viewer::Json world_json(const BoardPicture& picture, const Hull& hull);
[[nodiscard]] viewer::Shape world_shape();

// What is known of the water: a byte a cell.
[[nodiscard]] viewer::Json coverage_json(const Stamped<Coverage>& coverage);
[[nodiscard]] viewer::Shape coverage_shape();

}  // namespace lodesman::console
