// SPDX-License-Identifier: Apache-2.0
// Maps and queries in the MovingAI benchmarks' format (.map and .map.scen). One thread, before
// anything runs; everything that is wrong throws StartupError.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "low_level/path/map_search.h"

namespace lodesman::cli {

// A map as it stands in the file: a character a cell, row by row.
struct MovingAiMap {
  int width = 0;
  int height = 0;
  std::string cells;

  [[nodiscard]] static constexpr bool is_free(char cell) noexcept {
    return cell == '.' || cell == 'G';
  }
  // Sets every cell of `map`, which must be of this size.
  void draw(PassableMap& map) const noexcept;
};

struct MovingAiQuery {
  MapCell start;
  MapCell goal;
  double known_length = 0.0;  // the cheapest under 1 and the square root of 2
  double last_digit = 1.0;    // what one unit of the last digit printed is worth
};

inline constexpr std::size_t kMaxMapFileBytes = std::size_t{4} << 20U;
inline constexpr std::size_t kMaxScenFileBytes = std::size_t{16} << 20U;

[[nodiscard]] MovingAiMap read_map(const std::filesystem::path& file);
// The queries must be for a map of this size, and lie on it.
[[nodiscard]] std::vector<MovingAiQuery> read_scen(const std::filesystem::path& file,
                                                   const MovingAiMap& map);

}  // namespace lodesman::cli
