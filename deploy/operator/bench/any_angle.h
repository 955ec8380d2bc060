// SPDX-License-Identifier: Apache-2.0
// The shortest path of any direction for a query in the sonar view, beside the grid's, timed. One
// thread.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "deploy/operator/bench/frame_file.h"
#include "low_level/path/tangent_path.h"

namespace lodesman::cli {

struct AnyAngleAnswer {
  PathReason reason = PathReason::kNoPath;
  double length_px = 0.0;
  std::vector<PointPx> points;  // start to goal; empty where not found
  double us = 0.0;              // from the obstacle list to the path

  [[nodiscard]] nlohmann::ordered_json to_json() const;
};

class AnyAnglePlanner {
 public:
  // With the median of `repeat` times.
  [[nodiscard]] AnyAngleAnswer answer(const FrameQuery& query, int repeat);

 private:
  TangentPath planner_;
};

}  // namespace lodesman::cli
