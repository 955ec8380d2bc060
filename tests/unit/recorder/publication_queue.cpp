// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/recorder/publication_queue.h"

#include <algorithm>
#include <atomic>
#include <map>
#include <random>
#include <thread>
#include <vector>

#include "tests/support/catch.h"

using namespace lodesman;
using namespace lodesman::cli;

namespace {

constexpr std::uint32_t kChannel = 3;

// Every byte of it says which publication it is of.
[[nodiscard]] std::byte mark_of(std::uint64_t sequence) {
  return static_cast<std::byte>(sequence * 37 + 1);
}

bool offer(PublicationQueue& queue, std::uint64_t sequence, std::uint32_t bytes) {
  const Publication publication{kChannel, bytes, Time{Duration{5}}, sequence};
  const auto room = queue.room_for(publication);
  if (room.empty()) {
    return false;
  }
  std::fill(room.begin(), room.end(), mark_of(sequence));
  queue.take(publication);
  return true;
}

[[nodiscard]] bool is_whole(const PublicationQueue::Entry& entry) {
  return entry.raw.size() == entry.publication.bytes &&
         std::all_of(entry.raw.begin(), entry.raw.end(),
                     [&](std::byte b) { return b == mark_of(entry.publication.sequence); });
}

}  // namespace

TEST_CASE("publication queue: what goes in comes out whole and in order, round and round",
          "[recorder]") {
  PublicationQueue queue{PublicationQueue::kLeast_bytes};
  std::mt19937_64 random{1};
  std::uint64_t put = 0;
  std::uint64_t taken = 0;
  while (taken < 3000) {
    for (std::uint64_t i = random() % 4; i > 0; --i) {
      if (offer(queue, put + 1, 1 + static_cast<std::uint32_t>(random() % 500'000))) {
        ++put;
      } else {
        break;
      }
    }
    for (std::uint64_t i = random() % 4; i > 0; --i) {
      const auto entry = queue.front();
      if (!entry) {
        break;
      }
      if (!entry->gap) {
        REQUIRE(entry->publication.sequence == ++taken);
        REQUIRE(is_whole(*entry));
      }
      queue.pop();
    }
  }
}

TEST_CASE("publication queue: what finds no room is told as a gap, and nothing else is lost",
          "[recorder]") {
  PublicationQueue queue{PublicationQueue::kLeast_bytes};
  std::uint64_t sequence = 0;
  while (offer(queue, ++sequence, 300'000)) {
  }
  const std::uint64_t first_lost = sequence;
  CHECK_FALSE(offer(queue, ++sequence, 300'000));
  CHECK_FALSE(offer(queue, ++sequence, 300'000));
  const std::uint64_t last_lost = sequence;
  for (std::uint64_t expected = 1; expected < first_lost; ++expected) {
    const auto entry = queue.front();
    REQUIRE(entry);
    CHECK(entry->publication.sequence == expected);
    queue.pop();
  }
  CHECK(offer(queue, ++sequence, 10));
  // Before the next one of that channel; in pieces, where there was room to tell some of it.
  std::uint64_t told = first_lost - 1;
  auto entry = queue.front();
  for (; entry && entry->gap; entry = queue.front()) {
    CHECK(entry->gap->first == told + 1);
    CHECK(entry->gap->channel == kChannel);
    CHECK(entry->gap->cause == GapCause::kQueueFull);
    told = entry->gap->last;
    queue.pop();
  }
  CHECK(told == last_lost);
  REQUIRE(entry);
  CHECK(entry->publication.sequence == sequence);
}

TEST_CASE("publication queue: two threads pass everything on, each publication or its gap",
          "[recorder]") {
  PublicationQueue queue{PublicationQueue::kLeast_bytes};
  constexpr std::uint64_t kCount = 20'000;
  std::atomic<bool> done{false};
  std::jthread producer{[&queue, &done] {
    std::mt19937_64 random{2};
    for (std::uint64_t sequence = 1; sequence <= kCount; ++sequence) {
      offer(queue, sequence, 1 + static_cast<std::uint32_t>(random() % 4000));
    }
    done.store(true, std::memory_order_release);
  }};
  std::uint64_t next = 1;
  bool whole = true;
  bool in_order = true;
  const auto drain = [&] {
    while (const auto entry = queue.front()) {
      const std::uint64_t first = entry->gap ? entry->gap->first : entry->publication.sequence;
      in_order = in_order && first == next;
      whole = whole && (entry->gap || is_whole(*entry));
      next = (entry->gap ? entry->gap->last : entry->publication.sequence) + 1;
      queue.pop();
    }
  };
  while (!done.load(std::memory_order_acquire)) {
    drain();
  }
  producer.join();
  drain();
  queue.tell_gaps();
  drain();
  CHECK(whole);
  CHECK(in_order);
  CHECK(next == kCount + 1);
}
