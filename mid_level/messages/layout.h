// SPDX-License-Identifier: Apache-2.0
// How a message's type lies in memory, field by field: what two programs must agree on to read each
// other's messages. It looks at types alone, never at values. Any thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>

#include "mid_level/messages/fields.h"

namespace lodesman {

enum class FieldKind : std::uint8_t {
  kBool,
  kSigned,
  kUnsigned,
  kFloating,
  kEnum,
  kTime,
  kDuration,
  kMessage,
  kArray,
};

template <class T>
[[nodiscard]] constexpr FieldKind kind_of() noexcept {
  if constexpr (HasFields<T>) {
    return FieldKind::kMessage;
  } else if constexpr (std::is_same_v<T, Time>) {
    return FieldKind::kTime;
  } else if constexpr (std::is_same_v<T, Duration>) {
    return FieldKind::kDuration;
  } else if constexpr (std::is_same_v<T, bool>) {
    return FieldKind::kBool;
  } else if constexpr (std::is_enum_v<T>) {
    return FieldKind::kEnum;
  } else if constexpr (std::is_floating_point_v<T>) {
    return FieldKind::kFloating;
  } else if constexpr (std::is_integral_v<T>) {
    return std::is_signed_v<T> ? FieldKind::kSigned : FieldKind::kUnsigned;
  } else {
    return FieldKind::kArray;
  }
}

// Calls sink(const char*) and sink(std::uint64_t) with all that the layout of T is: kind and size;
// a message's fields by name, offset and bounds; an array's length; an enum's enumerators.
template <class T, class Sink>
void visit_layout(Sink& sink);

namespace detail {

template <class M, class T>
[[nodiscard]] std::uint64_t offset_of(const M& message, T M::*member) noexcept {
  const auto* whole = reinterpret_cast<const std::byte*>(std::addressof(message));
  const auto* part = reinterpret_cast<const std::byte*>(std::addressof(message.*member));
  return static_cast<std::uint64_t>(part - whole);
}

template <class Sink, class M, class F>
void visit_field_layout(Sink& sink, const M& message, const F& f) {
  using T = std::remove_cvref_t<decltype(message.*(f.member))>;
  sink(f.name);
  sink(offset_of(message, f.member));
  if constexpr (requires { f.count; }) {
    sink(offset_of(message, f.count));
  }
  if constexpr (requires { f.bounds; }) {
    sink(std::to_string(f.bounds.least).c_str());
    sink(std::to_string(f.bounds.most).c_str());
    sink(std::uint64_t{f.bounds.infinite ? 1U : 0U});
  }
  visit_layout<T>(sink);
}

}  // namespace detail

template <class T, class Sink>
void visit_layout(Sink& sink) {
  sink(static_cast<std::uint64_t>(kind_of<T>()));
  sink(std::uint64_t{sizeof(T)});
  if constexpr (HasFields<T>) {
    const auto message = std::make_unique<T>();
    T::fields()([&](const auto&... f) { (detail::visit_field_layout(sink, *message, f), ...); });
  } else if constexpr (std::is_enum_v<T>) {
    for (const char* name : enumerators(T{})) {
      sink(name);
    }
  } else if constexpr (kind_of<T>() == FieldKind::kArray) {
    sink(std::uint64_t{std::tuple_size_v<T>});
    visit_layout<typename T::value_type>(sink);
  }
}

}  // namespace lodesman
