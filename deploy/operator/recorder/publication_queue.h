// SPDX-License-Identifier: Apache-2.0
// What the tap's thread has taken and the writing thread has not yet written: a ring of bytes with
// one producer and one consumer, of a size that is set. What finds no room is a gap, remembered by
// channel and told as soon as there is room again. No lock: `written_` is stored with release after
// an entry is whole and loaded with acquire before it is read; `read_` likewise gives the room
// back. Both only grow, so that neither thread can take the other's place for its own.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "mid_level/recording/board_tap.h"

namespace lodesman::cli {

class PublicationQueue final : public PublicationSink {
 public:
  // Holds whatever one publication needs; its memory is touched once, so that no page is missing
  // later.
  explicit PublicationQueue(std::size_t bytes);

  // The producer's thread. These allocate nothing and wait for nothing.
  [[nodiscard]] std::span<std::byte> room_for(const Publication& publication) noexcept override;
  void take(const Publication& publication) noexcept override;
  void note(const Gap& gap) noexcept override;
  // Tells what gaps it has been able to tell nobody of.
  void tell_gaps() noexcept;

  struct Entry {
    std::optional<Gap> gap;  // else a publication
    Publication publication{};
    std::span<const std::byte> raw;
  };
  // The consumer's thread: the oldest entry, which stays where it is until pop().
  [[nodiscard]] std::optional<Entry> front() noexcept;
  void pop() noexcept;

  // The least that it can have.
  static constexpr std::size_t kLeast_bytes = std::size_t{4} << 20;

 private:
  enum class Kind : std::uint32_t { kPublication, kGap, kFiller };
  // Before each entry's bytes; a multiple of it is what an entry takes, so that one always fits
  // before the end of the ring.
  struct alignas(64) Head {
    Kind kind = Kind::kFiller;
    std::uint64_t taken_bytes = 0;  // of the ring, this head included
    Publication publication{};
    Gap gap{};
  };

  [[nodiscard]] static std::size_t rounded(std::size_t bytes) noexcept;
  [[nodiscard]] std::size_t filler_before(std::size_t bytes) const noexcept;
  // Where an entry of that size begins; its place in the ring, or nothing.
  [[nodiscard]] std::optional<std::size_t> place_for(std::size_t bytes) noexcept;
  void put(const Head& head) noexcept;
  void remember(const Gap& gap) noexcept;
  [[nodiscard]] bool tell_gap_of(std::uint32_t channel) noexcept;

  std::vector<std::byte> ring_;
  std::vector<std::optional<Gap>> untold_;  // by channel; the producer's
  alignas(64) std::atomic<std::uint64_t> written_{0};
  alignas(64) std::atomic<std::uint64_t> read_{0};
};

}  // namespace lodesman::cli
