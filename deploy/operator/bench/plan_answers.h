// SPDX-License-Identifier: Apache-2.0
// The path finder alone: answers queries in the sonar view and on maps, and times itself. One
// thread.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "deploy/operator/bench/frame_file.h"
#include "deploy/operator/bench/moving_ai.h"
#include "low_level/path/grid.h"
#include "low_level/path/map_search.h"
#include "low_level/path/path_search.h"

namespace lodesman::cli {

struct PlanAnswer {
  nlohmann::ordered_json id;
  PathReason reason = PathReason::kNoPath;
  double cost = 0.0;             // [px] under the costs asked for
  std::int32_t cost_10_14 = 0;   // of the same path, under the paper's costs
  std::vector<MapCell> path;     // start to goal; empty where not found
  std::uint32_t free_px = 0;     // passable pixels or cells
  std::uint32_t expansions = 0;  // taken from the open list
  double us = 0.0;               // from the obstacle list or the map to the full path
  double search_us = 0.0;        // the search alone
  // Whether this is what the file says is right; nothing where it does not say, or speaks of
  // other costs.
  std::optional<bool> agrees;
  nlohmann::ordered_json any_angle;  // the path of any direction; null where not asked for

  [[nodiscard]] nlohmann::ordered_json to_json() const;
};

// Queries in the sonar view. Under the paper's costs, and in 8-geometry, it is the vehicle's own
// grid and search that answer; under others MapSearch does, on that same grid.
class FramePlanner {
 public:
  // Geometry::k8 has costs of its own, and goes with MapCosts::kPaper.
  explicit FramePlanner(MapCosts costs, Geometry geometry = Geometry::k4);

  // With the median of `repeat` times.
  [[nodiscard]] PlanAnswer answer(const FrameQuery& query, int repeat);

 private:
  void draw(const FrameQuery& query) noexcept;
  void search_map(const FrameQuery& query, PlanAnswer& answer);

  MapCosts costs_;
  Geometry geometry_;
  PassableGrid grid_;
  PathSearch search_;
  PassableMap map_;
  MapSearch map_search_;
};

class MapPlanner {
 public:
  // `map` must outlive it.
  MapPlanner(const MovingAiMap& map, MapCosts costs);

  [[nodiscard]] PlanAnswer answer(const MovingAiQuery& query, std::size_t number, int repeat);

 private:
  const MovingAiMap& text_;
  MapCosts costs_;
  PassableMap map_;
  MapSearch search_;
};

// What a person wants to know of many answers: counts, agreement and times.
[[nodiscard]] std::string summary_of(std::span<const PlanAnswer> answers);
// A line an answer, under a heading.
[[nodiscard]] std::string table_of(std::span<const PlanAnswer> answers);

}  // namespace lodesman::cli
