// SPDX-License-Identifier: Apache-2.0
// How a message names its own fields and what they may hold, so that the layout hash, the recording
// hash, every printer and every check walk the same list and none of them sees padding bytes. Any
// thread.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "mid_level/base/time.h"

namespace lodesman {

// What angles lie within, with room for their last bit.
inline constexpr double kHalfTurn_rad = 3.1415926536;

// What a number of a message may be. Without a word of its own a number that counts something is
// free, and one that measures something is finite and below what anything on a boat can be.
struct Bounds {
  double least = -1e9;    // [-] in the unit of its field
  double most = 1e9;      // [-]
  bool infinite = false;  // plus infinity too: nothing there

  friend constexpr bool operator==(const Bounds&, const Bounds&) = default;
};

template <class M, class T>
struct Field {
  const char* name = nullptr;
  T M::*member = nullptr;
  Bounds bounds{};

  [[nodiscard]] constexpr Field within(double least, double most) const noexcept {
    return {name, member, {least, most, bounds.infinite}};
  }
  [[nodiscard]] constexpr Field or_infinite() const noexcept {
    return {name, member, {bounds.least, bounds.most, true}};
  }
};

// An array of which only the first `count` elements mean anything. Where it is the last member of
// its message, publishing copies no more than is used.
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

// The fields of a message in their order, to be handed to a visitor all at once: fields()(visitor).
// Flat, where a std::tuple of so many would cost each source file seconds.
template <class... Fields>
[[nodiscard]] constexpr auto field_list(Fields... fields) noexcept {
  return [=](auto&& visitor) { return visitor(fields...); };
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

// When what a message says was measured, where it says so: its age counts from then.
template <class M>
concept HasMeasuredAt = requires(const M& m) {
  { m.measured_at() } -> std::same_as<Time>;
};

// The names of an enum's values, which count up from 0 to kLast. Beside each enum that is a field
// of a message stands `constexpr auto enumerators(E)`, which gives them.
template <auto kLast, class... Names>
[[nodiscard]] consteval auto enumerators_to(Names... names) noexcept {
  static_assert(sizeof...(Names) == static_cast<std::size_t>(kLast) + 1, "a name for each value");
  return std::array<const char*, sizeof...(Names)>{names...};
}

template <class E>
concept HasEnumerators = std::is_enum_v<E> && requires(E e) {
  enumerators(e).size();
};

template <HasEnumerators E>
[[nodiscard]] constexpr const char* to_string(E value) noexcept {
  constexpr auto kNames = enumerators(E{});
  const auto index = static_cast<std::size_t>(value);
  return index < kNames.size() ? kNames[index] : "unknown";
}

// Calls sink(name, scalar) for every scalar in order; scalars are arithmetic values, with enums
// and times given as their integers. A counted array of bytes is given as sink(name, data, count).
// A sink with `static constexpr bool kSkipMeasured = true` is not shown measured wall times. The
// message is one whose counts are in range, as every Reader hands it out.
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
  M::fields()([&](const auto&... f) { (visit_one(f), ...); });
}

template <class Sink, class T>
void visit_value(Sink& sink, const char* name, const T& value) {
  if constexpr (HasFields<T>) {
    visit_message(sink, value);
  } else if constexpr (std::is_same_v<T, Time>) {
    sink(name, value.time_since_epoch().count());
  } else if constexpr (std::is_same_v<T, Duration>) {
    sink(name, value.count());
  } else if constexpr (std::is_enum_v<T>) {
    sink(name, static_cast<std::underlying_type_t<T>>(value));
  } else if constexpr (std::is_arithmetic_v<T>) {
    sink(name, value);
  } else {
    visit_elements(sink, name, value, value.size());
  }
}

}  // namespace lodesman
