// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/bench/moving_ai.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "deploy/operator/bench/input_lines.h"

namespace lodesman::cli {
namespace {

constexpr std::size_t kHeaderLines = 4;
constexpr std::string_view kBlank = " \t";

[[nodiscard]] std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::size_t at = line.find_first_not_of(kBlank); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(kBlank, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(kBlank, end);
  }
  return words;
}

[[nodiscard]] int side_of(const LinePlace& place, const std::string& key, const std::string& line) {
  const auto words = words_of(line);
  if (words.size() != 2 || words[0] != key) {
    place.refuse(key, "must be '" + key + " N'");
  }
  return static_cast<int>(
      whole_number(place, key, words[1], 1, static_cast<std::int64_t>(PassableMap::kMaxCells)));
}

void require_map_row(const LinePlace& place, const std::string& row, int width) {
  if (row.size() != static_cast<std::size_t>(width)) {
    place.refuse("map", "has " + std::to_string(row.size()) + " cells, and the width is " +
                            std::to_string(width));
  }
  if (const auto odd = row.find_first_not_of(".G@OTSW"); odd != std::string::npos) {
    place.refuse("map", "column " + std::to_string(odd) + ": must be one of . G @ O T S W");
  }
}

[[nodiscard]] double last_digit_of(std::string_view number) {
  const auto point = number.find('.');
  const auto decimals = point == std::string_view::npos ? 0 : number.size() - point - 1;
  return std::pow(10.0, -static_cast<double>(decimals));
}

[[nodiscard]] MovingAiQuery query_of(const LinePlace& place, const std::string& line,
                                     const MovingAiMap& map) {
  constexpr std::array<const char*, 9> kFields{"bucket",  "map",    "width",  "height", "start_x",
                                               "start_y", "goal_x", "goal_y", "length"};
  const auto words = words_of(line);
  if (words.size() != kFields.size()) {
    place.refuse("row",
                 "must have 9 fields: bucket map width height start_x start_y goal_x "
                 "goal_y length");
  }
  const auto whole = [&](std::size_t field, std::int64_t min, std::int64_t max) {
    return static_cast<int>(whole_number(place, kFields[field], words[field], min, max));
  };
  (void)whole(0, 0, 1'000'000'000);
  // Cells are counted in the map's own size; a scaled row would mean other cells.
  (void)whole(2, map.width, map.width);
  (void)whole(3, map.height, map.height);
  MovingAiQuery query;
  query.start = {whole(4, 0, map.width - 1), whole(5, 0, map.height - 1)};
  query.goal = {whole(6, 0, map.width - 1), whole(7, 0, map.height - 1)};
  query.known_length = finite_number(place, kFields[8], words[8]);
  query.last_digit = last_digit_of(words[8]);
  return query;
}

}  // namespace

Terrain MovingAiMap::terrain_at(MapCell cell) const noexcept {
  return terrain_of(cells[static_cast<std::size_t>(cell.row) * static_cast<std::size_t>(width) +
                          static_cast<std::size_t>(cell.column)]);
}

void MovingAiMap::draw(PassableMap& map, Terrain terrain) const noexcept {
  std::size_t i = 0;
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      map.set({column, row}, terrain_of(cells[i++]) == terrain);
    }
  }
}

MovingAiMap read_map(const std::filesystem::path& file) {
  const std::vector<std::string> lines = read_lines(file, kMaxMapFileBytes);
  if (lines.size() < kHeaderLines) {
    LinePlace{file, lines.size() + 1}.refuse("header", "must be type, height, width, map");
  }
  if (lines[0] != "type octile") {
    LinePlace{file, 1}.refuse("type", "must be 'type octile'");
  }
  MovingAiMap map;
  map.height = side_of({file, 2}, "height", lines[1]);
  map.width = side_of({file, 3}, "width", lines[2]);
  if (lines[3] != "map") {
    LinePlace{file, 4}.refuse("map", "must be 'map'");
  }
  const std::int64_t cells = std::int64_t{map.width} * map.height;
  if (cells > static_cast<std::int64_t>(PassableMap::kMaxCells)) {
    LinePlace{file, 3}.refuse("width", "times height must be at most " +
                                           std::to_string(PassableMap::kMaxCells) + " cells");
  }
  const auto rows = static_cast<std::size_t>(map.height);
  for (std::size_t row = 0; row < rows; ++row) {
    const std::size_t i = kHeaderLines + row;
    if (i >= lines.size()) {
      LinePlace{file, lines.size()}.refuse(
          "height", "is " + std::to_string(rows) + ", and " + std::to_string(row) + " rows follow");
    }
    require_map_row({file, i + 1}, lines[i], map.width);
    map.cells += lines[i];
  }
  for (std::size_t i = kHeaderLines + rows; i < lines.size(); ++i) {
    if (!lines[i].empty()) {
      LinePlace{file, i + 1}.refuse("height", "is " + std::to_string(rows) + ", and more follows");
    }
  }
  return map;
}

std::vector<MovingAiQuery> read_scen(const std::filesystem::path& file, const MovingAiMap& map) {
  const std::vector<std::string> lines = read_lines(file, kMaxScenFileBytes);
  const auto header = lines.empty() ? std::vector<std::string_view>{} : words_of(lines[0]);
  if (header.size() != 2 || header[0] != "version") {
    LinePlace{file, 1}.refuse("version", "must be 'version 1'");
  }
  if (header[1] != "1" && header[1] != "1.0") {
    LinePlace{file, 1}.refuse("version", "must be 1");
  }
  std::vector<MovingAiQuery> queries;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    if (lines[i].find_first_not_of(kBlank) != std::string::npos) {
      queries.push_back(query_of({file, i + 1}, lines[i], map));
    }
  }
  if (queries.empty()) {
    LinePlace{file, 1}.refuse("file", "holds no query");
  }
  return queries;
}

}  // namespace lodesman::cli
