// SPDX-License-Identifier: Apache-2.0
#include "high_level/mission/session_places.h"

#include <algorithm>
#include <optional>
#include <tuple>

namespace lodesman {
namespace {

[[nodiscard]] bool is_stranger(const SessionPlace& place) noexcept {
  return place.standing == Standing::kStranger;
}

// How many strangers its network has; 0 for this machine's and for those that are known.
[[nodiscard]] std::ptrdiff_t crowd_of(const SessionPlace& place,
                                      std::span<const SessionPlace> places) {
  if (!is_stranger(place) || place.network == kOwnMachine) {
    return 0;
  }
  return std::count_if(places.begin(), places.end(), [&](const SessionPlace& other) {
    return is_stranger(other) && other.network == place.network;
  });
}

}  // namespace

std::size_t whose_place_to_give(std::span<const SessionPlace> places) {
  const auto strangers = std::count_if(places.begin(), places.end(), is_stranger);
  const bool of_strangers = static_cast<std::size_t>(strangers) >= kMaxStrangers;
  const auto rank = [&](const SessionPlace& place) {
    const auto heard = place.heard.time_since_epoch();
    const bool waits = place.standing >= Standing::kAwaitsAnswer;
    return std::make_tuple(place.standing == Standing::kAwaitsAbort,
                           is_stranger(place) != of_strangers, place.standing,
                           -crowd_of(place, places), waits ? -heard : heard);
  };
  std::size_t least = places.size();
  std::optional<decltype(rank(places.front()))> least_rank;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (const auto its_rank = rank(places[i]); !least_rank || its_rank < *least_rank) {
      least = i;
      least_rank = its_rank;
    }
  }
  const bool none = least == places.size() || places[least].standing == Standing::kAwaitsAbort;
  return none ? places.size() : least;
}

}  // namespace lodesman
