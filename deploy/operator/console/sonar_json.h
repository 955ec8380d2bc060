// SPDX-License-Identifier: Apache-2.0
// What the sonar sees, as the page shows it: the newest ping as a picture, and over it what was
// found in it, what is tracked and the way that is planned, all in the vehicle's frame. One thread.
#pragma once

#include "deploy/operator/console/board_picture.h"
#include "mid_level/recording/sonar_picture.h"
#include "mid_level/recording/viewer_json.h"

namespace lodesman::console {

// There is a ping in the picture. `min_range_m`: nearer than that the head hears itself.
[[nodiscard]] viewer::Json sonar_json(const BoardPicture& picture, double min_range_m,
                                      SonarPicture& drawer);
[[nodiscard]] viewer::Shape sonar_shape();

}  // namespace lodesman::console
