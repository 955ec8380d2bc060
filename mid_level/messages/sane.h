// SPDX-License-Identifier: Apache-2.0
// Whether a message can be believed: what comes from a device, a file, a socket or shared memory
// may hold any bytes. What is not sane is to be treated like what is missing. Pure functions; any
// thread.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "mid_level/base/time.h"
#include "mid_level/messages/fields.h"

namespace lodesman {

// Times count from the clock's start and stay so far from its end (146 years) that the sum and the
// difference of two of them are times too.
inline constexpr std::int64_t kLatest_ns = std::int64_t{1} << 62;

[[nodiscard]] constexpr bool sane(Time time) noexcept {
  const std::int64_t ns = time.time_since_epoch().count();
  return ns >= 0 && ns <= kLatest_ns;
}

// Whether counts, enums and bools are in range, numbers finite and within their bounds, and what
// belongs together fits. Nothing is read as an enum or a bool before its bytes have been looked at,
// so that any bytes may be asked about.
template <HasFields M>
[[nodiscard]] bool sane(const M& message) noexcept;

namespace detail {

template <class T>
[[nodiscard]] bool sane_value(const T& value, const Bounds& bounds) noexcept {
  if constexpr (HasFields<T>) {
    return sane(value);
  } else if constexpr (std::is_same_v<T, Time>) {
    return lodesman::sane(value);
  } else if constexpr (std::is_same_v<T, Duration>) {
    return value.count() >= -kLatest_ns && value.count() <= kLatest_ns;
  } else if constexpr (std::is_same_v<T, bool>) {
    static_assert(sizeof(bool) == 1);
    unsigned char byte = 0;
    std::memcpy(&byte, &value, 1);
    return byte <= 1;
  } else if constexpr (std::is_enum_v<T>) {
    static_assert(HasEnumerators<T>, "an enum of a message lists its enumerators");
    std::underlying_type_t<T> number{};
    static_assert(std::is_unsigned_v<decltype(number)>);
    std::memcpy(&number, &value, sizeof number);
    return number < enumerators(T{}).size();
  } else if constexpr (std::is_floating_point_v<T>) {
    return (value >= bounds.least && value <= bounds.most) ||
           (bounds.infinite && std::isinf(value) && value > 0);
  } else if constexpr (std::is_integral_v<T>) {
    return bounds == Bounds{} || (static_cast<double>(value) >= bounds.least &&
                                  static_cast<double>(value) <= bounds.most);
  } else {
    for (const auto& element : value) {
      if (!sane_value(element, bounds)) {
        return false;
      }
    }
    return true;
  }
}

template <class T>
[[nodiscard]] bool sane_elements(const T& array, std::size_t count) noexcept {
  if (count > array.size()) {
    return false;
  }
  if constexpr (!std::is_same_v<typename T::value_type, std::uint8_t>) {
    for (std::size_t i = 0; i < count; ++i) {
      if (!sane_value(array[i], Bounds{})) {
        return false;
      }
    }
  }
  return true;
}

template <class M, class F>
[[nodiscard]] bool sane_field(const M& message, const F& f) noexcept {
  if constexpr (requires { f.count; }) {
    return sane_elements(message.*(f.member), static_cast<std::size_t>(message.*(f.count)));
  } else if constexpr (requires { f.bounds; }) {
    return sane_value(message.*(f.member), f.bounds);
  } else {
    return true;  // a measured time: any count
  }
}

}  // namespace detail

template <HasFields M>
[[nodiscard]] bool sane(const M& message) noexcept {
  const bool each =
      M::fields()([&](const auto&... f) { return (detail::sane_field(message, f) && ...); });
  if constexpr (requires { message.fits(); }) {
    return each && message.fits();
  } else {
    return each;
  }
}

}  // namespace lodesman
