// SPDX-License-Identifier: Apache-2.0
// How a message names its own fields, so that the layout hash, the recording hash and every
// printer walk the same list and none of them sees padding bytes. Any thread.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <type_traits>

#include "mid_level/base/time.h"

namespace lodesman {

template <class M, class T>
struct Field {
  const char* name;
  T M::*member;
};

// An array of which only the first `count` elements mean anything. It is the last member of its
// message, so that publishing copies no more than is used.
template <class M, class T, class C>
struct CountedField {
  const char* name;
  T M::*member;
  C M::*count;
};

template <class M, class T>
[[nodiscard]] constexpr Field<M, T> field(const char* name, T M::*member) noexcept {
  return {name, member};
}
template <class M, class T, class C>
[[nodiscard]] constexpr CountedField<M, T, C> field(const char* name, T M::*member,
                                                    C M::*count) noexcept {
  return {name, member, count};
}

// A wall time that was measured: shown and recorded, but no part of what a run decided.
template <class M, class T>
struct MeasuredField {
  const char* name;
  T M::*member;
  static constexpr bool kMeasured = true;
};
template <class M, class T>
[[nodiscard]] constexpr MeasuredField<M, T> measured_field(const char* name,
                                                           T M::*member) noexcept {
  return {name, member};
}

template <class M>
concept HasFields = requires {
  M::fields();
};

template <class M>
concept HasUsedBytes = requires(const M& m) {
  { m.used_bytes() } -> std::same_as<std::size_t>;
};

// What of a message must be copied: all of it, or all up to the end of its counted tail.
template <class M>
[[nodiscard]] constexpr std::size_t used_bytes(const M& message) noexcept {
  if constexpr (HasUsedBytes<M>) {
    return message.used_bytes();
  } else {
    return sizeof(M);
  }
}

// Calls sink(name, scalar) for every scalar in order; scalars are arithmetic values, with enums
// and times given as their integers. A counted tail of bytes is given as sink(name, data, count).
// A sink with `static constexpr bool kSkipMeasured = true` is not shown measured wall times.
template <class Sink, class T>
void visit_value(Sink& sink, const char* name, const T& value);

template <class Sink, class T>
void visit_elements(Sink& sink, const char* name, const T& array, std::size_t count) {
  using Element = typename T::value_type;
  if constexpr (std::is_same_v<Element, std::uint8_t>) {
    sink(name, array.data(), count);
  } else {
    for (std::size_t i = 0; i < count; ++i) {
      visit_value(sink, name, array[i]);
    }
  }
}

template <class Sink, class M>
void visit_message(Sink& sink, const M& message) {
  const auto visit_one = [&](const auto& f) {
    if constexpr (
        requires { f.kMeasured; } && requires { Sink::kSkipMeasured; }) {
      return;
    } else if constexpr (requires { f.count; }) {
      visit_elements(sink, f.name, message.*(f.member),
                     static_cast<std::size_t>(message.*(f.count)));
    } else {
      visit_value(sink, f.name, message.*(f.member));
    }
  };
  std::apply([&](const auto&... f) { (visit_one(f), ...); }, M::fields());
}

template <class Sink, class T>
void visit_value(Sink& sink, const char* name, const T& value) {
  if constexpr (HasFields<T>) {
    visit_message(sink, value);
  } else if constexpr (std::is_same_v<T, Time> || std::is_same_v<T, Duration>) {
    if constexpr (std::is_same_v<T, Time>) {
      sink(name, value.time_since_epoch().count());
    } else {
      sink(name, value.count());
    }
  } else if constexpr (std::is_enum_v<T>) {
    sink(name, static_cast<std::underlying_type_t<T>>(value));
  } else if constexpr (std::is_arithmetic_v<T>) {
    sink(name, value);
  } else {
    visit_elements(sink, name, value, value.size());
  }
}

}  // namespace lodesman
