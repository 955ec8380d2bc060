// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/bench/plan_answers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "mid_level/base/clock.h"
#include "mid_level/geometry/sonar_view.h"

namespace lodesman::cli {
namespace {

using Json = nlohmann::ordered_json;

[[nodiscard]] double us_between(Time from, Time to) noexcept { return to_seconds(to - from) * 1e6; }

// The middle one; of an even number the mean of the two in the middle.
[[nodiscard]] double median_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2.0;
}

// Calls draw() and then search(), `repeat` times, and leaves the medians in `answer`.
template <class Draw, class Search>
void time_both(int repeat, PlanAnswer& answer, Draw draw, Search search) {
  const SteadyClock clock;
  std::vector<double> whole_us;
  std::vector<double> search_us;
  for (int i = 0; i < repeat; ++i) {
    const Time began = clock.now();
    draw();
    const Time ready = clock.now();
    search();
    const Time ended = clock.now();
    whole_us.push_back(us_between(began, ended));
    search_us.push_back(us_between(ready, ended));
  }
  answer.us = median_of(std::move(whole_us));
  answer.search_us = median_of(std::move(search_us));
}

// Under the paper's costs: a knight's step is a straight and a diagonal one.
[[nodiscard]] std::int32_t cost_10_14_of(std::span<const PathPixel> path) {
  std::int32_t cost = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const std::int32_t columns = std::abs(path[i].column - path[i - 1].column);
    const std::int32_t rows = std::abs(path[i].row - path[i - 1].row);
    cost += kStraightCost * std::abs(columns - rows) + kDiagonalCost * std::min(columns, rows);
  }
  return cost;
}

void take(const SearchResult& result, PlanAnswer& answer) {
  answer.reason = result.reason;
  answer.cost = result.cost_10_14 / static_cast<double>(kStraightCost);
  answer.cost_10_14 = cost_10_14_of(result.path);
  answer.expansions = result.expansions;
  for (const PathPixel& pixel : result.path) {
    answer.path.push_back({pixel.column, pixel.row});
  }
}

void take(MapSearchResult result, MapCosts costs, PlanAnswer& answer) {
  answer.reason = result.reason;
  answer.cost = result.cost(costs);
  answer.cost_10_14 = result.cost_10_14();
  answer.expansions = result.expansions;
  answer.path = std::move(result.path);
}

}  // namespace

Json PlanAnswer::to_json() const {
  const bool found = reason == PathReason::kFound;
  Json pixels = Json::array();
  for (const MapCell& cell : path) {
    pixels.push_back({cell.column, cell.row});
  }
  Json line = {{"id", id},
               {"found", found},
               {"reason", to_string(reason)},
               {"cost", found ? Json(cost) : Json(nullptr)},
               {"cost_10_14", found ? Json(cost_10_14) : Json(nullptr)},
               {"path_px", std::move(pixels)},
               {"free_px", free_px},
               {"expansions", expansions},
               {"us", us},
               {"search_us", search_us}};
  if (!any_angle.is_null()) {
    line["any_angle"] = any_angle;
  }
  return line;
}

FramePlanner::FramePlanner(MapCosts costs, Geometry geometry)
    : costs_{costs},
      geometry_{geometry},
      search_{geometry},
      map_{kViewColumns, kViewRows},
      map_search_{kViewColumns, kViewRows, costs} {}

PlanAnswer FramePlanner::answer(const FrameQuery& query, int repeat) {
  PlanAnswer answer;
  answer.id = query.id;
  if (costs_ == MapCosts::kPaper) {
    SearchResult result;
    time_both(
        repeat, answer, [&] { draw(query); },
        [&] { result = search_.search(grid_, query.start, query.goal); });
    take(result, answer);
  } else {
    time_both(
        repeat, answer, [&] { draw(query); }, [&] { search_map(query, answer); });
  }
  answer.free_px = grid_.free_pixels();
  const bool found = answer.reason == PathReason::kFound;
  if (query.known_free_px) {
    answer.agrees = *query.known_free_px == answer.free_px;
  }
  if (query.knows_cost && costs_ == MapCosts::kPaper && geometry_ == Geometry::k4) {
    const bool same =
        found ? query.known_cost_10_14 == answer.cost_10_14 : !query.known_cost_10_14.has_value();
    answer.agrees = answer.agrees.value_or(true) && same;
  }
  return answer;
}

void FramePlanner::draw(const FrameQuery& query) noexcept {
  grid_.clear();
  for (const EllipsePx& ellipse : query.obstacles) {
    grid_.block(ellipse);
  }
  if (costs_ == MapCosts::kPaper) {
    return;
  }
  for (int row = 0; row < kViewRows; ++row) {
    for (int column = 0; column < kViewColumns; ++column) {
      map_.set({column, row}, grid_.passable(column, row));
    }
  }
}

void FramePlanner::search_map(const FrameQuery& query, PlanAnswer& answer) {
  const MapCell start{query.start.column, query.start.row};
  const MapCell goal{query.goal.column, query.goal.row};
  take(map_search_.search(map_, start, goal), costs_, answer);
  // A map knows no fan.
  if (answer.reason == PathReason::kGoalBlocked && !in_fan(goal.column, goal.row)) {
    answer.reason = PathReason::kGoalOutOfView;
  }
}

namespace {

// The benchmark's older files were made with the root itself, those of cities and of many agents
// with nine decimals of it.
[[nodiscard]] bool is_known_length(const MapSearchResult& result, const MovingAiQuery& query) {
  constexpr std::array kDiagonals{std::numbers::sqrt2, 1.414213562};
  return std::any_of(kDiagonals.begin(), kDiagonals.end(), [&](double diagonal) {
    const double length = result.straight_steps + result.diagonal_steps * diagonal;
    // A little more than the digit, for what its own rounding in binary takes.
    return std::abs(length - query.known_length) <= query.last_digit * (1.0 + 1e-6);
  });
}

}  // namespace

MapPlanner::MapPlanner(const MovingAiMap& map, MapCosts costs)
    : text_{map},
      costs_{costs},
      map_{map.width, map.height},
      search_{map.width, map.height, costs} {}

PlanAnswer MapPlanner::answer(const MovingAiQuery& query, std::size_t number, int repeat) {
  PlanAnswer answer;
  answer.id = number;
  // A start on neither is blocked on ground too.
  const Terrain terrain =
      text_.terrain_at(query.start) == Terrain::kWater ? Terrain::kWater : Terrain::kGround;
  MapSearchResult result;
  time_both(
      repeat, answer, [&] { text_.draw(map_, terrain); },
      [&] { result = search_.search(map_, query.start, query.goal); });
  const bool known = is_known_length(result, query);
  take(std::move(result), costs_, answer);
  answer.free_px = map_.free_cells();
  if (costs_ == MapCosts::kSqrt2) {
    answer.agrees = answer.reason == PathReason::kFound && known;
  }
  return answer;
}

std::string summary_of(std::span<const PlanAnswer> answers) {
  std::array<std::size_t, enumerators(PathReason{}).size()> reasons{};
  std::size_t known = 0;
  std::size_t agreeing = 0;
  std::vector<double> us;
  std::vector<double> search_us;
  for (const PlanAnswer& answer : answers) {
    ++reasons[static_cast<std::size_t>(answer.reason)];
    known += answer.agrees ? 1U : 0U;
    agreeing += answer.agrees.value_or(false) ? 1U : 0U;
    us.push_back(answer.us);
    search_us.push_back(answer.search_us);
  }
  std::string text =
      fmt::format("{} {}:", answers.size(), answers.size() == 1 ? "query" : "queries");
  const char* comma = " ";
  for (std::size_t i = 0; i < reasons.size(); ++i) {
    if (reasons[i] > 0) {
      text += fmt::format("{}{} {}", comma, reasons[i], to_string(static_cast<PathReason>(i)));
      comma = ", ";
    }
  }
  text += "\n";
  if (known > 0) {
    text += fmt::format("{} of {} agree with what the file gives as right\n", agreeing, known);
  }
  if (!us.empty()) {
    text +=
        fmt::format("median {:.1f} us, longest {:.1f} us; the search alone {:.1f} us\n",
                    median_of(us), *std::max_element(us.begin(), us.end()), median_of(search_us));
  }
  return text;
}

std::string table_of(std::span<const PlanAnswer> answers) {
  std::string text = fmt::format("{:>8}  {:<16} {:>10} {:>7} {:>10} {:>9} {:>9}\n", "id", "reason",
                                 "cost px", "pixels", "expansions", "us", "search us");
  for (const PlanAnswer& answer : answers) {
    const std::string id = answer.id.is_string() ? answer.id.get<std::string>() : answer.id.dump();
    const std::string cost =
        answer.reason == PathReason::kFound ? fmt::format("{:.2f}", answer.cost) : "-";
    text += fmt::format("{:>8}  {:<16} {:>10} {:>7} {:>10} {:>9.1f} {:>9.1f}{}\n", id,
                        to_string(answer.reason), cost, answer.path.size(), answer.expansions,
                        answer.us, answer.search_us,
                        answer.agrees.value_or(true) ? "" : "  ! not what the file says");
  }
  return text;
}

}  // namespace lodesman::cli
