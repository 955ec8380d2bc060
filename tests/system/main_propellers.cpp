// SPDX-License-Identifier: Apache-2.0
// What becomes of the vessel of a bench, for a script that stands beside it: a line at once when
// its propellers begin to turn or stand still, and one each second, until it is ended.
//   propellers SEGMENT     of the boat; lodesman-devices of that segment must be running
// A line: milliseconds since 1970, "turning" or "still", x and y [m], surge [m/s], and the distance
// [m] of the hull from the nearest obstacle.
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <stdexcept>
#include <thread>

#include "deploy/boat/device_bench.h"
#include "mid_level/blackboard/segment.h"

namespace lodesman {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kPeriod{5};
constexpr milliseconds kAtLeastEvery{1000};
constexpr Duration kPatience = std::chrono::seconds{5};

[[nodiscard]] bool is_neutral(std::uint8_t thrust) noexcept {
  return thrust == 127 || thrust == 128;
}

[[noreturn]] void follow(const SharedBlackboard& world) {
  Reader<WorldTruth> truths{world->world_truth};
  bool was_still = true;
  milliseconds told{};
  for (;; std::this_thread::sleep_for(kPeriod)) {
    const auto* newest = truths.latest();
    if (newest == nullptr) {
      continue;
    }
    const WorldTruth& truth = newest->value;
    const auto now = std::chrono::duration_cast<milliseconds>(
        std::chrono::system_clock::now().time_since_epoch());
    const bool is_still = is_neutral(truth.thrust_left) && is_neutral(truth.thrust_right);
    if (is_still != was_still || now - told >= kAtLeastEvery) {
      fmt::print("{} {} {:.2f} {:.2f} {:.2f} {:.2f}\n", now.count(), is_still ? "still" : "turning",
                 truth.x_m, truth.y_m, truth.surge_m_s, truth.hull_clearance_m);
      std::fflush(stdout);
      told = now;
    }
    was_still = is_still;
  }
}

}  // namespace
}  // namespace lodesman

int main(int argc, char** argv) {
  try {
    if (argc != 2) {
      throw std::invalid_argument("usage: propellers SEGMENT");
    }
    lodesman::follow(lodesman::SharedBlackboard::observe(lodesman::world_segment_of(argv[1]),
                                                         lodesman::kPatience));
  } catch (const std::exception& error) {
    fmt::print(stderr, "propellers: {}\n", error.what());
    return EXIT_FAILURE;
  }
}
