// SPDX-License-Identifier: Apache-2.0
// Things that are heard for a few pings and are then gone: plain data with a lifetime, in room made
// once. What begins where there is no room is not heard. One thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "mid_level/base/random_stream.h"

namespace lodesman {

// Thing has `std::uint32_t pings_left`.
template <class Thing, std::size_t kMost>
class Lasting {
 public:
  void begin(const Thing& thing) noexcept {
    if (count_ < kMost && thing.pings_left > 0) {
      things_[count_++] = thing;
    }
  }
  // In the ping at hand, each of which then has one less left.
  [[nodiscard]] std::span<Thing> now() noexcept { return {things_.data(), count_}; }
  void age() noexcept {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      if (--things_[i].pings_left > 0) {
        things_[kept++] = things_[i];
      }
    }
    count_ = kept;
  }

 private:
  std::array<Thing, kMost> things_{};
  std::size_t count_ = 0;
};

[[nodiscard]] inline double uniform_between(RandomStream& chance, double least,
                                            double most) noexcept {
  return least + (most - least) * chance.uniform();
}

[[nodiscard]] inline std::uint32_t pings_between(RandomStream& chance, std::uint32_t least,
                                                 std::uint32_t most) noexcept {
  return least + static_cast<std::uint32_t>(chance.uniform() * (most - least + 1));
}

// A number of things in a ping, so many on average.
[[nodiscard]] inline std::uint32_t how_many(RandomStream& chance, double average) noexcept {
  return static_cast<std::uint32_t>(average + chance.uniform());
}

}  // namespace lodesman
