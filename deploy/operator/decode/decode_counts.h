// SPDX-License-Identifier: Apache-2.0
// What became of the bytes of a recording that was decoded. One thread.
#pragma once

#include <cstdint>

namespace lodesman {

struct DecodeCounts {
  std::uint64_t packets = 0, skipped_bytes = 0, refused = 0;
};

}  // namespace lodesman
