// SPDX-License-Identifier: Apache-2.0
// Channels by their places in for_each_channel(), which messages and recordings can name. Any
// thread; not for steps.
#pragma once

#include <cstdint>
#include <string_view>

#include "mid_level/base/check.h"
#include "mid_level/blackboard/blackboard.h"

namespace lodesman {

// The place of the one channel that is looked for.
template <class Is>
[[nodiscard]] std::uint64_t place_where(const Blackboard& board, Is is_it) {
  std::uint64_t place = 0;
  std::uint64_t found = 0;
  bool is_found = false;
  for_each_channel(board, [&](const ChannelInfo& info, const auto& channel) {
    if (is_it(info, channel)) {
      found = place;
      is_found = true;
    }
    ++place;
  });
  LODESMAN_CHECK(is_found);
  return found;
}

[[nodiscard]] inline std::uint64_t place_named(const Blackboard& board, std::string_view name) {
  return place_where(board, [name](const ChannelInfo& info, const auto& /*channel*/) {
    return info.name == name;
  });
}

[[nodiscard]] inline std::uint64_t place_of(const Blackboard& board, const ChannelLook<>& reader) {
  return place_where(board, [&reader](const ChannelInfo& /*info*/, const auto& channel) {
    return &channel.head.newest == reader.channel();
  });
}

}  // namespace lodesman
