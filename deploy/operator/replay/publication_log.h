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
  // `depth`: of the channel's ring. `largest_bytes`: of its messages.
  ChannelLog(std::size_t depth, std::size_t largest_bytes)
      : depth_{depth}, largest_bytes_{largest_bytes} {}

  // The whole number, where a file has its low half.
  [[nodiscard]] std::uint64_t whole_number(std::uint32_t low) const noexcept;
  // False where its number does not go on from the newest, or it is too large to be of the channel.
  bool add(Recorded recorded);

  // The first after that number; nullptr where there is none (yet).
  [[nodiscard]] const Recorded* after(std::uint64_t sequence) const noexcept;
  // 0 as long as there was none.
  [[nodiscard]] std::uint64_t newest() const noexcept { return newest_; }
  // The last that was published by then; 0: none is known.
  [[nodiscard]] std::uint64_t newest_by(Time stamp) const noexcept;
  [[nodiscard]] std::size_t depth() const noexcept { return depth_; }
  // In memory.
  [[nodiscard]] std::size_t bytes() const noexcept {
    return bytes_ + kept_.size() * sizeof(Recorded);
  }
  // That were added.
  [[nodiscard]] std::uint64_t count() const noexcept { return count_; }

  // What is older is not asked for any more, but for what the ring would still hold.
  void forget_before(Time stamp);

  // The recording's messages of it are another build's.
  void leave_out() noexcept { left_out_ = true; }
  [[nodiscard]] bool is_left_out() const noexcept { return left_out_; }

 private:
  std::size_t depth_;
  std::size_t largest_bytes_;
  bool left_out_ = false;
  std::uint64_t count_ = 0;
  std::uint64_t newest_ = 0;
  std::size_t bytes_ = 0;
  std::deque<Recorded> kept_;
};

// By the channel's place in for_each_channel().
using PublicationLog = std::vector<ChannelLog>;
[[nodiscard]] PublicationLog empty_log();

}  // namespace lodesman::cli
