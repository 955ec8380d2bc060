// SPDX-License-Identifier: Apache-2.0
// Made-up runs that look like real ones, for the tests of what a run leaves behind.
#pragma once

#include "deploy/operator/report/run_record.h"

namespace lodesman::testing {

[[nodiscard]] MovingObstacle ellipse_at(double x_m, double y_m, double first_m, double second_m,
                                        double angle_deg, double zone_first_m,
                                        double zone_second_m);
[[nodiscard]] MovingObstacle circle_at(double x_m, double y_m, double radius_m, double zone_m);
[[nodiscard]] MovingObstacle wall_of(ObstacleShape shape,
                                     const std::vector<std::array<double, 2>>& points_m,
                                     double zone_m);

// From (0, 0) to (0, 20) round a circle at (0, 10): first to its left, from 26 s on to its right,
// without a path while inside its protection zone.
[[nodiscard]] cli::RunRecord static_run();
// The same trip, the circle comes from (0, 16) head-on at 0.11 m/s.
[[nodiscard]] cli::RunRecord moving_run();
// Into a C of three ellipses, open to starboard.
[[nodiscard]] cli::RunRecord trap_run();
// Along a long wall, round its end and round a block; the estimate drifts.
[[nodiscard]] cli::RunRecord wall_run();

}  // namespace lodesman::testing
