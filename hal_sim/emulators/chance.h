// SPDX-License-Identifier: Apache-2.0
// How often and for how long things go wrong. Each draws from the stream of the fault that asks,
// and always the same number of times; one thread.
#pragma once

#include <cmath>
#include <cstdint>

#include "mid_level/base/random_stream.h"
#include "mid_level/base/time.h"

namespace lodesman::emulated {

[[nodiscard]] inline bool happens(RandomStream& stream, double chance) noexcept {
  return stream.uniform() < chance;
}

// [0, count)
[[nodiscard]] inline std::uint32_t one_of(RandomStream& stream, std::uint32_t count) noexcept {
  return static_cast<std::uint32_t>(stream.uniform() * static_cast<double>(count));
}

[[nodiscard]] inline Duration uniform_between(RandomStream& stream, Duration least,
                                              Duration most) noexcept {
  return least + from_seconds(to_seconds(most - least) * stream.uniform());
}

// As often between 0.1 and 1 s as between 1 and 10 s.
[[nodiscard]] inline Duration log_uniform(RandomStream& stream, Duration least,
                                          Duration most) noexcept {
  const double ratio = to_seconds(most) / to_seconds(least);
  return from_seconds(to_seconds(least) * std::pow(ratio, stream.uniform()));
}

// The time to the next of things that do not wait for one another.
[[nodiscard]] inline double exponential(RandomStream& stream) noexcept {
  return -std::log(stream.uniform());
}

// Tells when the next of things happens whose rate may change: they become due as the rate adds up
// over the time that passes.
class Recurrence {
 public:
  // Whether one has happened while `passed` went by at this rate; more than one count as one.
  [[nodiscard]] bool due(RandomStream& stream, double rate_per_s, Duration passed) noexcept {
    if (!drawn_) {
      left_ = exponential(stream);
      drawn_ = true;
    }
    left_ -= rate_per_s * to_seconds(passed);
    if (left_ > 0.0) {
      return false;
    }
    drawn_ = false;
    return true;
  }

 private:
  bool drawn_ = false;
  double left_ = 0.0;
};

}  // namespace lodesman::emulated
