// SPDX-License-Identifier: Apache-2.0
#include "mid_level/blackboard/channel.h"

#include <atomic>
#include <numeric>
#include <thread>

#include "tests/support/catch.h"

using namespace lodesman;

namespace {

// Large enough to be torn: whole only if every word is the same.
struct Block {
  std::array<std::uint64_t, 512> words{};
  static constexpr auto fields() noexcept { return field_list(field("words", &Block::words)); }

  static Block of(std::uint64_t value) {
    Block block;
    block.words.fill(value);
    return block;
  }
  [[nodiscard]] bool whole() const {
    for (const auto word : words) {
      if (word != words[0]) {
        return false;
      }
    }
    return true;
  }
};

struct Tail {
  std::uint32_t count = 0;
  std::array<std::uint8_t, 100> bytes{};
  [[nodiscard]] std::size_t used_bytes() const noexcept { return offsetof(Tail, bytes) + count; }
  static constexpr auto fields() noexcept {
    return field_list(field("count", &Tail::count), field("bytes", &Tail::bytes, &Tail::count));
  }
};

Time at(std::int64_t ns) { return Time{Duration{ns}}; }

}  // namespace

TEST_CASE("channel: nothing is there before the first publication", "[mid_level][blackboard]") {
  const auto channel = std::make_unique<Channel<Block, 2>>();
  Reader<Block> reader{*channel};
  CHECK(reader.latest() == nullptr);
  CHECK(reader.next() == nullptr);
  CHECK(reader.at(1) == nullptr);
  CHECK(reader.fresh(at(0), Duration{10}) == nullptr);
}

TEST_CASE("channel: latest gives the newest value with its stamp and sequence",
          "[mid_level][blackboard]") {
  const auto channel = std::make_unique<Channel<Block, 3>>();
  Writer<Block> writer{*channel, Role::kLow, "blocks"};
  Reader<Block> reader{*channel};
  for (std::uint64_t i = 1; i <= 7; ++i) {
    writer.publish(Block::of(i), at(static_cast<std::int64_t>(10 * i)));
    const auto* newest = reader.latest();
    REQUIRE(newest != nullptr);
    CHECK(newest->value.words[511] == i);
    CHECK(newest->stamp == at(static_cast<std::int64_t>(10 * i)));
    CHECK(newest->sequence == i);
  }
}

TEST_CASE("channel: fresh gives nothing older than its reader tolerates",
          "[mid_level][blackboard]") {
  const auto channel = std::make_unique<Channel<Block, 2>>();
  Writer<Block> writer{*channel, Role::kLow, "blocks"};
  Reader<Block> reader{*channel};
  writer.publish(Block::of(1), at(100));
  CHECK(reader.fresh(at(150), Duration{50}) != nullptr);
  CHECK(reader.fresh(at(151), Duration{50}) == nullptr);
}

TEST_CASE("channel: next gives every value in order, and counts those it came too late for",
          "[mid_level][blackboard]") {
  const auto channel = std::make_unique<Channel<Block, 4>>();
  Writer<Block> writer{*channel, Role::kLow, "blocks"};
  Reader<Block> reader{*channel};
  for (std::uint64_t i = 1; i <= 3; ++i) {
    writer.publish(Block::of(i), at(0));
  }
  for (std::uint64_t i = 1; i <= 3; ++i) {
    CHECK(reader.next()->sequence == i);
  }
  CHECK(reader.next() == nullptr);
  CHECK(reader.missed() == 0);
  for (std::uint64_t i = 4; i <= 10; ++i) {
    writer.publish(Block::of(i), at(0));
  }
  CHECK(reader.next()->sequence == 7);
  CHECK(reader.missed() == 3);
}

TEST_CASE("channel: at finds what the ring still has", "[mid_level][blackboard]") {
  const auto channel = std::make_unique<Channel<Block, 4>>();
  Writer<Block> writer{*channel, Role::kLow, "blocks"};
  Reader<Block> reader{*channel};
  for (std::uint64_t i = 1; i <= 6; ++i) {
    writer.publish(Block::of(i), at(0));
  }
  CHECK(reader.at(2) == nullptr);
  CHECK(reader.at(7) == nullptr);
  REQUIRE(reader.at(4) != nullptr);
  CHECK(reader.at(4)->value.words[0] == 4);
}

TEST_CASE("channel: of a counted tail only what is used is copied", "[mid_level][blackboard]") {
  const auto channel = std::make_unique<Channel<Tail, 2>>();
  Writer<Tail> writer{*channel, Role::kLow, "tails"};
  Reader<Tail> reader{*channel};
  for (std::uint32_t count : {0U, 1U, 3U, 4U, 5U, 11U, 100U}) {
    Tail tail;
    tail.count = count;
    std::iota(tail.bytes.begin(), tail.bytes.end(), std::uint8_t{1});
    writer.publish(tail, at(0));
    const auto* got = reader.latest();
    REQUIRE(got->value.count == count);
    for (std::uint32_t i = 0; i < count; ++i) {
      CHECK(got->value.bytes[i] == i + 1);
    }
  }
}

TEST_CASE("channel: a second writer is refused until the first is gone",
          "[mid_level][blackboard]") {
  const auto channel = std::make_unique<Channel<Block, 2>>();
  {
    Writer<Block> first{*channel, Role::kLow, "blocks"};
    first.publish(Block::of(1), at(0));
    CHECK_THROWS_WITH((Writer<Block>{*channel, Role::kHigh, "blocks"}),
                      "channel blocks already has a writer");
  }
  Writer<Block> second{*channel, Role::kHigh, "blocks"};
  second.publish(Block::of(2), at(0));
  Reader<Block> reader{*channel};
  CHECK(reader.latest()->sequence == 2);
}

TEST_CASE("channel: the claim of a dead writer can be freed, and its last value stands",
          "[mid_level][blackboard]") {
  const auto channel = std::make_unique<Channel<Block, 2>>();
  channel->head.writer.store(static_cast<std::uint32_t>(Role::kHigh));
  // It died while writing value 1: the version is odd and nothing was announced.
  channel->slots[1].version.store(1);
  channel->release_claim_of(Role::kLow);
  CHECK_THROWS((Writer<Block>{*channel, Role::kHigh, "blocks"}));
  channel->release_claim_of(Role::kHigh);
  Writer<Block> writer{*channel, Role::kHigh, "blocks"};
  Reader<Block> reader{*channel};
  CHECK(reader.latest() == nullptr);
  writer.publish(Block::of(9), at(0));
  CHECK(reader.latest()->value.words[0] == 9);
}

TEST_CASE("channel: the value that a killed writer did not announce never counts",
          "[mid_level][blackboard]") {
  const auto channel = std::make_unique<Channel<Block, 4>>();
  {
    Writer<Block> first{*channel, Role::kHigh, "blocks"};
    first.publish(Block::of(1), at(0));
    first.publish(Block::of(2), at(0));
  }
  // Killed between the even version of value 2 and the head that announces it.
  channel->head.newest.store(1);
  Reader<Block> reader{*channel};
  CHECK(reader.at(2) == nullptr);
  Writer<Block> second{*channel, Role::kHigh, "blocks"};
  // No reader that is copying the ghost can find its number whole again.
  CHECK(channel->slots[2].version.load() % 2 == 1);
  second.publish(Block::of(3), at(0));
  CHECK(reader.latest()->sequence == 3);
  CHECK(reader.at(2) == nullptr);
  Reader<Block> one_by_one{*channel};
  CHECK(one_by_one.next()->sequence == 1);
  CHECK(one_by_one.next()->sequence == 3);
  CHECK(one_by_one.missed() == 1);
}

TEST_CASE("channel: a successor never writes the number that a killed writer began",
          "[mid_level][blackboard]") {
  const auto channel = std::make_unique<Channel<Block, 4>>();
  for (const std::uint64_t version : {1U, 2U}) {  // half written, whole
    channel->slots[1].version.store(version);
    Writer<Block> writer{*channel, Role::kHigh, "blocks"};
    CHECK(writer.sequence() == 1);
    CHECK(channel->slots[1].version.load() == 1);
  }
  Writer<Block> writer{*channel, Role::kHigh, "blocks"};
  writer.publish(Block::of(5), at(0));
  CHECK(writer.sequence() == 2);
}

TEST_CASE("channel: a ring whose head says more than its slots hold is not sound",
          "[mid_level][blackboard]") {
  const auto channel = std::make_unique<Channel<Block, 3>>();
  CHECK(channel->is_sound(Role::kLow));
  {
    Writer<Block> writer{*channel, Role::kLow, "blocks"};
    for (std::uint64_t i = 1; i <= 7; ++i) {
      writer.publish(Block::of(i), at(0));
    }
    CHECK(channel->is_sound(Role::kLow));
    CHECK_FALSE(channel->is_sound(Role::kHigh));
  }
  CHECK(channel->is_sound(Role::kHigh));
  for (const std::uint64_t newest : {8ULL, 1ULL << 63U, ~0ULL}) {
    channel->head.newest.store(newest);
    CHECK_FALSE(channel->is_sound(Role::kLow));
  }
  channel->head.newest.store(7);
  channel->head.writer.store(77);
  CHECK_FALSE(channel->is_sound(Role::kLow));
}

TEST_CASE("channel: concurrent readers see whole values in order", "[mid_level][blackboard]") {
  const auto channel = std::make_unique<Channel<Block, 3>>();
  std::atomic<bool> done{false};
  std::atomic<std::uint64_t> torn{0};
  std::atomic<std::uint64_t> backwards{0};
  std::atomic<std::uint64_t> seen{0};
  const auto watch = [&](bool one_by_one) {
    Reader<Block> reader{*channel};
    std::uint64_t last = 0;
    while (!done) {
      const auto* got = one_by_one ? reader.next() : reader.latest();
      if (got == nullptr) {
        continue;
      }
      torn += got->value.whole() && got->value.words[0] == got->sequence ? 0 : 1;
      backwards += got->sequence < last ? 1 : 0;
      last = got->sequence;
      ++seen;
    }
  };
  {
    std::jthread a{watch, true};
    std::jthread b{watch, false};
    Writer<Block> writer{*channel, Role::kLow, "blocks"};
    for (std::uint64_t i = 1; i <= 50000; ++i) {
      writer.publish(Block::of(i), at(0));
    }
    while (seen < 100) {
      writer.publish(Block::of(writer.sequence() + 1), at(0));
    }
    done = true;
  }
  CHECK(torn == 0);
  CHECK(backwards == 0);
}

TEST_CASE("channel: a reader that has looked sees nothing newer until it looks again",
          "[mid_level][blackboard]") {
  const auto channel = std::make_unique<Channel<Block, 4>>();
  Writer<Block> writer{*channel, Role::kLow, "blocks"};
  Reader<Block> reader{*channel};
  writer.publish(Block::of(1), at(10));
  reader.look();
  writer.publish(Block::of(2), at(20));
  CHECK(reader.newest_sequence() == 1);
  CHECK(reader.latest()->sequence == 1);
  CHECK(reader.fresh(at(20), Duration{100})->sequence == 1);
  CHECK(reader.next() == nullptr);
  CHECK(reader.at(2) == nullptr);
  CHECK(reader.is_whole());
  reader.look();
  CHECK(reader.latest()->sequence == 2);
  // As it was seen before, whatever there is by now.
  Reader<Block> again{*channel};
  again.look_up_to(1);
  CHECK(again.latest()->sequence == 1);
}

TEST_CASE("channel: what was to be seen and is written over gives way to what there is",
          "[mid_level][blackboard]") {
  const auto channel = std::make_unique<Channel<Block, 2>>();
  Writer<Block> writer{*channel, Role::kLow, "blocks"};
  Reader<Block> reader{*channel};
  writer.publish(Block::of(1), at(10));
  reader.look();
  for (std::uint64_t value = 2; value <= 4; ++value) {
    writer.publish(Block::of(value), at(20));
  }
  REQUIRE(reader.latest() != nullptr);
  CHECK(reader.latest()->value.words[0] == 4);
  CHECK(reader.newest_sequence() == 4);
  CHECK_FALSE(reader.is_whole());
  reader.look();
  CHECK(reader.is_whole());
}

TEST_CASE("channel: a writer that goes on after a number leaves out those before",
          "[mid_level][blackboard]") {
  const auto channel = std::make_unique<Channel<Block, 4>>();
  Writer<Block> writer{*channel, Role::kLow, "blocks"};
  Reader<Block> reader{*channel};
  writer.go_on_after(6);
  writer.publish(Block::of(7), at(10));
  writer.go_on_after(8);
  writer.publish(Block::of(9), at(20));
  CHECK(reader.next()->sequence == 7);
  CHECK(reader.next()->sequence == 9);
  CHECK(reader.next() == nullptr);
  CHECK(reader.at(8) == nullptr);
}
