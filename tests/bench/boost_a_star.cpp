// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/boost_a_star.h"

#include <algorithm>
#include <bit>
#include <boost/graph/astar_search.hpp>
#include <boost/graph/graph_traits.hpp>
#include <boost/iterator/counting_iterator.hpp>
#include <boost/iterator/iterator_facade.hpp>
#include <boost/property_map/function_property_map.hpp>
#include <boost/property_map/property_map.hpp>
#include <cstdlib>
#include <limits>
#include <utility>

#include "low_level/path/moves.h"

namespace lodesman::bench {
namespace {

using Edge = std::pair<int, int>;

class EdgeIterator
    : public boost::iterator_facade<EdgeIterator, Edge, boost::forward_traversal_tag, Edge> {
 public:
  EdgeIterator() = default;
  EdgeIterator(int from, unsigned moves, int columns)
      : from_{from}, moves_{moves}, columns_{columns} {}

 private:
  friend class boost::iterator_core_access;
  [[nodiscard]] Edge dereference() const {
    const Step step = kSteps[static_cast<std::size_t>(std::countr_zero(moves_))];
    return {from_, from_ + step.row * columns_ + step.column};
  }
  void increment() { moves_ &= moves_ - 1; }
  [[nodiscard]] bool equal(const EdgeIterator& other) const { return moves_ == other.moves_; }

  int from_ = 0;
  unsigned moves_ = 0;
  int columns_ = 0;
};

// With the types that Boost.Graph asks of a graph.
struct GridGraph {
  using vertex_descriptor = int;
  using edge_descriptor = Edge;
  using directed_category = boost::directed_tag;
  using edge_parallel_category = boost::disallow_parallel_edge_tag;
  struct traversal_category : boost::incidence_graph_tag, boost::vertex_list_graph_tag {};
  using out_edge_iterator = EdgeIterator;
  using degree_size_type = int;
  using vertex_iterator = boost::counting_iterator<int>;
  using vertices_size_type = int;
  using in_edge_iterator = void;
  using adjacency_iterator = void;
  using edge_iterator = void;
  using edges_size_type = void;
  static vertex_descriptor null_vertex() { return -1; }

  const PassableGrid* grid;
  int columns;
  int rows;
};

std::pair<EdgeIterator, EdgeIterator> out_edges(int from, const GridGraph& graph) {
  const unsigned moves = kMoves[graph.grid->around(from % graph.columns, from / graph.columns)];
  return {{from, moves, graph.columns}, {from, 0, graph.columns}};
}
[[maybe_unused]] int out_degree(int from, const GridGraph& graph) {
  return std::popcount(
      unsigned{kMoves[graph.grid->around(from % graph.columns, from / graph.columns)]});
}
[[maybe_unused]] int source(const Edge& edge, const GridGraph& /*graph*/) { return edge.first; }
[[maybe_unused]] int target(const Edge& edge, const GridGraph& /*graph*/) { return edge.second; }
[[maybe_unused]] int num_vertices(const GridGraph& graph) { return graph.columns * graph.rows; }
std::pair<boost::counting_iterator<int>, boost::counting_iterator<int>> vertices(
    const GridGraph& graph) {
  return {boost::counting_iterator<int>{0},
          boost::counting_iterator<int>{graph.columns * graph.rows}};
}

struct Found {};

struct StopAtGoal : boost::default_astar_visitor {
  explicit StopAtGoal(int at, std::uint32_t& taken) : goal{at}, expansions{&taken} {}
  template <class Graph>
  void examine_vertex(int at, const Graph& /*graph*/) {
    ++*expansions;
    if (at == goal) {
      throw Found{};
    }
  }
  int goal;
  std::uint32_t* expansions;
};

struct Octile : boost::astar_heuristic<GridGraph, std::int32_t> {
  Octile(int at, int width) : goal{at}, columns{width} {}
  std::int32_t operator()(int at) const {
    const int across = std::abs(at % columns - goal % columns);
    const int down = std::abs(at / columns - goal / columns);
    return kStraightCost * std::abs(across - down) + kDiagonalCost * std::min(across, down);
  }
  int goal;
  int columns;
};

}  // namespace

BoostAStar::BoostAStar(const FanShape& fan)
    : fan_{fan},
      parents_(static_cast<std::size_t>(fan.columns) * static_cast<std::size_t>(fan.rows)),
      costs_(parents_.size()),
      ranks_(parents_.size()),
      colours_(parents_.size()) {}

SearchResult BoostAStar::search(const PassableGrid& grid, PathPixel start, PathPixel goal) {
  const GridGraph graph{&grid, fan_.columns, fan_.rows};
  const int first = start.row * fan_.columns + start.column;
  const int last = goal.row * fan_.columns + goal.column;
  const boost::typed_identity_property_map<int> index;
  const auto weights = boost::make_function_property_map<Edge, std::int32_t>([&](const Edge& e) {
    const int change = std::abs(e.first - e.second);
    return change == 1 || change == fan_.columns ? kStraightCost : kDiagonalCost;
  });
  SearchResult result;
  try {
    boost::astar_search(
        graph, first, Octile{last, fan_.columns},
        boost::visitor(StopAtGoal{last, result.expansions})
            .predecessor_map(boost::make_iterator_property_map(parents_.begin(), index))
            .distance_map(boost::make_iterator_property_map(costs_.begin(), index))
            .rank_map(boost::make_iterator_property_map(ranks_.begin(), index))
            .color_map(boost::make_iterator_property_map(colours_.begin(), index))
            .vertex_index_map(index)
            .weight_map(weights));
  } catch (const Found&) {
    result.reason = PathReason::kFound;
    result.cost_10_14 = costs_[static_cast<std::size_t>(last)];
  }
  path_.clear();
  if (result.reason == PathReason::kFound) {
    for (int at = last;; at = parents_[static_cast<std::size_t>(at)]) {
      path_.push_back({static_cast<std::int16_t>(at % fan_.columns),
                       static_cast<std::int16_t>(at / fan_.columns)});
      if (at == first) {
        break;
      }
    }
    std::reverse(path_.begin(), path_.end());
    result.path = path_;
  }
  return result;
}

}  // namespace lodesman::bench
