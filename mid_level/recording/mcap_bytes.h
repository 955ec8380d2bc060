// SPDX-License-Identifier: Apache-2.0
// Numbers, texts and maps as MCAP has them, put one after another and taken one after another.
// Taking past the end gives zeros and is remembered, so that any bytes may be taken apart. One
// thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mid_level/recording/mcap_format.h"

namespace lodesman {

class McapPutter {
 public:
  template <class Number>
  void number(Number value) {
    static_assert(std::is_unsigned_v<Number>);
    for (std::size_t i = 0; i < sizeof(Number); ++i) {
      bytes_.push_back(static_cast<std::byte>(static_cast<std::uint64_t>(value) >> (8 * i)));
    }
  }
  void opcode(McapOpcode code) { bytes_.push_back(static_cast<std::byte>(code)); }
  void raw(std::span<const std::byte> bytes) {
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }
  void magic() { raw(std::as_bytes(std::span{kMcapMagic})); }
  void text(std::string_view text) {
    number(static_cast<std::uint32_t>(text.size()));
    raw(std::as_bytes(std::span{text.data(), text.size()}));
  }
  void map(const std::map<std::string, std::string>& values) {
    const std::size_t place = begin<std::uint32_t>();
    for (const auto& [key, value] : values) {
      text(key);
      text(value);
    }
    end<std::uint32_t>(place);
  }
  // A length that is put in once what it counts is there.
  template <class Length>
  [[nodiscard]] std::size_t begin() {
    number(Length{0});
    return bytes_.size();
  }
  template <class Length>
  void end(std::size_t place) {
    const std::uint64_t length = bytes_.size() - place;
    for (std::size_t i = 0; i < sizeof(Length); ++i) {
      bytes_[place - sizeof(Length) + i] = static_cast<std::byte>(length >> (8 * i));
    }
  }
  [[nodiscard]] std::size_t begin_record(McapOpcode code) {
    opcode(code);
    return begin<std::uint64_t>();
  }
  void end_record(std::size_t place) { end<std::uint64_t>(place); }

  [[nodiscard]] std::span<const std::byte> bytes() const noexcept { return bytes_; }
  [[nodiscard]] std::size_t size() const noexcept { return bytes_.size(); }
  void clear() noexcept { bytes_.clear(); }

 private:
  std::vector<std::byte> bytes_;
};

class McapTaker {
 public:
  explicit McapTaker(std::span<const std::byte> bytes) noexcept : left_{bytes} {}

  template <class Number>
  [[nodiscard]] Number number() noexcept {
    static_assert(std::is_unsigned_v<Number>);
    const auto bytes = raw(sizeof(Number));
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      value |= std::to_integer<std::uint64_t>(bytes[i]) << (8 * i);
    }
    return static_cast<Number>(value);
  }
  // Empty where there are not so many.
  [[nodiscard]] std::span<const std::byte> raw(std::uint64_t count) noexcept {
    if (count > left_.size()) {
      whole_ = false;
      left_ = {};
      return {};
    }
    const auto taken = left_.first(static_cast<std::size_t>(count));
    left_ = left_.subspan(taken.size());
    return taken;
  }
  [[nodiscard]] std::string text() {
    const auto bytes = raw(number<std::uint32_t>());
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }
  [[nodiscard]] std::map<std::string, std::string> map() {
    McapTaker pairs{raw(number<std::uint32_t>())};
    std::map<std::string, std::string> values;
    while (pairs.whole_ && !pairs.left_.empty()) {
      std::string key = pairs.text();
      values[std::move(key)] = pairs.text();
    }
    whole_ = whole_ && pairs.whole_;
    return values;
  }
  [[nodiscard]] std::span<const std::byte> rest() noexcept { return raw(left_.size()); }
  [[nodiscard]] bool is_whole() const noexcept { return whole_; }
  [[nodiscard]] bool is_empty() const noexcept { return left_.empty(); }

 private:
  std::span<const std::byte> left_;
  bool whole_ = true;
};

}  // namespace lodesman
