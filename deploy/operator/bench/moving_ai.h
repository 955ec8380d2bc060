// SPDX-License-Identifier: Apache-2.0
// Maps and queries in the MovingAI benchmarks' format (.map and .map.scen). One thread, before
// anything runs; everything that is wrong throws StartupError.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "low_level/path/map_search.h"

namespace lodesman::cli {

// What a cell of a map is to whoever moves: from ground to water or back there is no way. '.', 'G'
// and 'S' (swamp) are ground, 'W' is water; '@', 'O' and 'T' are neither.
enum class Terrain : std::uint8_t { kNone, kGround, kWater };

// A map as it stands in the file: a character a cell, row by row.
struct MovingAiMap {
  int width = 0;
  int height = 0;
  std::string cells;

  [[nodiscard]] static constexpr Terrain terrain_of(char cell) noexcept {
    return cell == '.' || cell == 'G' || cell == 'S' ? Terrain::kGround
           : cell == 'W'                             ? Terrain::kWater
                                                     : Terrain::kNone;
  }
  // `cell` must lie on the map.
  [[nodiscard]] Terrain terrain_at(MapCell cell) const noexcept;
  // Sets every cell of `map`, which must be of this size: those of `terrain`, which is
  // ground or water, may be used.
  void draw(PassableMap& map, Terrain terrain) const noexcept;
};

struct MovingAiQuery {
  MapCell start;
  MapCell goal;
  double known_length = 0.0;  // the cheapest under 1 and the square root of 2, or 1.414213562
  double last_digit = 1.0;    // what one unit of the last digit printed is worth
};

inline constexpr std::size_t kMaxMapFileBytes = std::size_t{4} << 20U;
inline constexpr std::size_t kMaxScenFileBytes = std::size_t{16} << 20U;

[[nodiscard]] MovingAiMap read_map(const std::filesystem::path& file);
// The queries must be for a map of this size, and lie on it.
[[nodiscard]] std::vector<MovingAiQuery> read_scen(const std::filesystem::path& file,
                                                   const MovingAiMap& map);

}  // namespace lodesman::cli
