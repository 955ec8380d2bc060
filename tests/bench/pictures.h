// SPDX-License-Identifier: Apache-2.0
// Pictures for docs/search.md: what A* and what the search by jump points look at on one frame.
#pragma once

#include <string>

#include "tests/support/random_frames.h"

namespace lodesman::bench {

// Writes search-a-star.png and search-jump-points.png into a folder. Throws std::runtime_error
// where they cannot be written.
void draw_pictures(const testing::RandomFrame& frame, const std::string& folder);

}  // namespace lodesman::bench
