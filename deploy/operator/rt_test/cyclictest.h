// SPDX-License-Identifier: Apache-2.0
// What the machine itself can do: cyclictest (rt-tests) wakes up once a millisecond and says how
// late, to the microsecond. Pure; any thread.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mid_level/runtime/health.h"

namespace lodesman::cli {

struct CyclictestFigures {
  std::uint64_t wakes = 0;
  LateCounts late{};  // as the tasks count
  Duration median{};
  Duration p99{};
  Duration worst{};
};

// One thread at that priority, until it is stopped; what it found then lies in `file`. It leaves
// the machine as it is: by itself it would keep the processors out of their idle states, for the
// boat too.
[[nodiscard]] std::vector<std::string> cyclictest_words(int priority,
                                                        const std::filesystem::path& file);

// What such a file says; empty where it is none or counts nothing.
[[nodiscard]] std::optional<CyclictestFigures> read_cyclictest(std::string_view text);

}  // namespace lodesman::cli
