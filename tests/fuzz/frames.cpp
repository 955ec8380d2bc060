// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/bench/frame_file.h"

#include <algorithm>

#include "low_level/path/grid.h"
#include "tests/fuzz/oracle.h"
#include "tests/fuzz/outside_file.h"
#include "tests/fuzz/targets.h"

namespace lodesman::fuzz {

void frames(std::string_view input) {
  constexpr std::size_t kMostDrawn = 16;  // of a file's first frame: the time of a run is limited
  static PassableGrid grid;
  accepted_or_refused([&] {
    const OutsideFile file{input};
    const std::vector<cli::FrameQuery> read = cli::read_frames(file.path());
    require(!read.empty(), "a file without a frame is accepted");
    const auto& obstacles = read.front().obstacles;
    grid.clear();
    const std::uint32_t open = grid.free_pixels();
    for (std::size_t i = 0; i < std::min(obstacles.size(), kMostDrawn); ++i) {
      grid.block(obstacles[i]);
    }
    require(grid.free_pixels() <= open, "obstacles open the view");
  });
}

}  // namespace lodesman::fuzz
