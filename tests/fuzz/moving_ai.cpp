// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/bench/moving_ai.h"

#include <cmath>

#include "tests/fuzz/oracle.h"
#include "tests/fuzz/outside_file.h"
#include "tests/fuzz/targets.h"

namespace lodesman::fuzz {

void map(std::string_view input) {
  accepted_or_refused([&] {
    const OutsideFile file{input};
    const cli::MovingAiMap read = cli::read_map(file.path());
    require(read.width > 0 && read.height > 0 &&
                read.cells.size() ==
                    static_cast<std::size_t>(read.width) * static_cast<std::size_t>(read.height),
            "a map has other cells than its sides say");
    PassableMap drawn{read.width, read.height};
    read.draw(drawn, cli::Terrain::kGround);
    require(drawn.free_cells() <= read.cells.size(), "a map has more free cells than cells");
  });
}

void map_queries(std::string_view input) {
  static const cli::MovingAiMap map{5, 4, std::string(20, '.')};
  accepted_or_refused([&] {
    const OutsideFile file{input};
    const PassableMap sides{map.width, map.height};
    const std::vector<cli::MovingAiQuery> queries = cli::read_scen(file.path(), map);
    require(!queries.empty(), "a file without a query is accepted");
    for (const cli::MovingAiQuery& query : queries) {
      require(sides.contains(query.start) && sides.contains(query.goal), "a query leaves its map");
      require(
          std::isfinite(query.known_length) && query.last_digit >= 0.0 && query.last_digit <= 1.0,
          "a length is no number");
    }
  });
}

}  // namespace lodesman::fuzz
