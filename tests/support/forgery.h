// SPDX-License-Identifier: Apache-2.0
// Writes into a blackboard what no writer of ours would: random bytes and heads, or values in place
// of one just published that are not sane. One thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <random>
#include <vector>

#include "mid_level/blackboard/blackboard.h"

namespace lodesman::testing {

template <class Board>
[[nodiscard]] std::size_t channels_of(Board& board) {
  std::size_t count = 0;
  for_each_channel(board, [&](const ChannelInfo& /*info*/, auto& /*channel*/) { ++count; });
  return count;
}

template <class T>
void put_words(ChannelSlot<T>& slot, const T& value) noexcept {
  std::array<std::uint64_t, ChannelSlot<T>::kWords> words{};
  std::memcpy(words.data(), &value, sizeof value);
  for (std::size_t i = 0; i < words.size(); ++i) {
    slot.words[i].store(words[i], std::memory_order_release);
  }
}

template <class T>
void get_words(const ChannelSlot<T>& slot, T& value) noexcept {
  std::array<std::uint64_t, ChannelSlot<T>::kWords> words{};
  for (std::size_t i = 0; i < words.size(); ++i) {
    words[i] = slot.words[i].load(std::memory_order_acquire);
  }
  std::memcpy(reinterpret_cast<std::byte*>(&value), words.data(), sizeof value);
}

// Any bytes in any place of a blackboard's channels.
class RandomForger {
 public:
  explicit RandomForger(std::uint64_t seed) : random_{seed} {}

  // One forgery in one channel.
  void forge(Blackboard& board) {
    const std::size_t chosen = random_() % channels_of(board);
    std::size_t index = 0;
    for_each_channel(board, [&](const ChannelInfo& /*info*/, auto& channel) {
      if (index++ == chosen) {
        forge_in(channel);
      }
    });
  }

 private:
  template <class T, std::size_t kDepth>
  void forge_in(Channel<T, kDepth>& channel) {
    const std::uint64_t newest = channel.head.newest.load();
    // What is newest is read; all else is of little interest.
    const std::uint64_t aimed = random_() % 4 != 0 ? newest : random_();
    auto& slot = channel.slots[aimed % kDepth];
    switch (random_() % 8) {
      case 0: channel.head.newest.store(odd_number(newest)); break;
      case 1: slot.version.store(odd_number(2 * newest)); break;
      case 2:
        slot.stamp_ns.store(static_cast<std::int64_t>(
            odd_number(static_cast<std::uint64_t>(slot.stamp_ns.load()))));
        break;
      case 3: slot.bytes.store(odd_number(slot.bytes.load())); break;
      default: forge_bytes(slot); break;
    }
  }

  // Near the right number, or anything.
  [[nodiscard]] std::uint64_t odd_number(std::uint64_t right) {
    switch (random_() % 4) {
      case 0: return right + random_() % 16 - 8;
      case 1: return right ^ (std::uint64_t{1} << (random_() % 64));
      case 2: return 0;
      default: return random_();
    }
  }

  template <class T>
  void forge_bytes(ChannelSlot<T>& slot) {
    const std::size_t words = std::min<std::size_t>(ChannelSlot<T>::kWords, 64);
    for (std::size_t i = 1 + random_() % 4; i > 0; --i) {
      auto& word = slot.words[random_() % words];
      const std::uint64_t mask =
          random_() % 2 == 0 ? ~std::uint64_t{0} : std::uint64_t{0xff} << (8 * (random_() % 8));
      word.store((word.load() & ~mask) | (random_() & mask));
    }
  }

  std::mt19937_64 random_;
};

// What becomes of a share of the publications.
enum class Spoil : std::uint8_t {
  kNotSane,  // it holds what is not sane
  kAbsent,   // it was never made
};

// Follows a board and spoils a share of what is published on it, the same ones for either kind.
class PublicationSpoiler {
 public:
  PublicationSpoiler(Spoil kind, std::uint64_t seed, std::uint64_t one_in)
      : kind_{kind}, choice_{seed}, bytes_{seed + 1}, one_in_{one_in} {}

  // To be called after every step of a task: at most one publication a channel has come since.
  void follow(Blackboard& board) {
    std::size_t index = 0;
    seen_.resize(channels_of(board));
    whole_.resize(seen_.size());
    for_each_channel(board, [&](const ChannelInfo& /*info*/, auto& channel) {
      const std::uint64_t newest = channel.head.newest.load();
      if (newest > seen_[index]) {
        seen_[index] = newest;
        if (choice_() % one_in_ == 0) {
          spoil(channel, newest, whole_[index]);
        } else {
          whole_[index] = newest;
        }
      }
      ++index;
    });
  }
  [[nodiscard]] std::uint64_t spoilt() const noexcept { return spoilt_; }

 private:
  template <class T, std::size_t kDepth>
  void spoil(Channel<T, kDepth>& channel, std::uint64_t newest, std::uint64_t before) {
    auto& slot = channel.slots[newest % kDepth];
    ++spoilt_;
    if (kind_ == Spoil::kAbsent) {
      slot.version.store(0);
      channel.head.newest.store(before);
      return;
    }
    const auto value = std::make_unique<T>();
    const auto forged = std::make_unique<T>();
    get_words(slot, *value);
    for (int attempt = 0; attempt < 200; ++attempt) {
      std::memcpy(reinterpret_cast<std::byte*>(forged.get()), value.get(), sizeof(T));
      auto* bytes = reinterpret_cast<std::byte*>(forged.get());
      const std::size_t at = bytes_() % std::min<std::size_t>(sizeof(T), 512);
      const std::size_t count = std::min<std::size_t>(1 + bytes_() % 8, sizeof(T) - at);
      for (std::size_t i = 0; i < count; ++i) {
        bytes[at + i] = static_cast<std::byte>(bytes_());
      }
      if (!sane(*forged)) {
        put_words(slot, *forged);
        return;
      }
    }
    slot.bytes.store(sizeof(T) + 8);  // a message that any bytes would do for
  }

  Spoil kind_;
  std::mt19937_64 choice_;  // the same choices for either kind
  std::mt19937_64 bytes_;
  std::uint64_t one_in_;
  std::vector<std::uint64_t> seen_;   // by channel
  std::vector<std::uint64_t> whole_;  // the last one that was not spoilt
  std::uint64_t spoilt_ = 0;
};

}  // namespace lodesman::testing
