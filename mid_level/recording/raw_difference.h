// SPDX-License-Identifier: Apache-2.0
// Where two messages of one type differ first, in the order of their fields: bit by bit, but that
// one NaN is as good as another, and without measured wall times. Pure functions; any thread.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <type_traits>

#include "mid_level/messages/fields.h"
#include "mid_level/messages/layout.h"

namespace lodesman {

struct FieldDifference {
  std::string path;  // waypoints[2].x_m
  std::string recorded;
  std::string replayed;
};

namespace detail {

template <class T>
[[nodiscard]] std::string text_of_value(const T& value) {
  char text[64];
  if constexpr (std::is_same_v<T, bool>) {
    return value ? "true" : "false";
  } else if constexpr (std::is_enum_v<T>) {
    return to_string(value);
  } else if constexpr (std::is_same_v<T, Time>) {
    std::snprintf(text, sizeof text, "%.9f s", to_seconds(value.time_since_epoch()));
    return text;
  } else if constexpr (std::is_same_v<T, Duration>) {
    std::snprintf(text, sizeof text, "%.9f s", to_seconds(value));
    return text;
  } else if constexpr (std::is_floating_point_v<T>) {
    std::snprintf(text, sizeof text, "%.17g", static_cast<double>(value));
    return text;
  } else {
    return std::to_string(value);
  }
}

template <class T>
[[nodiscard]] bool is_same_value(const T& one, const T& other) noexcept {
  if constexpr (std::is_floating_point_v<T>) {
    using Bits = std::conditional_t<sizeof(T) == 8, std::uint64_t, std::uint32_t>;
    return std::bit_cast<Bits>(one) == std::bit_cast<Bits>(other) ||
           (std::isnan(one) && std::isnan(other));
  } else {
    return one == other;
  }
}

[[nodiscard]] inline FieldDifference below(std::string name, FieldDifference inner) {
  const bool joins = inner.path.empty() || inner.path.front() == '[';
  inner.path = std::move(name) + (joins ? "" : ".") + inner.path;
  return inner;
}

template <class T>
[[nodiscard]] std::optional<FieldDifference> difference_of(const T& recorded, const T& replayed);

template <class T>
[[nodiscard]] std::optional<FieldDifference> difference_of_elements(const T& recorded,
                                                                    const T& replayed,
                                                                    std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    if (auto inner = difference_of(recorded[i], replayed[i])) {
      return below("[" + std::to_string(i) + "]", std::move(*inner));
    }
  }
  return std::nullopt;
}

template <class M, class F>
[[nodiscard]] std::optional<FieldDifference> difference_of_field(const M& recorded,
                                                                 const M& replayed, const F& f) {
  std::optional<FieldDifference> inner;
  if constexpr (requires { f.kMeasured; }) {
    return std::nullopt;
  } else if constexpr (requires { f.count; }) {
    const auto count = recorded.*(f.count);
    if (count != replayed.*(f.count)) {
      return FieldDifference{std::string{f.name} + " (how many)", std::to_string(count),
                             std::to_string(replayed.*(f.count))};
    }
    inner = difference_of_elements(recorded.*(f.member), replayed.*(f.member),
                                   static_cast<std::size_t>(count));
  } else {
    inner = difference_of(recorded.*(f.member), replayed.*(f.member));
  }
  return inner ? std::optional{below(f.name, std::move(*inner))} : std::nullopt;
}

template <class T>
std::optional<FieldDifference> difference_of(const T& recorded, const T& replayed) {
  if constexpr (HasFields<T>) {
    std::optional<FieldDifference> first;
    T::fields()([&](const auto&... f) {
      (void)((first = difference_of_field(recorded, replayed, f), first.has_value()) || ...);
    });
    return first;
  } else if constexpr (kind_of<T>() == FieldKind::kArray) {
    return difference_of_elements(recorded, replayed, recorded.size());
  } else {
    return is_same_value(recorded, replayed)
               ? std::nullopt
               : std::optional{
                     FieldDifference{{}, text_of_value(recorded), text_of_value(replayed)}};
  }
}

}  // namespace detail

// Of two messages whose counts are in range; nothing where they are the same.
template <HasFields M>
[[nodiscard]] std::optional<FieldDifference> first_difference(const M& recorded,
                                                              const M& replayed) {
  return detail::difference_of(recorded, replayed);
}

}  // namespace lodesman
