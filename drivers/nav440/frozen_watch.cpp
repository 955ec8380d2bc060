// SPDX-License-Identifier: Apache-2.0
#include "drivers/nav440/frozen_watch.h"

#include <algorithm>
#include <bit>

namespace lodesman::nav440 {
namespace {

constexpr std::size_t kBitSize = 2;
constexpr int kFewest = 8;
constexpr int kMost = 64;  // bits of the past
// Known within a second, the packet in which it shows included.
constexpr int kTenthsOfASecond = 8;
// So many of four packets differ, of a unit that flickers.
constexpr int kLivelyOfFour = 3;

}  // namespace

FrozenWatch::FrozenWatch(int rate_hz) noexcept
    : looked_back_{std::clamp(rate_hz, kFewest, kMost)},
      repeats_needed_{std::max(rate_hz * kTenthsOfASecond / 10, 2)} {}

void FrozenWatch::restart() noexcept {
  size_ = 0;
  past_ = 0;
  repeats_ = 0;
  was_lively_ = false;
}

bool FrozenWatch::frozen(PacketType type, Bytes payload) noexcept {
  const bool repeated = repeats(type, payload);
  if (!repeated) {
    repeats_ = 0;
  } else if (++repeats_; repeats_ == 1) {
    const std::uint64_t looked_at =
        looked_back_ == kMost ? past_ : past_ & ((std::uint64_t{1} << looked_back_) - 1);
    was_lively_ = 4 * std::popcount(looked_at) >= kLivelyOfFour * looked_back_;
  }
  past_ = (past_ << 1U) | (repeated ? 0U : 1U);
  repeats_ = std::min(repeats_, repeats_needed_);
  return was_lively_ && repeats_ >= repeats_needed_;
}

bool FrozenWatch::repeats(PacketType type, Bytes payload) noexcept {
  const TimeField time = time_field(type);
  const std::size_t size = std::min(payload.size() - kBitSize, last_.size());
  bool same = size == size_;
  for (std::size_t i = 0; i < size; ++i) {
    if (i < time.at || i >= time.at + time.size) {
      same = same && last_[i] == payload[i];
      last_[i] = payload[i];
    }
  }
  size_ = size;
  return same;
}

}  // namespace lodesman::nav440
