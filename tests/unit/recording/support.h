// SPDX-License-Identifier: Apache-2.0
// What the tests of recordings share. One thread.
#pragma once

#include <algorithm>
#include <string>

#include "mid_level/recording/board_tap.h"
#include "tests/support/catch.h"

namespace lodesman::testing {

[[nodiscard]] inline Time at(std::int64_t ms) { return Time{std::chrono::milliseconds{ms}}; }

// By its place in the blackboard.
[[nodiscard]] inline std::uint32_t channel_named(const std::string& name) {
  const auto channels = raw_channels();
  const auto found = std::find_if(channels.begin(), channels.end(),
                                  [&](const RawChannel& c) { return c.name == name; });
  REQUIRE(found != channels.end());
  return static_cast<std::uint32_t>(found - channels.begin());
}

}  // namespace lodesman::testing
