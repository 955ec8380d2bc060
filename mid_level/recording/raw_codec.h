// SPDX-License-Identifier: Apache-2.0
// Messages as they lie in memory, for exact replay: the bytes of each field at its own offset, all
// others zero, up to the message's used bytes. Beside them a text that says where everything lies,
// so that whoever reads it needs no header of ours. Pure functions; any thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <type_traits>

#include "mid_level/base/check.h"
#include "mid_level/messages/layout.h"
#include "mid_level/messages/sane.h"

namespace lodesman {

namespace detail {

template <class T>
void put_raw(const T& value, std::byte* to) noexcept;

template <class T>
void put_raw_elements(const T& array, std::size_t count, std::byte* to) noexcept {
  using Element = typename T::value_type;
  if constexpr (std::is_arithmetic_v<Element>) {
    std::memcpy(to, array.data(), count * sizeof(Element));
  } else {
    for (std::size_t i = 0; i < count; ++i) {
      put_raw(array[i], to + i * sizeof(Element));
    }
  }
}

template <class T>
void put_raw(const T& value, std::byte* to) noexcept {
  if constexpr (HasFields<T>) {
    const auto put_field = [&](const auto& f) {
      std::byte* place = to + offset_of(value, f.member);
      if constexpr (requires { f.count; }) {
        put_raw_elements(value.*(f.member), static_cast<std::size_t>(value.*(f.count)), place);
      } else {
        put_raw(value.*(f.member), place);
      }
    };
    T::fields()([&](const auto&... f) { (put_field(f), ...); });
  } else if constexpr (kind_of<T>() == FieldKind::kArray) {
    put_raw_elements(value, value.size(), to);
  } else {
    std::memcpy(to, &value, sizeof value);
  }
}

[[nodiscard]] constexpr const char* raw_kind(FieldKind kind) noexcept {
  switch (kind) {
    case FieldKind::kBool: return "bool";
    case FieldKind::kSigned: return "signed";
    case FieldKind::kUnsigned: return "unsigned";
    case FieldKind::kFloating: return "floating";
    case FieldKind::kEnum: return "enum";
    case FieldKind::kTime: return "time";
    case FieldKind::kDuration: return "duration";
    case FieldKind::kMessage: return "message";
    case FieldKind::kArray: return "array";
  }
  return "";
}

template <class T>
void put_layout(std::string& text);

template <class M, class F>
void put_field_layout(std::string& text, const M& message, const F& f) {
  using T = std::remove_cvref_t<decltype(message.*(f.member))>;
  text += text.back() == '[' ? "" : ",";
  text += R"({"name":")" + std::string{f.name} + R"(","offset":)" +
          std::to_string(offset_of(message, f.member));
  if constexpr (requires { f.count; }) {
    text += R"(,"count_offset":)" + std::to_string(offset_of(message, f.count)) +
            R"(,"count_size":)" + std::to_string(sizeof(message.*(f.count)));
  }
  if constexpr (requires { f.kMeasured; }) {
    text += R"(,"measured":true)";
  }
  text += R"(,"type":)";
  put_layout<T>(text);
  text += "}";
}

template <class T>
void put_layout(std::string& text) {
  text += R"({"kind":")" + std::string{raw_kind(kind_of<T>())} + R"(","size":)" +
          std::to_string(sizeof(T));
  if constexpr (HasFields<T>) {
    text += R"(,"fields":[)";
    const auto message = std::make_unique<T>();
    T::fields()([&](const auto&... f) { (put_field_layout(text, *message, f), ...); });
    text += "]";
  } else if constexpr (std::is_enum_v<T>) {
    text += R"(,"names":[)";
    for (const char* name : enumerators(T{})) {
      text += std::string{text.back() == '[' ? "" : ","} + '"' + name + '"';
    }
    text += "]";
  } else if constexpr (kind_of<T>() == FieldKind::kArray) {
    text += R"(,"length":)" + std::to_string(std::tuple_size_v<T>) + R"(,"of":)";
    put_layout<typename T::value_type>(text);
  }
  text += "}";
}

}  // namespace detail

// Into as many bytes as the message uses. Its counts are in range, as in all that a Reader gives.
template <class M>
void encode_raw(const M& message, std::span<std::byte> to) noexcept {
  LODESMAN_CHECK(to.size() == used_bytes(message));
  std::memset(to.data(), 0, to.size());
  detail::put_raw(message, to.data());
}

// Any bytes; false where they are no sane message, which is as it was then.
template <class M>
[[nodiscard]] bool decode_raw(std::span<const std::byte> from, M& message) {
  if (from.size() > sizeof(M)) {
    return false;
  }
  const auto decoded = std::make_unique<M>();
  std::memcpy(reinterpret_cast<std::byte*>(decoded.get()), from.data(), from.size());
  if (!sane(*decoded) || used_bytes(*decoded) != from.size()) {
    return false;
  }
  message = *decoded;
  return true;
}

// JSON: kinds, sizes, offsets in bytes, an array's length, an enum's names. What two builds must
// have in common for the one to read the other's recordings; what values are sane is no part of it.
template <class M>
[[nodiscard]] std::string raw_layout() {
  std::string text;
  detail::put_layout<M>(text);
  return text;
}

}  // namespace lodesman
