// SPDX-License-Identifier: Apache-2.0
// Which session of the command socket gives up its place when one more comes and none is left. A
// pure choice; the socket's thread.
#pragma once

#include <cstdint>
#include <span>

#include "high_level/mission/network.h"
#include "mid_level/base/time.h"

namespace lodesman {

// Sessions at once, and how many of them may be strangers, who have not shown or proved a token.
inline constexpr std::size_t kMaxSessions = 128;
inline constexpr std::size_t kMaxStrangers = 64;

// In the order in which places are given up.
enum class Standing : std::uint8_t { kStranger, kKnown, kAwaitsAnswer, kAwaitsAbort };

struct SessionPlace {
  Standing standing = Standing::kStranger;
  NetworkId network = kOwnMachine;
  Time heard{};  // when its last line came
};

// Who has been silent longest: of the strangers where they fill their places, else of those that
// showed a token. Of the strangers those of the network first that has most of them, and this
// machine's last: a crowd elsewhere puts out its own. A stranger is thus given the time to speak
// that it takes as many others to come. Where all wait for an answer, the last to ask: the first is
// about to have its own. `places.size()` where nobody may be put out: all wait for their aborts.
[[nodiscard]] std::size_t whose_place_to_give(std::span<const SessionPlace> places);

}  // namespace lodesman
