// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/replay/publication_log.h"

#include <algorithm>
#include <memory>
#include <type_traits>
#include <utility>

#include "mid_level/blackboard/blackboard.h"

namespace lodesman::cli {

std::uint64_t ChannelLog::whole_number(std::uint32_t low) const noexcept {
  constexpr std::uint64_t kWrap = std::uint64_t{1} << 32U;
  const std::uint64_t number = newest_ / kWrap * kWrap + low;
  return number + kWrap / 2 < newest_ ? number + kWrap : number;
}

bool ChannelLog::add(Recorded recorded) {
  if (recorded.sequence <= newest_ || recorded.raw.size() > largest_bytes_) {
    return false;
  }
  newest_ = recorded.sequence;
  ++count_;
  bytes_ += recorded.raw.size();
  kept_.push_back(std::move(recorded));
  return true;
}

const Recorded* ChannelLog::after(std::uint64_t sequence) const noexcept {
  const auto found = std::upper_bound(
      kept_.begin(), kept_.end(), sequence,
      [](std::uint64_t number, const Recorded& one) { return number < one.sequence; });
  return found == kept_.end() ? nullptr : &*found;
}

std::uint64_t ChannelLog::newest_by(Time stamp) const noexcept {
  const auto found = std::find_if(kept_.rbegin(), kept_.rend(),
                                  [stamp](const Recorded& one) { return one.stamp <= stamp; });
  return found == kept_.rend() ? 0 : found->sequence;
}

void ChannelLog::forget_before(Time stamp) {
  while (kept_.size() > depth_ && kept_[depth_].stamp < stamp) {
    bytes_ -= kept_.front().raw.size();
    kept_.pop_front();
  }
}

PublicationLog empty_log() {
  PublicationLog log;
  const auto board = std::make_unique<Blackboard>();
  for_each_channel(*board, [&](const ChannelInfo& /*info*/, const auto& channel) {
    using T = typename std::remove_cvref_t<decltype(channel)>::Value;
    log.emplace_back(channel.kSlots, sizeof(T));
  });
  return log;
}

}  // namespace lodesman::cli
