// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/recorder/publication_queue.h"

#include <algorithm>
#include <cstring>
#include <memory>

#include "mid_level/base/check.h"

namespace lodesman::cli {

namespace {

[[nodiscard]] std::size_t largest_publication() {
  std::size_t largest = 0;
  const auto board = std::make_unique<Blackboard>();
  for_each_channel(*board, [&]<class C>(const ChannelInfo& /*info*/, const C& /*channel*/) {
    largest = std::max(largest, sizeof(typename C::Value));
  });
  return largest;
}

}  // namespace

PublicationQueue::PublicationQueue(std::size_t bytes)
    : ring_(rounded(std::max(bytes, kLeast_bytes)), std::byte{1}), untold_(raw_channels().size()) {
  // Wherever the ring's end is, the largest fits before it or behind it.
  LODESMAN_CHECK(2 * (sizeof(Head) + rounded(largest_publication())) <= ring_.size());
}

std::size_t PublicationQueue::rounded(std::size_t bytes) noexcept {
  return (bytes + sizeof(Head) - 1) / sizeof(Head) * sizeof(Head);
}

// What is left over at the end of the ring where an entry does not fit there.
std::size_t PublicationQueue::filler_before(std::size_t bytes) const noexcept {
  const std::size_t to_end =
      ring_.size() -
      static_cast<std::size_t>(written_.load(std::memory_order_relaxed) % ring_.size());
  return bytes <= to_end ? 0 : to_end;
}

std::optional<std::size_t> PublicationQueue::place_for(std::size_t bytes) noexcept {
  const std::uint64_t written = written_.load(std::memory_order_relaxed);
  const std::uint64_t used = written - read_.load(std::memory_order_acquire);
  const std::size_t filler = filler_before(bytes);
  if (used + filler + bytes > ring_.size()) {
    return std::nullopt;
  }
  return static_cast<std::size_t>((written + filler) % ring_.size());
}

// The place has been found to be there; what belongs to the entry already lies behind its head.
void PublicationQueue::put(const Head& head) noexcept {
  const std::uint64_t written = written_.load(std::memory_order_relaxed);
  const std::size_t filler = filler_before(static_cast<std::size_t>(head.taken_bytes));
  if (filler > 0) {
    const Head skip{Kind::kFiller, filler, {}, {}};
    std::memcpy(ring_.data() + written % ring_.size(), &skip, sizeof skip);
  }
  std::memcpy(ring_.data() + (written + filler) % ring_.size(), &head, sizeof head);
  written_.store(written + filler + head.taken_bytes, std::memory_order_release);
}

std::span<std::byte> PublicationQueue::room_for(const Publication& publication) noexcept {
  const auto place = tell_gap_of(publication.channel)
                         ? place_for(sizeof(Head) + rounded(publication.bytes))
                         : std::nullopt;
  if (!place) {
    remember(
        {publication.channel, GapCause::kQueueFull, publication.sequence, publication.sequence});
    return {};
  }
  return std::span{ring_}.subspan(*place + sizeof(Head), publication.bytes);
}

void PublicationQueue::take(const Publication& publication) noexcept {
  put({Kind::kPublication, sizeof(Head) + rounded(publication.bytes), publication, {}});
}

void PublicationQueue::note(const Gap& gap) noexcept {
  remember(gap);
  static_cast<void>(tell_gap_of(gap.channel));
}

void PublicationQueue::remember(const Gap& gap) noexcept {
  auto& untold = untold_[gap.channel];
  if (untold) {
    untold->first = std::min(untold->first, gap.first);
    untold->last = std::max(untold->last, gap.last);
  } else {
    untold = gap;
  }
}

bool PublicationQueue::tell_gap_of(std::uint32_t channel) noexcept {
  auto& untold = untold_[channel];
  if (untold && place_for(sizeof(Head))) {
    put({Kind::kGap, sizeof(Head), {}, *untold});
    untold.reset();
  }
  return !untold;
}

void PublicationQueue::tell_gaps() noexcept {
  for (std::uint32_t channel = 0; channel < untold_.size(); ++channel) {
    static_cast<void>(tell_gap_of(channel));
  }
}

std::optional<PublicationQueue::Entry> PublicationQueue::front() noexcept {
  for (;;) {
    const std::uint64_t read = read_.load(std::memory_order_relaxed);
    if (read == written_.load(std::memory_order_acquire)) {
      return std::nullopt;
    }
    const std::size_t place = static_cast<std::size_t>(read % ring_.size());
    Head head;
    std::memcpy(&head, ring_.data() + place, sizeof head);
    switch (head.kind) {
      case Kind::kFiller: read_.store(read + head.taken_bytes, std::memory_order_release); break;
      case Kind::kGap: return Entry{head.gap, {}, {}};
      case Kind::kPublication:
        return Entry{std::nullopt, head.publication,
                     std::span<const std::byte>{ring_}.subspan(place + sizeof(Head),
                                                               head.publication.bytes)};
    }
  }
}

void PublicationQueue::pop() noexcept {
  const std::uint64_t read = read_.load(std::memory_order_relaxed);
  Head head;
  std::memcpy(&head, ring_.data() + read % ring_.size(), sizeof head);
  read_.store(read + head.taken_bytes, std::memory_order_release);
}

}  // namespace lodesman::cli
