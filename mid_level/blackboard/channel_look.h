// SPDX-License-Identifier: Apache-2.0
// How far a reader of a channel sees. Part of the Reader in channel.h; one thread, wait-free.
#pragma once

#include <atomic>
#include <cstdint>

namespace lodesman {

// Not reached by counting: a head that announces more is wrong. Below it a number and its double
// never wrap, so that one value after another comes to an end.
inline constexpr std::uint64_t kLastSequence = std::uint64_t{1} << 62U;

// How much of its channel a reader sees. By itself it sees all that there is. A runner that has its
// task look before each step shows it the channel as it was then, to the end of the step: what
// comes meanwhile is the next step's, and so the numbers that it looked at say all that it saw.
template <template <class> class Atomic = std::atomic>
class ChannelLook {
 public:
  explicit ChannelLook(const Atomic<std::uint64_t>& newest) noexcept
      : newest_{&newest}, when_made_{announced()} {}

  // From now on it sees what there is now.
  void look() noexcept { look_up_to(announced()); }
  // The same, of a number that was seen before.
  void look_up_to(std::uint64_t sequence) noexcept {
    seen_ = sequence;
    whole_ = true;
  }
  // The newest that it can see; 0 as long as there was none, or where the head is wrong.
  [[nodiscard]] std::uint64_t newest_sequence() const noexcept {
    return seen_ == kAll ? announced() : seen_;
  }
  // The newest that there was when this reader was made.
  [[nodiscard]] std::uint64_t newest_when_made() const noexcept { return when_made_; }
  // Whether since it looked all that it asked for was in its place.
  [[nodiscard]] bool is_whole() const noexcept { return whole_; }
  // Where its channel begins.
  [[nodiscard]] const void* channel() const noexcept { return newest_; }

 protected:
  // Something that it asked for and was to see is written over.
  void note_written_over() noexcept { whole_ = false; }
  // And so it sees what there is now, rather than nothing.
  void look_again() noexcept {
    note_written_over();
    seen_ = seen_ == kAll ? kAll : announced();
  }

 private:
  static constexpr std::uint64_t kAll = ~std::uint64_t{0};

  [[nodiscard]] std::uint64_t announced() const noexcept {
    const std::uint64_t newest = newest_->load(std::memory_order_acquire);
    return newest <= kLastSequence ? newest : 0;
  }

  const Atomic<std::uint64_t>* newest_;
  std::uint64_t when_made_;
  std::uint64_t seen_ = kAll;
  bool whole_ = true;
};

}  // namespace lodesman
