// SPDX-License-Identifier: Apache-2.0
// What a recording has of each channel, by number, as far back as anybody may still ask. One
// thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "mid_level/base/time.h"

namespace lodesman::cli {

struct Recorded {
  std::uint64_t sequence = 0;
  Time stamp{};
  std::vector<std::byte> raw;
};

class ChannelLog {
 public:
  // `depth`: of the channel's ring.
  explicit ChannelLog(std::size_t depth) : depth_{depth} {}

  // The whole number, where a file has its low half.
  [[nodiscard]] std::uint64_t whole_number(std::uint32_t low) const noexcept;
  // False where it is known already.
  bool add(Recorded recorded);

  // The first after that number; nullptr where there is none (yet).
  [[nodiscard]] const Recorded* after(std::uint64_t sequence) const noexcept;
  // 0 as long as there was none.
  [[nodiscard]] std::uint64_t newest() const noexcept { return newest_; }
  // The last that was published by then; 0: none is known.
  [[nodiscard]] std::uint64_t newest_by(Time stamp) const noexcept;
  [[nodiscard]] std::size_t depth() const noexcept { return depth_; }
  [[nodiscard]] std::size_t bytes() const noexcept { return bytes_; }

  // What is older is not asked for any more, but for what the ring would still hold.
  void forget_before(Time stamp);

 private:
  std::size_t depth_;
  std::uint64_t newest_ = 0;
  std::size_t bytes_ = 0;
  std::deque<Recorded> kept_;
};

// By the channel's place in for_each_channel().
using PublicationLog = std::vector<ChannelLog>;
[[nodiscard]] PublicationLog empty_log();

}  // namespace lodesman::cli
