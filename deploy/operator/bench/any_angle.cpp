// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/bench/any_angle.h"

#include <algorithm>

#include "mid_level/base/clock.h"

namespace lodesman::cli {
namespace {

[[nodiscard]] PointPx centre_of(PathPixel pixel) noexcept {
  return {static_cast<double>(pixel.column), static_cast<double>(pixel.row)};
}

}  // namespace

nlohmann::ordered_json AnyAngleAnswer::to_json() const {
  using Json = nlohmann::ordered_json;
  const bool found = reason == PathReason::kFound;
  Json places = Json::array();
  for (const PointPx point : points) {
    places.push_back({point.column, point.row});
  }
  return {{"found", found},
          {"reason", to_string(reason)},
          {"length_px", found ? Json(length_px) : Json(nullptr)},
          {"points", std::move(places)},
          {"us", us}};
}

AnyAngleAnswer AnyAnglePlanner::answer(const FrameQuery& query, int repeat) {
  const std::vector<ZonePx> zones{query.obstacles.begin(), query.obstacles.end()};
  const RegionPx fan = RegionPx::fan();
  const SteadyClock clock;
  TangentResult result;
  std::vector<double> us;
  for (int i = 0; i < repeat; ++i) {
    const Time began = clock.now();
    result = planner_.find(zones, fan, centre_of(query.start), centre_of(query.goal));
    us.push_back(to_seconds(clock.now() - began) * 1e6);
  }
  std::sort(us.begin(), us.end());
  const double median = (us[us.size() / 2] + us[(us.size() - 1) / 2]) / 2.0;
  return {result.reason, result.length_px, {result.path.begin(), result.path.end()}, median};
}

}  // namespace lodesman::cli
