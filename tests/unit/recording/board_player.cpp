// SPDX-License-Identifier: Apache-2.0
#include "mid_level/recording/board_player.h"

#include "mid_level/recording/raw_codec.h"
#include "mid_level/recording/recording.h"
#include "tests/support/catch.h"
#include "tests/unit/recording/memory_file.h"
#include "tests/unit/recording/support.h"

using namespace lodesman;
using namespace lodesman::testing;

namespace {

// A recording with one attitude for each of these times [ms].
[[nodiscard]] std::vector<std::byte> recorded(std::initializer_list<int> times_ms) {
  Disk disk;
  Recording recording{std::make_unique<MemoryFile>(disk), {}, at(0)};
  std::uint64_t sequence = 40;
  for (const int ms : times_ms) {
    Attitude attitude;
    attitude.yaw_rate_rad_s = ms / 1e3;
    std::vector<std::byte> raw(used_bytes(attitude));
    encode_raw(attitude, raw);
    recording.add(Publication{channel_named("attitude"), static_cast<std::uint32_t>(raw.size()),
                              at(ms), ++sequence},
                  raw);
  }
  CHECK(recording.finish() == 0);
  return disk.bytes;
}

void play(std::span<const std::byte> bytes, BoardPlayer& player) {
  McapBytesSource source{bytes};
  McapReader reader{source};
  player.begin_file();
  for (McapItem item = reader.next(); item != McapItem::kEnd; item = reader.next()) {
    player.take(reader, item);
  }
}

}  // namespace

TEST_CASE("board player: what was recorded is published with its stamps, one file after another",
          "[recording]") {
  const auto board = std::make_unique<Blackboard>();
  BoardPlayer player{*board};
  Reader<Attitude> reader{board->attitude};
  play(recorded({1000, 1020}), player);
  play(recorded({1040}), player);
  for (const int ms : {1000, 1020, 1040}) {
    const auto* attitude = reader.next();
    REQUIRE(attitude != nullptr);
    CHECK(attitude->stamp == at(ms));
    CHECK(attitude->value.yaw_rate_rad_s == Approx(ms / 1e3));
  }
  CHECK(reader.next() == nullptr);
  CHECK(player.left_out().empty());
  CHECK(player.insane() == 0);
}

TEST_CASE("board player: a channel of another build's layout is left out, and named once",
          "[recording]") {
  Disk disk;
  MemoryFile file{disk};
  McapWriter writer{file, "test"};
  const auto schema = writer.add(McapSchema{0, "lodesman.attitude", kRawSchemaEncoding, "{}"});
  const auto other =
      writer.add(McapChannel{0, schema, std::string{kRawTopics} + "attitude", kRawEncoding, {}});
  const std::vector<std::byte> raw(sizeof(Attitude));
  writer.add(McapMessage{other, 1, 1, 1, raw});
  writer.finish();
  const auto board = std::make_unique<Blackboard>();
  BoardPlayer player{*board};
  play(disk.bytes, player);
  play(disk.bytes, player);
  CHECK(player.left_out() == std::vector<std::string>{"raw/attitude"});
  Reader<Attitude> reader{board->attitude};
  CHECK(reader.latest() == nullptr);
}

TEST_CASE("board player: bytes that are no sane value are counted, and not published",
          "[recording]") {
  Disk disk;
  Recording recording{std::make_unique<MemoryFile>(disk), {}, at(0)};
  const std::vector<std::byte> short_of_it(3);
  recording.add(Publication{channel_named("attitude"), 3, at(5), 1}, short_of_it);
  CHECK(recording.finish() == 0);
  const auto board = std::make_unique<Blackboard>();
  BoardPlayer player{*board};
  play(disk.bytes, player);
  CHECK(player.insane() == 1);
  Reader<Attitude> reader{board->attitude};
  CHECK(reader.latest() == nullptr);
}
