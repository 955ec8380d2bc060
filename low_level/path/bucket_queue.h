// SPDX-License-Identifier: Apache-2.0
// An open list that hands out items in order of a whole number that never falls, in constant time.
// Owned by one thread; it allocates when made and never after.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace lodesman {

// The items of a bucket are one key's; buckets are taken round and round. `reach` is how far above
// the last key handed out another may be pushed. Of items with one key the last one in is the
// first one out.
template <class Item>
class BucketQueue {
 public:
  // With room for `capacity` items at a time.
  BucketQueue(std::uint32_t reach, std::size_t capacity)
      : heads_(std::bit_ceil(reach + kBits)),
        filled_(heads_.size() / kBits),
        filled_words_((filled_.size() + kBits - 1) / kBits),
        entries_(capacity) {}

  void clear() noexcept {
    for (std::size_t i = 0; i < filled_words_.size(); ++i) {
      for (; filled_words_[i] != 0; filled_words_[i] &= filled_words_[i] - 1) {
        filled_[i * kBits + static_cast<std::size_t>(std::countr_zero(filled_words_[i]))] = 0;
      }
    }
    used_ = 0;
    spare_ = kNone;
  }

  // False where there is no room left.
  [[nodiscard]] bool push(std::uint32_t key, const Item& item) noexcept {
    std::uint32_t place = spare_;
    if (place != kNone) {
      spare_ = entries()[place].next;
    } else if (used_ < entries_.size()) {
      place = used_++;
    } else {
      return false;
    }
    const std::uint32_t bucket = key & mask();
    std::uint64_t& filled = filled_.data()[bucket / kBits];
    const std::uint64_t bit = std::uint64_t{1} << (bucket % kBits);
    entries()[place] = {item, (filled & bit) != 0 ? heads_.data()[bucket] : kNone};
    heads_.data()[bucket] = place;
    filled |= bit;
    filled_words_.data()[bucket / kBits / kBits] |= std::uint64_t{1} << (bucket / kBits % kBits);
    return true;
  }

  // The least key not below `from`, which must not be above it; false where nothing is left.
  [[nodiscard]] bool pop(std::uint32_t from, std::uint32_t& key, Item& item) noexcept {
    std::uint32_t bucket = 0;
    if (!first_filled(from & mask(), bucket)) {
      return false;
    }
    key = from + ((bucket - from) & mask());
    const std::uint32_t place = heads_.data()[bucket];
    Entry& entry = entries()[place];
    item = entry.item;
    heads_.data()[bucket] = entry.next;
    if (entry.next == kNone) {
      empty(bucket);
    }
    entry.next = spare_;
    spare_ = place;
    return true;
  }

 private:
  static constexpr std::uint32_t kBits = 64;
  static constexpr std::uint64_t kAll = ~std::uint64_t{0};
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  struct Entry {
    Item item;
    std::uint32_t next = kNone;  // in its bucket, or of those to spare
  };

  [[nodiscard]] std::uint32_t mask() const noexcept {
    return static_cast<std::uint32_t>(heads_.size()) - 1;
  }
  // Without the check of every access that vectors make here: places are the queue's own.
  [[nodiscard]] Entry* entries() noexcept { return entries_.data(); }

  void empty(std::uint32_t bucket) noexcept {
    std::uint64_t& filled = filled_.data()[bucket / kBits];
    filled &= ~(std::uint64_t{1} << (bucket % kBits));
    if (filled == 0) {
      const std::uint32_t word = bucket / kBits;
      filled_words_.data()[word / kBits] &= ~(std::uint64_t{1} << (word % kBits));
    }
  }

  // Going round from `bucket`: first what is left of its word, then other words.
  [[nodiscard]] bool first_filled(std::uint32_t bucket, std::uint32_t& found) const noexcept {
    const std::uint32_t word = bucket / kBits;
    if (const std::uint64_t rest = filled_.data()[word] >> (bucket % kBits); rest != 0) {
      found = bucket + static_cast<std::uint32_t>(std::countr_zero(rest));
      return true;
    }
    const auto groups = static_cast<std::uint32_t>(filled_words_.size());
    const std::uint32_t home = word / kBits;
    for (std::uint32_t i = 0; i <= groups; ++i) {
      const std::uint32_t group = home + i < groups ? home + i : home + i - groups;
      const std::uint64_t later = i == 0 ? ~std::uint64_t{1} << (word % kBits) : kAll;
      if (const std::uint64_t filled = filled_words_.data()[group] & later; filled != 0) {
        const std::uint32_t first =
            group * kBits + static_cast<std::uint32_t>(std::countr_zero(filled));
        found = first * kBits + static_cast<std::uint32_t>(std::countr_zero(filled_.data()[first]));
        return true;
      }
    }
    return false;
  }

  std::vector<std::uint32_t> heads_;
  std::vector<std::uint64_t> filled_;        // a bit a bucket that is not empty
  std::vector<std::uint64_t> filled_words_;  // a bit a word of those that is not zero
  std::vector<Entry> entries_;
  std::uint32_t used_ = 0;
  std::uint32_t spare_ = kNone;
};

}  // namespace lodesman
