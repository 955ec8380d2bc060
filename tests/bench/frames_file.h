// SPDX-License-Identifier: Apache-2.0
// Frames from a file of `lodesman plan --frames`, for measuring on the same ones again.
#pragma once

#include <string>
#include <vector>

#include "tests/support/random_frames.h"

namespace lodesman::bench {

// Throws std::runtime_error where the file cannot be read or names a category that is none of
// kFrameKindNames.
[[nodiscard]] std::vector<testing::RandomFrame> read_frames(const std::string& path);

}  // namespace lodesman::bench
