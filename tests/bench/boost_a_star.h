// SPDX-License-Identifier: Apache-2.0
// boost::astar_search over the finished bitmap as an implicit graph of 8 neighbours without corner
// cutting. One thread.
#pragma once

#include <boost/graph/properties.hpp>
#include <cstdint>
#include <vector>

#include "low_level/path/grid.h"
#include "low_level/path/search_result.h"

namespace lodesman::bench {

class BoostAStar {
 public:
  explicit BoostAStar(const FanShape& fan);

  [[nodiscard]] SearchResult search(const PassableGrid& grid, PathPixel start, PathPixel goal);

 private:
  FanShape fan_;
  std::vector<std::int32_t> parents_;
  std::vector<std::int32_t> costs_;
  std::vector<std::int32_t> ranks_;
  std::vector<boost::default_color_type> colours_;
  std::vector<PathPixel> path_;
};

}  // namespace lodesman::bench
