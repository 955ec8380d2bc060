// SPDX-License-Identifier: Apache-2.0
#include "mid_level/recording/mcap_writer.h"

#include <algorithm>
#include <string>

#include "mid_level/recording/mcap_reader.h"
#include "tests/support/catch.h"
#include "tests/unit/recording/memory_file.h"

using namespace lodesman;
using namespace lodesman::testing;

namespace {

// Bytes as hexadecimal digits, so that a record can be compared with one written down by hand.
std::string hex(std::span<const std::byte> bytes) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string text;
  for (const std::byte b : bytes) {
    text += kDigits[std::to_integer<unsigned>(b) >> 4U];
    text += kDigits[std::to_integer<unsigned>(b) & 15U];
  }
  return text;
}

template <class Record>
std::string hex_of(const Record& record) {
  McapPutter to;
  put(to, record);
  return hex(to.bytes());
}

std::string without_blanks(std::string text) {
  text.erase(std::remove(text.begin(), text.end(), ' '), text.end());
  return text;
}

}  // namespace

TEST_CASE("mcap: the CRC is that of IEEE 802.3", "[recording]") {
  CHECK(crc32_of(bytes_of("123456789")) == 0xcbf43926U);
  CHECK(crc32_of(bytes_of("6789"), crc32_of(bytes_of("12345"))) == 0xcbf43926U);
  CHECK(crc32_of({}) == 0);
}

// By the specification's tables, byte by byte.
TEST_CASE("mcap: each record is to the byte as the specification has it", "[recording]") {
  CHECK(hex_of(McapSchema{1, "Ex", "e", "data"}) ==
        without_blanks("03 1500000000000000 0100 02000000 4578 01000000 65 04000000 64617461"));
  CHECK(hex_of(McapChannel{1, 2, "t", "a", {{"k", "v"}}}) ==
        without_blanks("04 1c00000000000000 0100 0200 01000000 74 01000000 61"
                       " 0a000000 01000000 6b 01000000 76"));
  const std::string data = "hi";
  CHECK(hex_of(McapMessage{1, 10, 2, 1, bytes_of(data)}) ==
        without_blanks("05 1800000000000000 0100 0a000000 0200000000000000 0100000000000000 6869"));
  CHECK(hex_of(McapMetadata{"m", {{"a", "b"}}}) ==
        without_blanks("0c 1300000000000000 01000000 6d 0a000000 01000000 61 01000000 62"));
  // The CRC is over all between the record's length and itself.
  const std::string content = without_blanks(
      "0200000000000000 0100000000000000 01000000 61 01000000 74 0200000000000000 6869");
  CHECK(hex_of(McapAttachment{2, 1, "a", "t", "hi"}).substr(0, 18 + content.size()) ==
        "092800000000000000" + content);
}

TEST_CASE("mcap: an empty file is to the byte as the specification has it", "[recording]") {
  Disk disk;
  MemoryFile file{disk};
  McapWriter writer{file, "L"};
  writer.finish();
  CHECK(writer.is_finished());
  const std::string text = hex(disk.bytes);
  const std::string head = without_blanks(
      "894d434150300d0a"                          // magic
      "01 0900000000000000 00000000 01000000 4c"  // header: no profile, library L
      "0f 0400000000000000");                     // data end, and its CRC
  CHECK(text.substr(0, head.size()) == head);
  // Statistics: 46 bytes without a count a channel.
  const std::string statistics = without_blanks("0b 2e00000000000000") + std::string(2 * 46, '0');
  CHECK(text.substr(head.size() + 8, statistics.size()) == statistics);
  // One group of the summary; the footer; the magic.
  CHECK(text.substr(text.size() - 16) == "894d434150300d0a");
  CHECK(text.substr(text.size() - 16 - 58, 18) == without_blanks("02 1400000000000000"));
}

TEST_CASE("mcap: what was written is read back, index by index and in order", "[recording]") {
  Disk disk;
  MemoryFile file{disk};
  McapWriter writer{file, "test"};
  const auto schema = writer.add(McapSchema{0, "s", "e", "d"});
  const auto channel = writer.add(McapChannel{0, schema, "t", "m", {}});
  writer.add(McapAttachment{1, 1, "config.toml", "text/plain", "key = 1\n"});
  writer.add(McapMetadata{"about", {{"version", "1"}}});
  const std::string big(300'000, 'x');
  for (std::uint32_t i = 1; i <= 10; ++i) {
    const std::string data = big + std::to_string(i);
    writer.add(McapMessage{channel, i, i * 10U, i * 10U, bytes_of(data)});
  }
  CHECK(writer.chunk_count() == 2);  // each as soon as it holds a MiB
  writer.finish();
  CHECK(writer.chunk_count() == 3);
  CHECK(writer.message_count() == 10);
  CHECK(writer.size_bytes() == disk.bytes.size());

  McapBytesSource source{disk.bytes};
  McapReader reader{source};
  std::vector<McapItem> items;
  std::uint32_t last = 0;
  for (McapItem item = reader.next(); item != McapItem::kEnd; item = reader.next()) {
    if (item == McapItem::kMessage) {
      CHECK(reader.message().sequence == last + 1);
      CHECK(reader.message().log_time_ns == reader.message().sequence * 10U);
      last = reader.message().sequence;
      CHECK(reader.message().data.size() == big.size() + std::to_string(last).size());
    } else {
      items.push_back(item);
    }
  }
  CHECK(last == 10);
  CHECK(items == std::vector<McapItem>{McapItem::kSchema, McapItem::kChannel, McapItem::kAttachment,
                                       McapItem::kMetadata});
  CHECK(reader.attachment().data == "key = 1\n");
  CHECK(reader.metadata().values.at("version") == "1");
  CHECK(reader.ending() == McapEnding::kWhole);
  CHECK(reader.damaged() == 0);
  CHECK(reader.position() == disk.bytes.size());
}

TEST_CASE("mcap: a full disk costs the chunk that did not fit, and nothing before it",
          "[recording]") {
  for (const std::uint64_t room : {40U, 500U, 2'000U, 2'500U, 3'000U, 3'400U}) {
    INFO(room << " bytes");
    Disk disk;
    disk.room_bytes = room;
    MemoryFile file{disk};
    McapWriter writer{file, "test"};
    const auto schema = writer.add(McapSchema{0, "s", "e", std::string(100, 'd')});
    const auto channel = writer.add(McapChannel{0, schema, "t", "m", {}});
    std::uint32_t written = 0;
    for (std::uint32_t i = 1; i <= 100; ++i) {
      writer.add(McapMessage{channel, i, i, i, bytes_of("some data")});
      writer.close_chunk();
      written += writer.fault() == 0 ? 1U : 0U;
    }
    CHECK(writer.fault() == ENOSPC);
    CHECK(disk.bytes.size() == writer.size_bytes());
    writer.finish();  // has no room either, or has
    McapBytesSource source{disk.bytes};
    McapReader reader{source};
    std::uint32_t read = 0;
    for (McapItem item = reader.next(); item != McapItem::kEnd; item = reader.next()) {
      read += item == McapItem::kMessage ? 1U : 0U;
    }
    CHECK(read == written);
    CHECK(reader.damaged() == 0);
    CHECK(reader.ending() == (writer.is_finished() ? McapEnding::kWhole : McapEnding::kCutOff));
  }
}

TEST_CASE("mcap: after a full disk a file is closed if there is room again", "[recording]") {
  Disk disk;
  MemoryFile file{disk};
  McapWriter writer{file, "test"};
  const auto schema = writer.add(McapSchema{0, "s", "e", "d"});
  const auto channel = writer.add(McapChannel{0, schema, "t", "m", {}});
  writer.add(McapMessage{channel, 1, 1, 1, bytes_of("one")});
  writer.close_chunk();
  disk.room_bytes = disk.bytes.size() + 10;
  writer.add(McapMessage{channel, 2, 2, 2, bytes_of("two")});
  writer.close_chunk();
  CHECK(writer.fault() == ENOSPC);
  disk.room_bytes = UINT64_MAX;
  writer.finish();
  CHECK(writer.is_finished());
  CHECK(writer.fault() == ENOSPC);  // of what it has lost it speaks on
  McapBytesSource source{disk.bytes};
  CHECK(writer.message_count() == 1);
  McapReader reader{source};
  while (reader.next() != McapItem::kEnd) {
  }
  CHECK(reader.ending() == McapEnding::kWhole);
}
